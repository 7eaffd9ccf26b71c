#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison OrthtreeFrame cell_of
#include "ex04_loose_cell.hpp"

using namespace space;

namespace {

using Cell = OrthtreeCell<3>;
using Place = std::array<std::uint32_t, 3>;

std::string words(const Cell& cell) {
    return fmt::format("depth {}, place ({}, {}, {})", cell.depth, cell.place[0], cell.place[1],
                       cell.place[2]);
}
std::string words(std::uint32_t depth, const Place& place) {
    return words(Cell{depth, place});
}
/// The cell in a root whose edge is 1.
std::string stored(const Triangle& triangle) {
    return words(loose_cell_of(triangle, 1.0f));
}

/// Of that size along an axis, from `low` on; at 0 on the others.
Triangle along(int axis, float low, float high) {
    Triangle triangle{Point3(0), Point3(0), Point3(0)};
    triangle.a[axis] = low;
    triangle.b[axis] = high;
    triangle.c[axis] = high;
    return triangle;
}

/// A triangle's box with whole coordinates, in units of 2^-24 of the root's edge, on each axis
/// from low to high.
struct WholeBox {
    std::array<std::int64_t, 3> low, high;
};
constexpr std::int64_t whole_root = std::int64_t{1} << 24;

Cell exactly(const WholeBox& box) {
    std::int64_t size = 0, edge = whole_root;
    for (std::size_t axis = 0; axis < 3; ++axis)
        size = std::max(size, box.high[axis] - box.low[axis]);
    Cell cell;
    for (; cell.depth < 21 && 2 * size <= edge; edge /= 2) ++cell.depth;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t edges = (box.low[axis] + box.high[axis]) / (2 * edge);
        cell.place[axis] = std::uint32_t(std::min(edges, whole_root / edge - 1));
    }
    return cell;
}
bool reaches_all_of(const Cell& cell, const WholeBox& box) {
    const std::int64_t edge = whole_root >> std::min(cell.depth, 21u);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t below = edge * cell.place[axis];
        if (2 * box.low[axis] < 2 * below - edge || 2 * box.high[axis] > 2 * below + 3 * edge)
            return false;
    }
    return true;
}

/// Its longest edge is that of a cell, or one unit more or less, or any; its centre is in a plane
/// of such cells, or up to one unit beside it, or anywhere.
WholeBox random_box(Pcg32& random) {
    const std::int64_t edge = whole_root >> random.below(22);
    const int longest = int(random.below(3));
    WholeBox box{};
    for (int axis = 0; axis < 3; ++axis) {
        std::int64_t size = random.below(std::uint32_t(edge) + 1);
        if (axis == longest) size = edge + random.below(3) - 1;
        size = std::clamp<std::int64_t>(size, 0, whole_root);
        std::int64_t low = random.below(std::uint32_t(whole_root - size) + 1);
        if (random.below(2) == 0) low = low / edge * edge - size / 2 + random.below(3) - 1;
        low = std::clamp<std::int64_t>(low, 0, whole_root - size);
        box.low[std::size_t(axis)] = low;
        box.high[std::size_t(axis)] = low + size;
    }
    return box;
}

/// With that box: on each axis one corner is at its lower end, another at its upper.
Triangle random_in(Pcg32& random, const WholeBox& box, float edge) {
    std::array<Point3, 3> corners{};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t low = box.low[std::size_t(axis)], high = box.high[std::size_t(axis)];
        std::array<std::int64_t, 3> places{low, high, low};
        places[2] += random.below(std::uint32_t(high - low) + 1);
        std::swap(places[0], places[random.below(3)]);
        std::swap(places[1], places[1 + random.below(2)]);
        for (std::size_t i = 0; i < 3; ++i)
            corners[i][axis] = static_cast<float>(places[i]) * 0x1p-24f * edge;
    }
    return {corners[0], corners[1], corners[2]};
}

}  // namespace

TEST_CASE("a triangle as large as the root is stored in the root") {
    CHECK(stored({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}) == words(0, {}));
    CHECK(stored({{0, 0, 0}, {0.75f, 0.25f, 0}, {0, 0, 0.25f}}) == words(0, {}));
}

TEST_CASE("a size of just a cell's edge goes as deep as the cell, the next float not") {
    for (std::uint32_t depth = 1; depth <= 21; ++depth)
        for (int axis = 0; axis < 3; ++axis) {
            const float edge = std::ldexp(1.0f, -int(depth));
            CAPTURE(axis, Number{edge});
            REQUIRE(stored(along(axis, 0.0f, edge)) == words(depth, {}));
            REQUIRE(stored(along(axis, 0.0f, std::nextafter(edge, 1.0f))) == words(depth - 1, {}));
        }
}

TEST_CASE(
    "the longest edge of the box is the size: neither its diagonal nor a side of the triangle") {
    CHECK(stored({{0, 0, 0}, {0.25f, 0.25f, 0}, {0, 0.25f, 0.25f}}) == words(2, {}));
    CHECK(stored({{0, 0, 0.125f}, {0.125f, 0.25f, 0}, {0.0625f, 0, 0}}) == words(2, {}));
}

TEST_CASE("a point is stored in a cell of depth 21, and so is what is smaller than such a cell") {
    const Point3 p(0.25f, 0.5f, 0.75f);
    CHECK(stored({p, p, p}) == words(21, {1u << 19, 1u << 20, 3u << 19}));
    CHECK(stored(along(1, 0.0f, 0x1p-30f)) == words(21, {}));
}

TEST_CASE("the place is the centre's of the box, not that of a corner or of the corners' mean") {
    CHECK(stored({{0.125f, 0, 0}, {0.125f, 0, 0}, {0.375f, 0, 0}}) == words(2, {1, 0, 0}));
    CHECK(stored({{0, 0.109375f, 0}, {0, 0.34375f, 0}, {0, 0.34375f, 0}}) == words(2, {0, 0, 0}));
    CHECK(stored({{0, 0, 0.875f}, {0, 0, 0.625f}, {0, 0, 0.625f}}) == words(2, {0, 0, 3}));
}

TEST_CASE("a small triangle across the root's middle planes goes as deep as any of its size") {
    const float low = 0.5f - 0x1p-11f, high = 0.5f + 0x1p-11f;
    CHECK(stored({{low, high, low}, {high, low, low}, {low, low, high}}) ==
          words(10, {512, 512, 512}));
    const float lower = 0.5f - 0x1p-10f, less = 0.5f - 0x1p-20f;
    CHECK(stored({{lower, less, low}, {less, lower, high}, {low, low, low}}) ==
          words(10, {511, 511, 512}));
}

TEST_CASE(
    "what is longer than a cell's edge is not stored there, though the cell may reach all of it") {
    CHECK(stored(along(0, 0.125f, 0.6875f)) == words(0, {}));
    CHECK(stored(along(2, 0.5f, 0.765625f)) == words(1, {0, 0, 1}));
}

TEST_CASE("a centre in a plane is in the upper cell, and half a float below it in the lower one") {
    const float half_a_unit = 0x1p-25f;  // of the floats from 0.5 to 1
    const float low = 0.75f - 0.125f, high = 0.75f + 0.125f;
    CHECK(stored(along(0, low, high)) == words(2, {3, 0, 0}));
    CHECK(stored(along(0, low, high - 2 * half_a_unit)) == words(2, {2, 0, 0}));
    CHECK(stored(along(1, low + 2 * half_a_unit, high)) == words(2, {0, 3, 0}));
    CHECK(stored(along(2, low, high - 4 * half_a_unit)) == words(2, {0, 0, 2}));
}

TEST_CASE(
    "a size that exceeds a cell's edge by less than a float does not go as deep as the cell") {
    CHECK(stored(along(0, 0x1p-24f - 0x1p-48f, 0.5f + 0x1p-24f)) == words(0, {}));
    CHECK(stored(along(0, 0x1p-24f, 0.5f + 0x1p-24f)) == words(1, {}));
    CHECK(stored(along(1, 0x1p-34f - 0x1p-50f, 0x1p-11f + 0x1p-34f)) == words(10, {}));
}

TEST_CASE("what lies in the root's upper faces is in the last cells") {
    const Point3 end(1, 1, 1);
    const std::uint32_t last = (1u << 21) - 1;
    CHECK(stored({end, end, end}) == words(21, {last, last, last}));
    CHECK(stored({{1, 0, 0}, {1, 0.25f, 0}, {1, 0, 0.25f}}) == words(2, {3, 0, 0}));
    CHECK(stored({{0, 0.5f, 1}, {0.5f, 0.5f, 1}, {0, 1, 1}}) == words(1, {0, 1, 1}));
}

TEST_CASE(
    "random triangles, in roots of any size: the cell is the exact one and reaches all of it") {
    Pcg32 random(1);
    for (int i = 0; i < sized(100'000, 10'000); ++i) {
        const float edge = std::ldexp(1.0f, int(random.below(41)) - 20);
        const WholeBox box = random_box(random);
        const Triangle triangle = random_in(random, box, edge);
        const Cell cell = loose_cell_of(triangle, edge), wanted = exactly(box);
        REQUIRE(reaches_all_of(wanted, box));
        if (cell == wanted) continue;
        CAPTURE(triangle, Number{edge}, reaches_all_of(cell, box));
        REQUIRE(words(cell) == words(wanted));
    }
}
