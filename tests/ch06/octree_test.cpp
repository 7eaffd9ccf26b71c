// The suite over the octree, tight, with straddlers kept, and loose, by both walks.
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"

#include "tests/suite/accelerator_suite.hpp"

#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace space {
namespace {

using Straddlers = OctreeConfig::Straddlers;
using Walk = OctreeConfig::Walk;

void check_suite(std::string_view name, const OctreeConfig& config) {
    check_accelerator<Octree<>>(
        name, [=](std::span<const Triangle> t) { return Octree<>::build(t, config); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("triangles that are not finite are left out: the tree is that of the others") {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 20; ++i) {
        const Point3 corner(float(i % 5), float(i % 4), float(i % 3));
        triangles.push_back({corner, corner + Vector3(1, 0, 0), corner + Vector3(0, 1, 1)});
    }
    for (const float looseness : {1.0f, 2.0f})
        for (const float bad : {std::nanf(""), infinity, -infinity})
            for (int axis = 0; axis < 3; ++axis) {
                OctreeConfig config{.looseness = looseness};
                if (looseness != 1.0f) config.straddlers = Straddlers::keep;
                const auto without = Octree<>::build(triangles, config);
                auto all = triangles;
                all.push_back(triangles.front());
                all.back().b[axis] = bad;
                const auto with = Octree<>::build(all, config);
                CAPTURE(looseness, bad, axis);
                CHECK(with.nodes().bounds == without.nodes().bounds);
                CHECK(with.nodes().nodes == without.nodes().nodes);
                CHECK(with.nodes().references == without.nodes().references);
                CHECK(Octree<>::build(std::span(all).last(1), config).nodes().empty());
            }
}

TEST_CASE("the suite: octree") {
    run_suite<Octree>("octree");
}

TEST_CASE("the suite: loose octree") {
    run_suite<Octree>("octree-loose", {.straddlers = Straddlers::keep, .looseness = 2.0});
}

TEST_CASE("the suite: octrees by the plain walk, and without mailboxes") {
    check_suite("octree, plain walk", {.walk = Walk::plain});
    check_suite("octree-loose, plain walk",
                {.straddlers = Straddlers::keep, .looseness = 2.0, .walk = Walk::plain});
    check_suite("octree, no mailboxes", {.mailboxes = false});
}

TEST_CASE("the suite: octrees with straddlers kept, and loose by numbers that are not round") {
    check_suite("octree, kept", {.straddlers = Straddlers::keep});
    check_suite("octree-loose, 1.1", {.straddlers = Straddlers::keep, .looseness = 1.1});
    check_suite("octree-loose, 3.7", {.straddlers = Straddlers::keep, .looseness = 3.7});
}

TEST_CASE("the suite: octrees as deep as they get, and shallow ones") {
    check_suite("octree, deep",
                {.costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_growth = 64.0});
    check_suite("octree, shallow", {.max_depth = 2});
    check_suite("octree, a leaf", {.max_depth = 0});
}

}  // namespace space
