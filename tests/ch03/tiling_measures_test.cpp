// The chapter's measures of a tiling, held against trees whose fragments are known by hand or were
// tampered with: a fragment too few, one twice, a corner moved.
#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "chapters/ch03_bsp_trees/tiling.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace space {
namespace {

constexpr Grade every_grade[] = {Grade::thick_float, Grade::ordered_float, Grade::ordered_double,
                                 Grade::exact};

/// The last triangle's plane splits all others; it lies off them.
BspTree<3> cut_by_last(const std::vector<Triangle>& triangles, Grade grade) {
    const std::uint32_t order[] = {static_cast<std::uint32_t>(triangles.size() - 1)};
    return BspBuilder<3>::build(triangles, {.grade = grade, .order = order});
}

/// Area 8, cut at x = 1 into a triangle of 4.5 and a quadrilateral of 3.5. All coordinates are
/// small whole numbers, without rounding in every grade.
const std::vector<Triangle> cut_triangle{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                                         {{1, 9, -1}, {1, 10, -1}, {1, 9, 1}}};
const Fragment<3>& piece(const BspTree<3>& tree, std::size_t corners) {
    return *std::find_if(tree.fragments.begin(), tree.fragments.end(), [&](const auto& f) {
        return f.polygon == 0 && f.corners.size() == corners;
    });
}

/// Whether vertical rays at (x, y) meet a piece; from both sides, which must agree.
bool meets_at(const FragmentRays& rays, const Fragment<3>& piece, float x, float y) {
    const bool from_above = rays.meets({{x, y, 5}, {0, 0, -1}}, piece);
    CHECK(rays.meets({{x, y, -5}, {0, 0, 1}}, piece) == from_above);
    return from_above;
}

}  // namespace

TEST_CASE("area is lost with a fragment that is missing, and won with one that is there twice") {
    for (const Grade grade : every_grade) {
        const BspTree<3> whole = cut_by_last(cut_triangle, grade);
        CHECK(measure_tiling(whole, grade).area_error == 0.0);
        for (const auto& [corners, share] : {std::pair{3u, 4.5 / 8}, {4u, 3.5 / 8}}) {
            BspTree<3> lost = whole, won = whole;
            won.fragments.push_back(piece(whole, corners));
            std::erase_if(lost.fragments, [&](const auto& f) {
                return f.polygon == 0 && f.corners.size() == corners;
            });
            CHECK(measure_tiling(lost, grade).area_error == share);
            CHECK(measure_tiling(won, grade).area_error == share);
        }
    }
}

TEST_CASE("areas of exact corners add up where those of rounded ones don't") {
    const std::vector<Triangle> soup = scenes::soup(12, 0.7f, 3);
    const auto area_error = [&](Grade grade) {
        return measure_tiling(BspBuilder<3>::build(soup, {.grade = grade}), grade).area_error;
    };
    CHECK(area_error(Grade::exact) == 0.0);
    CHECK(area_error(Grade::ordered_double) > 0.0);
}

TEST_CASE("an edge of two polygons that a plane cuts is one cut, and a crack where they differ") {
    // Both have the edge from (0, 0) to (0, 4), in opposite directions; cut at y = 1.
    const std::vector<Triangle> pair{{{0, 0, 0}, {0, 4, 0}, {-2, 1, 1}},
                                     {{0, 4, 0}, {0, 0, 0}, {2, 2, 1}},
                                     {{9, 1, -1}, {9, 1, 1}, {10, 1, 0}}};
    for (const Grade grade : every_grade) {
        BspTree<3> tree = cut_by_last(pair, grade);
        const Tiling sound = measure_tiling(tree, grade);
        CHECK(sound.cuts == 1);
        CHECK(sound.cracks == 0);
        std::erase_if(tree.fragments, [](const auto& f) {  // a piece of each is enough
            return f.polygon < 2 && f.corners[0].at.y + f.corners[1].at.y > 2.0;
        });
        CHECK(measure_tiling(tree, grade).cuts == 1);
        for (Fragment<3>& fragment : tree.fragments)
            for (auto& corner : fragment.corners)
                if (fragment.polygon == 1 && corner.at == Double3(0, 1, 0)) corner.at.x = 0x1p-30;
        const Tiling moved = measure_tiling(tree, grade);
        CHECK(moved.cuts == 1);
        // An exact corner is where its planes meet, whatever number was noted for it.
        CHECK(moved.cracks == (grade == Grade::exact ? 0 : 1));
    }
}

TEST_CASE("a ray meets the fragment that it passes through, its border included, and no other") {
    for (const Grade grade : every_grade) {
        const BspTree<3> tree = cut_by_last(cut_triangle, grade);
        const FragmentRays rays(tree, grade);
        const auto meets = [&](std::size_t corners, float x, float y) {
            return meets_at(rays, piece(tree, corners), x, y);
        };
        for (const Point2& p : {Point2(2, 1), {1, 0}, {4, 0}, {1, 3}, {1, 1}, {2.5f, 0}, {2, 2}})
            CHECK(meets(3, p.x, p.y));
        for (const Point2& p : {Point2(0.5f, 0.5f), {2, -0.5f}, {3, 2}, {5, 0}, {1, 4}, {1, -1}})
            CHECK_FALSE(meets(3, p.x, p.y));
        for (const Point2& p : {Point2(0.75f, 0.25f),
                                {0.25f, 3},
                                {0.5f, 1.5f},
                                {0, 0},
                                {1, 0},
                                {1, 3},
                                {0, 4},
                                {0, 2},
                                {1, 2},
                                {0.5f, 3.5f},
                                {0.5f, 0}})
            CHECK(meets(4, p.x, p.y));
        for (const Point2& p : {Point2(-0.5f, 1), {0.5f, -0.5f}, {1.5f, 1}, {0.75f, 3.5f}, {0, 5}})
            CHECK_FALSE(meets(4, p.x, p.y));
        CHECK_FALSE(rays.meets({{-1, 1, 0}, {1, 0, 0}}, piece(tree, 4)));  // seen edge-on
    }
}

TEST_CASE("a ray exactly through a cut meets both pieces, and one beside it a single one") {
    for (int k = 3; k < 60; k += 2) {  // cut where k x + z = 1, at x = 1 / k
        const auto slope = static_cast<float>(k);
        const BspTree<3> tree = cut_by_last(
            {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 9, 1}, {1, 9, 1 - slope}, {0, 10, 1}}},
            Grade::exact);
        const FragmentRays rays(tree, Grade::exact);
        const auto met = [&](float x) {
            const Ray ray{{0, 0.3f, 1}, {x, 0, -slope}};  // z = 0 at x / k
            return int{rays.meets(ray, piece(tree, 3))} + rays.meets(ray, piece(tree, 4));
        };
        CHECK(met(1.0f) == 2);
        CHECK(met(1.0f + 0x1p-23f) == 1);
        CHECK(met(1.0f - 0x1p-24f) == 1);
    }
}

TEST_CASE("a ray through a corner meets all pieces there, however roughly double knows it") {
    // Planes through (3/8, 0, 0) that cut a triangle nearly along its edge from (0, 0) to (1, 0).
    Pcg32 random(4);
    int rough = 0;
    for (int i = 0; i < 50; ++i) {
        const auto number = [&] { return 1.0f + random.uniform(); };
        const float x = 8.0f * number(), y = 0x1p-10f * number(), z = number(),
                    other_x = 4.0f * number(), other_y = 0x1p-10f * number();
        const Point3 corner(0.375f, 0, 0);
        const BspTree<3> tree = cut_by_last(
            {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{x, y, z}, corner, {other_x, -other_y, number()}}},
            Grade::exact);
        const FragmentRays rays(tree, Grade::exact);
        int pieces = 0, met = 0;
        for (const Fragment<3>& fragment : tree.fragments) {
            if (fragment.polygon != 0) continue;
            ++pieces;
            // From so near that the corner's error shows.
            met += rays.meets({{corner.x, 0, 0x1p-20f}, {0, 0, -1}}, fragment);
            rough += std::none_of(fragment.corners.begin(), fragment.corners.end(),
                                  [&](const auto& c) { return c.at == Double3(corner); });
        }
        CHECK(pieces == 2);
        CHECK(met == 2);
    }
    CHECK(rough > 30);
}

TEST_CASE("a ray meets the same fragments, wherever within its error a corner was noted") {
    const BspTree<3> tree = cut_by_last(cut_triangle, Grade::exact);
    const FragmentRays truth(tree, Grade::exact);
    Pcg32 random(6);
    int wrong = 0, hits = 0;
    for (int i = 0; i < 4'000; ++i) {
        BspTree<3> noted = tree;
        for (Fragment<3>& fragment : noted.fragments)
            for (auto& corner : fragment.corners) {
                if (corner.at.x != 1.0) continue;  // not a cut
                corner.error = 0x1p-4;
                for (int axis = 0; axis < 2; ++axis)
                    corner.at[axis] += random.below(2) ? corner.error : -corner.error;
            }
        const float x = 1.0f + random.uniform(-0.2f, 0.2f), y = random.uniform(-0.5f, 3.5f);
        // From so near that only what is off across the ray counts.
        const Ray ray{{x, y, 0x1p-10f}, {0, 0, -1}};
        const FragmentRays rays(noted, Grade::exact);
        for (std::size_t f = 0; f < tree.fragments.size(); ++f) {
            const bool met = truth.meets(ray, tree.fragments[f]);
            hits += met;
            wrong += rays.meets(ray, noted.fragments[f]) != met;
        }
    }
    CHECK(hits > 1'000);
    CHECK(wrong == 0);
}

TEST_CASE("a ray exactly through a polygon's own corner meets it, whatever roundings say") {
    Pcg32 random(5);
    const auto number = [&] {  // sums of two are exact
        return 0x1p-12f * static_cast<float>(random.below(1u << 23));
    };
    const auto point = [&] {
        const float x = number(), y = number();
        return Point3(x, y, number());
    };
    int missed = 0;
    for (int i = 0; i < 1'000; ++i) {
        Ray ray{point(), point()};
        Point3 b = point();
        if (i % 2) {  // only two products, and those cancel
            ray.direction.y = 0.0f;
            b = ray.origin + Vector3(0, number(), 0);
        }
        const std::vector<Triangle> one{{ray.origin + ray.direction, b, point()}};
        const BspTree<3> tree = BspBuilder<3>::build(one);
        missed += !FragmentRays(tree, Grade::exact).meets(ray, tree.fragments[0]);
    }
    CHECK(missed == 0);
}

TEST_CASE("rays at common edges and at cuts are counted where they hit, and slip through holes") {
    // A square of two triangles; rays from all around at their common edge hit one of them.
    const std::vector<Triangle> square{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}},
                                       {{0, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                                       {{9, 1, -1}, {9, 1, 1}, {10, 1, 0}}};
    constexpr std::uint64_t count = 500;
    BspTree<3> tree = cut_by_last(square, Grade::exact);
    const FragmentRays whole(tree, Grade::exact);
    for (const SlippedRays& sound : {whole.at_old_edges(count, 1), whole.at_cuts(count, 2)}) {
        CHECK(sound.rays == count);
        CHECK(sound.slipped == 0);
    }
    std::erase_if(tree.fragments, [](const auto& f) {
        return f.polygon < 2 && std::all_of(f.corners.begin(), f.corners.end(),
                                            [](const auto& corner) { return corner.at.y <= 1.0; });
    });
    const SlippedRays torn = FragmentRays(tree, Grade::exact).at_old_edges(count, 1);
    CHECK(torn.rays == count);
    CHECK(torn.slipped > count / 8);  // a quarter of the edge
    CHECK(torn.slipped < count * 3 / 8);
}

TEST_CASE("a ray that passes beside both polygons of an edge is not counted") {
    // A blade: from most places the common edge is its outline, and roundings take rays past it.
    const Point3 from(0.1f, 0.2f, 0.3f), to(0.9f, 3.7f, 0.6f);
    const std::vector<Triangle> blade{
        {from, to, {4, 2, 1}}, {to, from, {4, 2, -1}}, {{9, 1, -1}, {9, 1, 1}, {10, 1, 0}}};
    constexpr std::uint64_t count = 500;
    const BspTree<3> tree = cut_by_last(blade, Grade::exact);
    const SlippedRays slipped = FragmentRays(tree, Grade::exact).at_old_edges(count, 3);
    CHECK(slipped.rays < count * 3 / 4);
    CHECK(slipped.rays > count / 4);
    CHECK(slipped.slipped == 0);
}

}  // namespace space
