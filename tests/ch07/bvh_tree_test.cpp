// Trees by the builders: what holds in all of them, small ones by hand, and their costs.
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace space {
namespace {

/// A segment along x, whose box is a line.
Segment along_x(float from, float to, float y = 0.0f) {
    return {{from, y}, {to, y}};
}

/// The references of all leaves, each leaf's in brackets.
template <int D>
std::string leaves_of(const BvhNodes<D>& tree) {
    std::string text;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (!tree.nodes[index].is_leaf()) return;
        text += "(";
        for (const std::uint32_t polygon : tree.own(index)) text += std::to_string(polygon);
        text += ")";
    });
    return text;
}

/// Squares of side 1, as their diagonals, with their lower left corners at these places.
std::vector<Segment> diagonals(const std::vector<Point2>& corners) {
    std::vector<Segment> all;
    for (const Point2& p : corners) all.push_back({p, p + Vector2(1.0f)});
    return all;
}

/// Builds with these costs, by the strictest limits and by none.
template <class Builder>
void check_costs(const BvhCosts& costs, std::span<const Triangle> triangles) {
    constexpr auto most = std::numeric_limits<std::size_t>::max();
    for (const std::size_t max_leaf_size : {std::size_t{0}, std::size_t{1}, most})
        for (const unsigned max_depth : {0u, 1u, 1u << 31}) {
            typename Builder::Config config{.costs = costs, .max_leaf_size = max_leaf_size};
            if constexpr (requires { config.max_depth; }) config.max_depth = max_depth;
            if constexpr (requires { config.bins; }) config.bins = max_leaf_size;
            const auto tree = Builder::template build<3>(triangles, config);
            CAPTURE(costs.traversal, costs.intersection, max_leaf_size, max_depth);
            REQUIRE(faults_of(tree, triangles, std::max<std::size_t>(max_leaf_size, 1)) == "");
        }
}

}  // namespace

TEST_CASE("costs that are no costs, and limits that are none, give a whole tree all the same") {
    const double none = std::nan(""), endless = double{infinity};
    const std::vector<Triangle> copies(17, Triangle{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, 1}});
    for (const auto& triangles : {copies, scenes::soup(40, 0.3f, 4)})
        for (const double traversal : {0.0, 1.0, -1.0, none, endless, -endless})
            for (const double intersection : {0.0, 1.0, -1.0, none, endless, -endless}) {
                const BvhCosts costs{traversal, intersection};
                check_costs<MiddleBuilder>(costs, triangles);
                check_costs<SweepBuilder>(costs, triangles);
                check_costs<BinnedBuilder>(costs, triangles);
                check_costs<MortonBuilder>(costs, triangles);
                check_costs<BottomUpBuilder>(costs, triangles);
                check_costs<OptimisedBuilder>(costs, triangles);
                const SpatialSplitConfig whole{.costs = costs, .max_growth = none};
                REQUIRE(faults_of(SpatialSplitBuilder::build<3>(triangles, whole), triangles, 8) ==
                        "");
            }
}

TEST_CASE("an optimiser that is to try no node, or more than all, or to go on without end, ends") {
    const auto triangles = scenes::soup(60, 0.3f, 4);
    for (const double share : {-1.0, 0.0, std::nan(""), 2.0, 1e300})
        for (const double min_gain : {-1.0, 0.0, std::nan("")}) {
            const auto tree = OptimisedBuilder::build<3>(
                triangles, {.share = share, .min_gain = min_gain, .max_rounds = ~0u});
            CHECK(faults_of(tree, triangles, 8) == "");
        }
}

TEST_CASE(
    "in every tree: each triangle once, each box the union of what is below, pairs side by "
    "side in depth-first order, no leaf too large") {
    for (const TestScene& scene : some_of(adversarial_scenes()))
        for_each_builder([&](const char* name, const auto& build, std::size_t max_leaf_size) {
            const BvhNodes<3> tree = build(scene.triangles);
            INFO(scene.name << ", " << name);
            CHECK(faults_of(tree, scene.triangles, max_leaf_size) == "");
            CHECK(tree.empty() == scene.triangles.empty());
        });
}

TEST_CASE("the same of segments in the plane") {
    Pcg32 random(3);
    std::vector<Segment> segments;
    for (int i = 0; i < 300; ++i) {
        const Point2 a = random_point(random, Aabb2{Point2(0.0f), Point2(1.0f)});
        segments.push_back(
            {a, a + 0.1f * random_point(random, Aabb2{Point2(-1.0f), Point2(1.0f)})});
    }
    for_each_builder<2>([&](const char* name, const auto& build, std::size_t max_leaf_size) {
        const BvhNodes<2> tree = build(segments);
        INFO(name);
        CHECK(diagnosis(layout_faults(tree)) == "");
        std::vector<std::uint32_t> references = tree.references;
        std::ranges::sort(references);
        std::vector<std::uint32_t> all(segments.size());
        std::iota(all.begin(), all.end(), 0u);
        CHECK(references == all);
        tree.for_each_node([&](std::uint32_t index, unsigned) {
            REQUIRE(tree.nodes[index].count <= max_leaf_size);
            Aabb2 box;
            for (const std::uint32_t segment : tree.own(index))
                box.extend(segments[segment].a), box.extend(segments[segment].b);
            if (tree.nodes[index].is_leaf()) REQUIRE(box == tree.nodes[index].box);
        });
    });
}

TEST_CASE("the same input gives the same tree, bit for bit") {
    const auto triangles = scenes::soup(sized(2'000u, 300u), 0.1f, 5);
    for_each_builder([&](const char* name, const auto& build, std::size_t) {
        INFO(name);
        const BvhNodes<3> a = build(triangles), b = build(triangles);
        CHECK(a.nodes == b.nodes);
        CHECK(a.references == b.references);
        // Whatever order a library's sort or partition leaves.
        a.for_each_node(
            [&](std::uint32_t index, unsigned) { REQUIRE(std::ranges::is_sorted(a.own(index))); });
    });
}

TEST_CASE("median: half of the polygons to each side, on the axis where middles are spread most") {
    // Middles at x 0.5, 10.5, 2.5, 4.5 and y 0.5, 0.5, 3.5, 0.5.
    const auto segments = diagonals({{0, 0}, {10, 0}, {2, 3}, {4, 0}});
    const auto tree = MedianBuilder::build<2>(segments, {.max_leaf_size = 1});
    CHECK(leaves_of(tree) == "(0)(2)(3)(1)");  // x: 0 2 | 3 1; then y: 0 | 2; x: 3 | 1
    CHECK(tree.depth == 2);
    CHECK(tree.nodes[0].box == Aabb2{{0, 0}, {11, 4}});
    CHECK(tree.nodes[2].box == Aabb2{{0, 0}, {3, 4}});
    CHECK(tree.nodes[3].box == Aabb2{{4, 0}, {11, 1}});
    // Of five, two to the first side; of three, one.
    CHECK(leaves_of(MedianBuilder::build<2>(diagonals({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}),
                                            {.max_leaf_size = 2})) == "(01)(2)(34)");
}

TEST_CASE("middle: the plane halves the box around the middles, and nothing lies on no side") {
    // Middles at x 0.5, 10.5, 2.5, 4.5: the plane is at 5.5, then at 2.5, where 2 is not below it.
    const auto tree =
        MiddleBuilder::build<2>(diagonals({{0, 0}, {10, 0}, {2, 0}, {4, 0}}), {.max_leaf_size = 1});
    CHECK(leaves_of(tree) == "(0)(2)(3)(1)");
    CHECK(tree.nodes[2].box == Aabb2{{0, 0}, {5, 1}});
    // Middles one float apart: their middle is rounded to the lower one.
    const float one_float = std::nextafter(1.0f, 2.0f);
    const auto near = MiddleBuilder::build<2>(
        std::vector{along_x(1.0f, 1.0f), along_x(one_float, one_float)}, {.max_leaf_size = 1});
    CHECK(leaves_of(near) == "(0)(1)");
}

TEST_CASE("sweep and bins: cut where the expected cost is least, or not at all") {
    // Squares 0, 1, 2 side by side and 3 far off: half perimeters 2; of 0 to 2 together 4, of all
    // 11 + 1. 0 1 2 | 3: (4 * 3 + 2 * 1) / 12 tests, others more.
    const auto segments = diagonals({{0, 0}, {1, 0}, {2, 0}, {10, 0}});
    for (const bool binned : {false, true}) {
        const auto build = [&](double traversal) {
            return binned ? BinnedBuilder::build<2>(segments, {.costs = {traversal, 1.0}})
                          : SweepBuilder::build<2>(segments, {.costs = {traversal, 1.0}});
        };
        CHECK(leaves_of(build(1.0)) == "(012)(3)");
        // 14 / 12 tests against 4: it pays up to 34 / 12 for the step. Then 0 1 | 2 or 0 | 1 2:
        // (3 * 2 + 2 * 1) / 4 tests of 3, saves 1.
        CHECK(leaves_of(build(2.83)) == "(012)(3)");
        CHECK(leaves_of(build(2.84)) == "(0123)");
        CHECK(leaves_of(build(0.99)) == (binned ? "(0)(12)(3)" : "(0)(12)(3)"));
    }
}

TEST_CASE("the cost of a tree, by hand") {
    const auto tree = SweepBuilder::build<2>(diagonals({{0, 0}, {1, 0}, {2, 0}, {10, 0}}));
    // The root, a step; a third of its rays meet three squares, a sixth meets one.
    CHECK(tree.sah_cost({1.0, 1.0}) == Approx(1.0 + 4.0 / 12.0 * 3.0 + 2.0 / 12.0));
    CHECK(tree.sah_cost({5.0, 2.0}) == Approx(5.0 + 2.0 * (4.0 / 12.0 * 3.0 + 2.0 / 12.0)));
    CHECK(BvhNodes<3>{}.sah_cost({}) == 0.0);
}

TEST_CASE("the sweep finds the cheapest cut of all") {
    for (int round = 0; round < 20; ++round) {
        const auto triangles = scenes::soup(40, 0.3f, 100u + unsigned(round));
        const auto all = boxed<3>(triangles);
        const HitChance<3> chance(box_around<3>(all));
        double least = infinity;
        for (int axis = 0; axis < 3; ++axis)
            for (const auto& plane : all) {
                Aabb first, second;
                std::size_t count = 0;
                for (const auto& reference : all) {
                    const bool below = reference.box.centroid()[axis] < plane.box.centroid()[axis];
                    (below ? first : second).extend(reference.box);
                    count += below;
                }
                if (count == 0) continue;
                least = std::min(least, chance(first) * double(count) +
                                            chance(second) * double(all.size() - count));
            }
        auto references = all;
        SahSweep<3> sweep(references, triangles.size());
        const auto best = sweep.best({0, 0, box_around<3>(references), 0, references});
        CHECK(best.tests == Approx(least).epsilon(1e-12));
    }
}

TEST_CASE("with as many bins as it takes, a cut between bins is the sweep's") {
    // Middles at whole numbers, 0 to 31: bins of one each.
    std::vector<Segment> segments;
    Pcg32 random(9);
    for (int i = 0; i < 32; ++i) {
        const float reach = random.uniform(0.0f, 3.0f), x = float(i * 7 % 32);
        segments.push_back({{x - reach, 0.0f}, {x + reach, 1.0f}});
    }
    const auto swept = SweepBuilder::build<2>(segments, {.max_leaf_size = 32});
    const auto binned = BinnedBuilder::build<2>(segments, {.max_leaf_size = 32, .bins = 32});
    REQUIRE(!swept.nodes[0].is_leaf());
    CHECK(swept.nodes[2].box == binned.nodes[2].box);
    CHECK(swept.nodes[3].box == binned.nodes[3].box);
}

TEST_CASE("trees get better from halving to the sweep, and bins are within a few percent of it") {
    const auto triangles = scenes::ball(sized(5, 3));
    const BvhCosts costs;
    const double median = MedianBuilder::build<3>(triangles).sah_cost(costs),
                 sweep = SweepBuilder::build<3>(triangles).sah_cost(costs),
                 binned = BinnedBuilder::build<3>(triangles).sah_cost(costs);
    CHECK(sweep < 0.95 * median);
    CHECK(binned < 1.06 * sweep);
}

}  // namespace space
