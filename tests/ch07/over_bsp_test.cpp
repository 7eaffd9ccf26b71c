// Trees over BSP trees (H13): their fragments with boxes, bounded, nothing lost.
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "common/limit_error.hpp"
#include "common/scene.hpp"
#include "common/zero_area.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/parts_check.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace space {
namespace {

/// What a ray may hit.
bool has_area(const Triangle& triangle) {
    return !box_if_finite<3>(triangle).is_empty() && !has_zero_area(triangle);
}

}  // namespace

TEST_CASE(
    "over BSP leaves: each point of a triangle is in a leaf that names it, in scenes made to "
    "lose some") {
    for (const TestScene& scene : some_of(adversarial_scenes())) {
        INFO(scene.name);
        const std::span<const Triangle> triangles = scene.triangles;
        const auto tree = OverBspBuilder::build<3>(triangles);
        REQUIRE(faults_of_parts<3>(tree, triangles, 8, has_area) == "");
        const auto ones = OverBspBuilder::build<3>(triangles, {.max_leaf_size = 1});
        REQUIRE(faults_of_parts<3>(ones, triangles, 1, has_area) == "");
    }
}

TEST_CASE("the segments A to G: a leaf for each, and for C two, each with the box of its piece") {
    const auto segments = heinonen_segments();
    const auto bsp = BspBuilder<2>::build(segments, {});
    const auto tree = OverBspBuilder::build<2>(segments, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    CHECK(tree.references.size() == bsp.fragments.size());
    CHECK(faults_of_parts<2>(tree, segments, 1, [](const auto&) { return true; }) == "");
    CHECK(tree.size() == 2 * bsp.fragments.size() - 1);
    std::vector<int> named(segments.size());
    for (const std::uint32_t segment : tree.references) ++named[segment];
    for (std::size_t i = 0; i < named.size(); ++i) {
        int pieces = 0;
        for (const auto& fragment : bsp.fragments) pieces += fragment.polygon == i;
        CHECK(named[i] == pieces);
    }
}

TEST_CASE("two crossing segments, by hand") {
    // The first is in the root's plane, the second is cut by it: two pieces, on either side.
    const std::vector<Segment> cross{{{0, 2}, {4, 2}}, {{2, 0}, {2, 4}}};
    const std::vector<std::uint32_t> order{0};
    const auto tree = OverBspBuilder::build<2>(
        cross, {.costs = {0.0, 1.0}, .max_leaf_size = 1, .bsp = {.order = order}});
    REQUIRE(tree.references.size() == 3);
    CHECK(tree.size() == 5);
    std::vector<Aabb2> boxes;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (tree.nodes[index].is_leaf() && tree.own(index)[0] == 1)
            boxes.push_back(tree.nodes[index].box);
    });
    REQUIRE(boxes.size() == 2);
    std::ranges::sort(boxes, {}, [](const Aabb2& box) { return box.min.y; });
    // Exact where they are the segment's own, and else no farther off than a corner's error.
    CHECK(boxes[0].min == Point2(2, 0));
    CHECK(boxes[1].max == Point2(2, 4));
    CHECK((boxes[0].max.y >= 2.0f && boxes[0].max.y <= std::nextafter(2.0f, 3.0f)));
    CHECK((boxes[1].min.y <= 2.0f && boxes[1].min.y >= std::nextafter(2.0f, 1.0f)));
}

TEST_CASE("of what lies in a plane, in front and behind, the two that are nearest go together") {
    // The first is in the root's plane; another is near it, and the third far on the other side.
    const std::vector<std::uint32_t> order{0};
    for (const float side : {1.0f, -1.0f}) {
        const std::vector<Segment> row{{{0, 0}, {1, 0}},
                                       {{0, 0.5f * side}, {1, 0.5f * side}},
                                       {{0, -90 * side}, {1, -90 * side}}};
        const auto tree = OverBspBuilder::build<2>(
            row, {.costs = {0.0, 1.0}, .max_leaf_size = 1, .bsp = {.order = order}});
        REQUIRE(tree.references.size() == 3);
        const std::uint32_t alone = tree.nodes[2].is_leaf() ? 2 : 3;
        CHECK(tree.own(alone)[0] == 2);
        CHECK(!tree.nodes[alone ^ 1u].is_leaf());
    }
}

TEST_CASE("many triangles in one plane are a tree of their own") {
    const auto grid = scenes::sheet(20, 20, [](int i, int j) { return Point3(i, j, 1); });
    const auto tree = OverBspBuilder::build<3>(grid, {.max_leaf_size = 4});
    CHECK(tree.references.size() == grid.size());
    CHECK(faults_of(tree, grid, 4) == "");
    CHECK(tree.depth < 20);
}

TEST_CASE("references are bounded by the BSP tree's limit") {
    const auto triangles = scenes::soup(200, 0.5f, 3);
    const auto tree = OverBspBuilder::build<3>(triangles);
    CHECK(tree.references.size() > triangles.size());
    const OverBspBuilder::Config config{.bsp = {.max_fragments = 300}};
    CHECK_THROWS_AS(OverBspBuilder::build<3>(triangles, config), LimitError);
}

TEST_CASE("what is not finite is left out, and the rest keeps its names") {
    auto triangles = scenes::soup(50, 0.2f, 4);
    triangles[0].a.x = std::nanf("");
    triangles[20].b.y = infinity;
    const auto tree = OverBspBuilder::build<3>(triangles);
    CHECK(faults_of_parts<3>(tree, triangles, 8, has_area) == "");
    for (const std::uint32_t triangle : tree.references) CHECK((triangle != 0 && triangle != 20));
}

TEST_CASE("inexact grades are built exactly, and the same tree every time") {
    const auto triangles = scenes::soup(100, 0.3f, 5);
    const auto exact = OverBspBuilder::build<3>(triangles);
    const auto asked = OverBspBuilder::build<3>(triangles, {.bsp = {.grade = Grade::thick_float}});
    CHECK(exact.nodes == asked.nodes);
    CHECK(exact.references == asked.references);
}

}  // namespace space
