#include "ex03_octant_order.hpp"

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace space;

namespace {

constexpr int x = 0, y = 1, z = 2;
/// What a side names: another cut.
constexpr unsigned cut_1 = 5, cut_2 = 6;

/// The children in the order for an octant, the first one first; with what is wrong in the bits
/// above.
std::string order(const std::vector<Cut>& cuts, unsigned octant) {
    const unsigned byte = visit_orders(cuts)[octant];
    std::string children;
    for (std::size_t place = 0; place <= cuts.size(); ++place)
        children += fmt::format("{}{}", place ? " " : "", byte >> 2 * place & 3u);
    const unsigned above = byte >> 2 * (cuts.size() + 1);
    if (above != 0) children += fmt::format(", and {:#b} in the bits above", above);
    return children;
}

/// The children on a side, as bits.
unsigned children_of(const std::vector<Cut>& cuts, unsigned side) {
    if (side < 4) return 1u << side;
    return children_of(cuts, cuts[side - 4].lower) | children_of(cuts, cuts[side - 4].upper);
}
/// The same, pair by pair: where the cut between two children stands, and which is on its near
/// side.
std::string expected(const std::vector<Cut>& cuts, unsigned octant) {
    std::vector<unsigned> all;
    for (unsigned child = 0; child < 4; ++child)
        if ((children_of(cuts, 4) >> child & 1u) != 0) all.push_back(child);
    std::ranges::sort(all, [&](unsigned a, unsigned b) {
        for (const Cut& cut : cuts) {
            const unsigned lower = children_of(cuts, cut.lower),
                           upper = children_of(cuts, cut.upper);
            const bool up = (octant >> cut.axis & 1u) == 0;
            if ((lower >> a & upper >> b & 1u) != 0) return up;
            if ((lower >> b & upper >> a & 1u) != 0) return !up;
        }
        return false;
    });
    std::string children;
    for (const unsigned child : all)
        children += fmt::format("{}{}", children.empty() ? "" : " ", child);
    return children;
}

/// Cuts of any shape, with children in any order, two to four.
std::vector<Cut> random_cuts(Pcg32& random) {
    std::array<unsigned, 4> names{0, 1, 2, 3};
    for (std::uint32_t i = 3; i > 0; --i) std::swap(names[i], names[random.below(i + 1)]);
    std::vector<unsigned*> open;  // sides without a child yet; none moves: there is room for all
    std::vector<Cut> cuts;
    cuts.reserve(3);
    const std::uint32_t count = 1 + random.below(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i > 0) {
            const std::uint32_t which = random.below(std::uint32_t(open.size()));
            *open[which] = 4 + i;
            open.erase(open.begin() + which);
        }
        cuts.push_back({.axis = int(random.below(3))});
        open.push_back(&cuts.back().lower);
        open.push_back(&cuts.back().upper);
    }
    for (std::size_t i = 0; i < open.size(); ++i) *open[i] = names[i];
    return cuts;
}

}  // namespace

TEST_CASE("an octant has a bit for each axis that the ray goes down") {
    CHECK(octant_of({1, 2, 3}) == 0);
    CHECK(octant_of({-1, 2, 3}) == 1);
    CHECK(octant_of({1, -2, 3}) == 2);
    CHECK(octant_of({1, 2, -3}) == 4);
    CHECK(octant_of({-1, 2, -1e-30f}) == 5);
    CHECK(octant_of({-infinity, -2, -3}) == 7);
}

TEST_CASE("a negative zero goes down, as it does for the slab test") {
    CHECK(octant_of({0.0f, 0.0f, 1}) == 0);
    CHECK(octant_of({-0.0f, 0.0f, 1}) == 1);
    CHECK(octant_of({0.0f, -0.0f, 1}) == 2);
    CHECK(octant_of({0.0f, 1, -0.0f}) == 4);
}

TEST_CASE("two children: the lower one first on the way up, the upper one on the way down") {
    for (const int axis : {x, y, z})
        for (unsigned octant = 0; octant < 8; ++octant) {
            CAPTURE(axis, octant);
            const bool down = (octant >> axis & 1u) != 0;
            REQUIRE(order({{axis, 0, 1}}, octant) == (down ? "1 0" : "0 1"));
            REQUIRE(order({{axis, 1, 0}}, octant) == (down ? "0 1" : "1 0"));
        }
}

TEST_CASE("two pairs: the order of the pairs and that in each pair by their own axes") {
    const std::vector<Cut> cuts{{x, cut_1, cut_2}, {y, 0, 1}, {z, 2, 3}};
    CHECK(order(cuts, 0) == "0 1 2 3");
    CHECK(order(cuts, 1) == "2 3 0 1");
    CHECK(order(cuts, 2) == "1 0 2 3");
    CHECK(order(cuts, 3) == "2 3 1 0");
    CHECK(order(cuts, 4) == "0 1 3 2");
    CHECK(order(cuts, 5) == "3 2 0 1");
    CHECK(order(cuts, 6) == "1 0 3 2");
    CHECK(order(cuts, 7) == "3 2 1 0");
}

TEST_CASE("one after the other: three cuts in a chain") {
    const std::vector<Cut> lower{{x, cut_1, 3}, {y, cut_2, 2}, {x, 0, 1}};
    CHECK(order(lower, 0) == "0 1 2 3");
    CHECK(order(lower, 1) == "3 1 0 2");
    CHECK(order(lower, 2) == "2 0 1 3");
    CHECK(order(lower, 3) == "3 2 1 0");
    const std::vector<Cut> upper{{z, 0, cut_1}, {z, 1, cut_2}, {z, 2, 3}};
    CHECK(order(upper, 0) == "0 1 2 3");
    CHECK(order(upper, 4) == "3 2 1 0");
    CHECK(order(upper, 3) == "0 1 2 3");
}

TEST_CASE("children in any order, cuts in any order") {
    const std::vector<Cut> cuts{{y, cut_2, cut_1}, {x, 3, 1}, {z, 0, 2}};
    CHECK(order(cuts, 0) == "0 2 3 1");
    CHECK(order(cuts, 7) == "1 3 2 0");
    CHECK(order(cuts, 5) == "2 0 1 3");
}

TEST_CASE("three children leave the highest bits at 0") {
    const std::vector<Cut> cuts{{x, 2, cut_1}, {y, 1, 0}};
    CHECK(order(cuts, 0) == "2 1 0");
    CHECK(order(cuts, 1) == "1 0 2");
    CHECK(order(cuts, 2) == "2 0 1");
    CHECK(order(cuts, 3) == "0 1 2");
}

TEST_CASE("random cuts: each two children in the order of the cut between them") {
    Pcg32 random(3);
    for (int i = 0; i < 5'000; ++i) {
        const std::vector<Cut> cuts = random_cuts(random);
        for (unsigned octant = 0; octant < 8; ++octant) {
            CAPTURE(i, octant);
            REQUIRE(order(cuts, octant) == expected(cuts, octant));
        }
    }
}

TEST_CASE(
    "boxes between random cuts: no ray enters a later one before it has left an earlier one") {
    Pcg32 random(4);
    for (int i = 0; i < 2'000; ++i) {
        const std::vector<Cut> cuts = random_cuts(random);
        std::array<Aabb, 7> boxes;  // of the sides, by their names
        boxes[4] = {Point3(0), Point3(8)};
        for (std::size_t c = 0; c < cuts.size(); ++c) {
            const auto& [axis, lower, upper] = cuts[c];
            const Aabb whole = boxes[4 + c];
            const float plane = 0.5f * (whole.min[axis] + whole.max[axis]);
            boxes[lower] = boxes[upper] = whole;
            boxes[lower].max[axis] = boxes[upper].min[axis] = plane;
        }
        const Point3 inside = random_point(random, 0.5f, 7.5f);
        const Vector3 direction = random_vector(random);
        const unsigned byte = visit_orders(cuts)[octant_of(direction)];
        double left = -1e9;  // the earlier ones
        for (std::size_t place = 0; place <= cuts.size(); ++place) {
            const Aabb& box = boxes[byte >> 2 * place & 3u];
            double enter = -1e9, leave = 1e9;
            for (int axis = 0; axis < 3; ++axis) {
                const double t = (double{box.min[axis]} - inside[axis]) / direction[axis],
                             u = (double{box.max[axis]} - inside[axis]) / direction[axis];
                enter = std::max(enter, std::min(t, u));
                leave = std::min(leave, std::max(t, u));
            }
            if (enter >= leave) continue;  // missed
            CAPTURE(i, place, inside, direction);
            REQUIRE(enter >= left);  // one plane gives one quotient, at both of its sides
            left = leave;
        }
    }
}
