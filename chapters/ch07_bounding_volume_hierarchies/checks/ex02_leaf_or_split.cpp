#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison HitChance cut_pays
#include "ex02_leaf_or_split.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace space;

namespace {

constexpr BvhCosts equal{1.0, 1.0};

/// From the origin.
Aabb box(float x, float y, float z) {
    return {Point3(0.0f), {x, y, z}};
}
std::string choice(const std::optional<std::size_t>& index) {
    return index ? "cut " + std::to_string(*index) : "leaf";
}
std::string chosen(const Part& node, const std::vector<PossibleCut>& cuts,
                   const BvhCosts& costs = equal) {
    return choice(best_cut(node, cuts, costs));
}

/// A cube of 4 in two halves, with so many triangles in each.
PossibleCut halves(std::size_t first, std::size_t second) {
    return {{box(2, 4, 4), first}, {{{2, 0, 0}, {4, 4, 4}}, second}};
}
const Aabb cube = box(4, 4, 4);  // surface 96; a half: 64

}  // namespace

TEST_CASE("a node that cannot be cut is a leaf") {
    CHECK(chosen({cube, 10}, {}) == "leaf");
}

TEST_CASE("halves of a cube: six triangles are worth a step at equal costs, three are not") {
    // 1 + 2/3 n against n: even at n = 3.
    CHECK(chosen({cube, 2}, {halves(1, 1)}) == "leaf");
    CHECK(chosen({cube, 6}, {halves(3, 3)}) == "cut 0");
    CHECK(chosen({cube, 4}, {halves(3, 1)}) == "cut 0");
}

TEST_CASE("what a step and a test cost is asked for") {
    CHECK(chosen({cube, 6}, {halves(3, 3)}, {1.0, 0.25}) == "leaf");
    CHECK(chosen({cube, 6}, {halves(3, 3)}, {4.0, 1.0}) == "leaf");
    CHECK(chosen({cube, 6}, {halves(3, 3)}, {4.0, 3.0}) == "cut 0");
    CHECK(chosen({cube, 2}, {halves(1, 1)}, {0.25, 1.0}) == "cut 0");
}

TEST_CASE("a cut that costs just as much as the leaf is none") {
    // 12 + (6 * 8 + 6 * 8) / 24 against 16.
    const Aabb node = box(2, 2, 2), quarter = box(1, 1, 1);  // surfaces 24 and 6
    const std::vector<PossibleCut> cuts{{{quarter, 8}, {quarter, 8}}};
    CHECK(chosen({node, 16}, cuts, {12.0, 1.0}) == "leaf");
    CHECK(chosen({node, 16}, cuts, {std::nextafter(12.0, 0.0), 1.0}) == "cut 0");
}

TEST_CASE("of equally cheap cuts the first is taken, of others the cheapest, wherever it stands") {
    const PossibleCut poor = halves(8, 8), good{{box(1, 1, 1), 8}, {box(2, 2, 2), 8}};
    CHECK(chosen({cube, 16}, {poor, poor}) == "cut 0");
    CHECK(chosen({cube, 16}, {poor, good, good}) == "cut 1");
    CHECK(chosen({cube, 16}, {good, poor}) == "cut 0");
    CHECK(chosen({cube, 16}, {poor, poor, good}) == "cut 2");
}

TEST_CASE("counts count: a large box with few triangles is better than a smaller one with most") {
    // The sum of the surfaces is smaller in the first, but nearly all are in its larger box.
    const PossibleCut small_sum{{box(4, 4, 3), 15}, {box(1, 1, 1), 1}},  // 80, 6
        large_sum{{box(2, 2, 2), 15}, {box(4, 4, 4), 1}};                // 24, 96
    CHECK(chosen({cube, 16}, {small_sum, large_sum}) == "cut 1");
    CHECK(chosen({cube, 16}, {large_sum, small_sum}) == "cut 0");
    CHECK(chosen({cube, 16}, {{{box(4, 4, 3), 1}, {box(2, 2, 2), 15}}, large_sum}) == "cut 0");
}

TEST_CASE("the product of surface and count is taken part by part") {
    // 15 in 24 and 1 in 80 of 96: 440. Exchanged: 1224.
    CHECK(chosen({cube, 16}, {{{box(2, 2, 2), 15}, {box(4, 4, 3), 1}}}, {11.0, 1.0}) == "cut 0");
    CHECK(chosen({cube, 16}, {{{box(2, 2, 2), 1}, {box(4, 4, 3), 15}}}, {11.0, 1.0}) == "leaf");
    CHECK(chosen({cube, 16}, {{{box(4, 4, 3), 1}, {box(2, 2, 2), 15}}}, {11.0, 1.0}) == "cut 0");
}

TEST_CASE("parts that overlap and are as large as the node are no better than a leaf") {
    CHECK(chosen({cube, 1'000}, {{{cube, 500}, {cube, 500}}}) == "leaf");
}

TEST_CASE("flat boxes have the surface of their faces") {
    const Aabb wall = box(4, 4, 0), half = box(2, 4, 0);
    CHECK(chosen({wall, 4}, {{{half, 2}, {half, 2}}}) == "cut 0");  // 1 + 2 against 4
    CHECK(chosen({wall, 2}, {{{half, 1}, {half, 1}}}) == "leaf");
    CHECK(chosen({cube, 8}, {{{wall, 4}, {wall, 4}}}) == "cut 0");             // 1 + 8/3
    CHECK(chosen({cube, 3}, {{{wall, 2}, {wall, 1}}}, {2.0, 1.0}) == "leaf");  // 2 + 1
    const Aabb line = box(4, 0, 0);  // in a wall it is met by no ray in a plane
    CHECK(chosen({wall, 2}, {{{line, 1}, {line, 1}}}) == "cut 0");
    CHECK(chosen({wall, 2}, {{{line, 1}, {line, 1}}}, {1.75, 1.0}) == "cut 0");
}

TEST_CASE("in a line lengths take the place of surfaces") {
    const Aabb line = box(0, 8, 0), half = box(0, 4, 0), most = box(0, 7, 0);
    CHECK(chosen({line, 4}, {{{half, 2}, {half, 2}}}) == "cut 0");
    CHECK(chosen({line, 2}, {{{half, 1}, {half, 1}}}) == "leaf");
    CHECK(chosen({line, 8}, {{{most, 4}, {most, 4}}, {{half, 4}, {half, 4}}}) == "cut 1");
}

TEST_CASE("in a point every cut costs a step more than the leaf") {
    const Aabb point = box(0, 0, 0);
    CHECK(chosen({point, 1'000}, {{{point, 500}, {point, 500}}}) == "leaf");
    CHECK(chosen({point, 2}, {{{point, 1}, {point, 1}}}, {0.0, 1.0}) == "leaf");
}

TEST_CASE("tiny and huge boxes are as good as others") {
    for (const float scale : {0x1p-100f, 0x1p-40f, 0x1p40f, 0x1p100f}) {
        const Aabb node{-Point3(4 * scale), Point3(4 * scale)};
        const Aabb part{-Point3(4 * scale), {0, 4 * scale, 4 * scale}};
        CAPTURE(Number{scale});
        CHECK(chosen({node, 6}, {{{part, 3}, {part, 3}}}) == "cut 0");
        CHECK(chosen({node, 2}, {{{part, 1}, {part, 1}}}) == "leaf");
    }
    const float end = std::numeric_limits<float>::max();
    const Aabb all{Point3(-end), Point3(end)}, half{Point3(-end), {0, end, end}};
    CHECK(chosen({all, 6}, {{{half, 3}, {half, 3}}}) == "cut 0");
    CHECK(chosen({all, 2}, {{{half, 1}, {half, 1}}}) == "leaf");
}

TEST_CASE("random cuts of boxes with whole edges: the cheapest by whole numbers") {
    Pcg32 random(2);
    struct Whole {
        std::int64_t area, count;
    };
    for (int i = 0; i < 20'000; ++i) {
        const auto part = [&](Whole& whole, std::size_t count) {
            const std::int64_t x = 1 + random.below(8), y = 1 + random.below(8),
                               z = 1 + random.below(12);
            whole = {x * y + y * z + z * x, std::int64_t(count)};
            return Part{box(float(x), float(y), float(z)), count};
        };
        // The node's half surface is 256 and costs are whole: all sums are exact.
        const std::int64_t traversal = std::int64_t(random.below(9)),
                           intersection = 1 + std::int64_t(random.below(4));
        const Part node{box(8, 8, 12), 2 + random.below(30)};
        std::vector<PossibleCut> cuts(1 + random.below(5));
        std::int64_t least = 256 * intersection * std::int64_t(node.count);
        std::optional<std::size_t> wanted;
        for (std::size_t k = 0; k < cuts.size(); ++k) {
            Whole first{}, second{};
            const std::size_t count = 1 + random.below(std::uint32_t(node.count - 1));
            cuts[k].first = part(first, count);
            cuts[k].second = part(second, node.count - count);
            const std::int64_t cost = 256 * traversal + intersection * (first.area * first.count +
                                                                        second.area * second.count);
            if (cost < least) {
                least = cost;
                wanted = k;
            }
        }
        CAPTURE(i, node.count, traversal, intersection, cuts.size());
        REQUIRE(chosen(node, cuts, {double(traversal), double(intersection)}) == choice(wanted));
    }
}
