// How much the children of a hierarchy overlap, by hand and by builders.
#include "chapters/ch12_comparison/measured/child_overlap.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <vector>

using namespace space;
using namespace space::ch12;

namespace {

/// A root with two leaves.
BvhNodes<3> tree_of(const Aabb& first, const Aabb& second) {
    BvhNodes<3> tree;
    tree.nodes.resize(4);
    tree.nodes[0].first = 2;
    tree.nodes[2] = {.box = first, .first = 0, .count = 1};
    tree.nodes[3] = {.box = second, .first = 1, .count = 1};
    tree.nodes[0].box = first;
    tree.nodes[0].box.extend(second);
    tree.depth = 1;
    return tree;
}

Aabb cube(float from, float to) {
    return {Point3(from), Point3(to)};
}

}  // namespace

TEST_CASE("the overlap of two children is a ratio of surfaces") {
    // In common: a cube of side 1 in one of side 3.
    CHECK(child_overlap(tree_of(cube(0, 2), cube(1, 3))) == Approx(1.0 / 9.0));
    CHECK(child_overlap(tree_of(cube(0, 2), cube(0, 2))) == 1.0);
    CHECK(child_overlap(tree_of(cube(0, 1), cube(2, 3))) == 0.0);
    // Halves of a box share a face and nothing else, as cells do.
    CHECK(child_overlap(tree_of({Point3(0, 0, 0), Point3(1, 2, 2)},
                                {Point3(1, 0, 0), Point3(2, 2, 2)})) == 0.0);
    CHECK(child_overlap({}) == 0.0);
}

TEST_CASE("shells around each other overlap more than a surface does") {
    const auto overlap = [](const char* scene) {
        const std::vector<Triangle> triangles = make_scene(scene).mesh.triangles();
        return child_overlap(BinnedBuilder::build<3>(triangles));
    };
    CHECK(overlap("shells:1") > overlap("scan:7"));
}
