#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison OrthtreeFrame cell_of
#include "ex01_quadrant_of_a_point.hpp"

using namespace space;

namespace {

using Box = OrthtreeBox<2>;

constexpr float denormal = std::numeric_limits<float>::denorm_min();

std::string words(const std::optional<std::uint32_t>& quadrant) {
    return quadrant ? fmt::format("quadrant {}", *quadrant) : "not in the cell";
}
std::string answer(const Box& root, const Box& cell, float x, float y) {
    return words(quadrant_of(root, cell, {x, y}));
}

Box square(double x, double y, double edge) {
    return {{x, y}, {x + edge, y + edge}};
}
/// The cell in this column and row of the 2^depth.
Box cell_at(const Box& root, int depth, int column, int row) {
    const double edge = std::ldexp(root.max.x - root.min.x, -depth);
    return square(root.min.x + column * edge, root.min.y + row * edge, edge);
}

const Box root = square(-1, -1, 2);
const std::array<Box, 4> children{square(-1, -1, 1), square(0, -1, 1), square(-1, 0, 1),
                                  square(0, 0, 1)};

/// The column or row of the 2^depth in which p lies, by asking one border after the other; -1 for
/// none.
int place_of(double p, double low, double edge, int depth) {
    if (!(low <= p && p <= low + edge)) return -1;
    int place = 0;
    while (place + 1 < 1 << depth && p >= low + std::ldexp(edge, -depth) * (place + 1)) ++place;
    return place;
}

/// All borders of cells at depth 4, and the floats beside them.
std::vector<float> on_and_beside_borders(double low, double edge) {
    std::vector<float> places;
    for (int i = 0; i <= 16; ++i) {
        const auto border = static_cast<float>(low + edge * i / 16);
        for (const float p :
             {std::nextafter(border, -infinity), border, std::nextafter(border, infinity)})
            places.push_back(p);
    }
    return places;
}

void require_one_cell_each(const Box& whole, float x, float y, int depth) {
    const double edge = whole.max.x - whole.min.x;
    const std::array<int, 2> now{place_of(x, whole.min.x, edge, depth),
                                 place_of(y, whole.min.y, edge, depth)},
        next{place_of(x, whole.min.x, edge, depth + 1), place_of(y, whole.min.y, edge, depth + 1)};
    for (int row = 0; row < 1 << depth; ++row)
        for (int column = 0; column < 1 << depth; ++column) {
            const Box cell = cell_at(whole, depth, column, row);
            std::optional<std::uint32_t> wanted;
            if (now == std::array{column, row})
                wanted = std::uint32_t(next[0] % 2 + 2 * (next[1] % 2));
            const std::optional<std::uint32_t> is = quadrant_of(whole, cell, {x, y});
            if (is == wanted) continue;
            CAPTURE(whole.min, whole.max, cell.min, cell.max, Point2(x, y));
            REQUIRE(words(is) == words(wanted));
        }
}

}  // namespace

TEST_CASE("in a quadrant's number bit 0 is the upper half in x, bit 1 the upper half in y") {
    CHECK(answer(root, root, -0.5f, -0.5f) == "quadrant 0");
    CHECK(answer(root, root, 0.5f, -0.5f) == "quadrant 1");
    CHECK(answer(root, root, -0.5f, 0.5f) == "quadrant 2");
    CHECK(answer(root, root, 0.5f, 0.5f) == "quadrant 3");
}

TEST_CASE("a cell's quadrants meet in its own centre") {
    CHECK(answer(root, children[3], 0.25f, 0.75f) == "quadrant 2");
    CHECK(answer(root, children[1], 0.75f, -0.75f) == "quadrant 1");
    CHECK(answer(root, square(-0.5, 0.5, 0.25), -0.3125f, 0.6875f) == "quadrant 3");
}

TEST_CASE("a point on any side of the cell is in none of its quadrants") {
    for (const float x : {-0.5f, 0.5f, 1.5f})
        for (const float y : {-0.5f, 0.5f, 1.5f}) {
            if (x == 0.5f && y == 0.5f) continue;
            CAPTURE(Point2(x, y));
            REQUIRE(answer(root, children[3], x, y) == "not in the cell");
        }
}

TEST_CASE("a point on the line between two halves is in the upper one") {
    CHECK(answer(root, root, 0.0f, -0.5f) == "quadrant 1");
    CHECK(answer(root, root, -0.5f, 0.0f) == "quadrant 2");
    CHECK(answer(root, root, 0.0f, 0.0f) == "quadrant 3");
    CHECK(answer(root, root, -0.0f, -0.0f) == "quadrant 3");
}

TEST_CASE("a point on the border of two cells is in the upper one and not in the other") {
    CHECK(answer(root, children[0], 0.0f, -0.5f) == "not in the cell");
    CHECK(answer(root, children[1], 0.0f, -0.5f) == "quadrant 2");
    CHECK(answer(root, children[0], -0.5f, 0.0f) == "not in the cell");
    CHECK(answer(root, children[2], -0.5f, 0.0f) == "quadrant 1");
    CHECK(answer(root, children[0], 0.0f, 0.0f) == "not in the cell");
    CHECK(answer(root, children[3], -0.0f, 0.0f) == "quadrant 0");
}

TEST_CASE("a point on the root's upper borders is in the cell below") {
    CHECK(answer(root, root, 1.0f, -0.5f) == "quadrant 1");
    CHECK(answer(root, root, -0.5f, 1.0f) == "quadrant 2");
    CHECK(answer(root, root, 1.0f, 1.0f) == "quadrant 3");
    CHECK(answer(root, children[1], 1.0f, -0.75f) == "quadrant 1");
    CHECK(answer(root, children[2], -0.75f, 1.0f) == "quadrant 2");
    CHECK(answer(root, children[3], 1.0f, 1.0f) == "quadrant 3");
}

TEST_CASE("a cell at the root's border on one axis is half-open on the other") {
    CHECK(answer(root, children[1], 0.75f, 0.0f) == "not in the cell");
    CHECK(answer(root, children[1], 1.0f, 0.0f) == "not in the cell");
    CHECK(answer(root, children[2], 0.0f, 0.75f) == "not in the cell");
    CHECK(answer(root, children[2], 0.0f, 1.0f) == "not in the cell");
}

TEST_CASE("one float beyond the root's borders is nothing") {
    const float beyond = std::nextafter(1.0f, infinity);
    for (const float p : {beyond, -beyond}) {
        CAPTURE(Number{p});
        REQUIRE(answer(root, root, p, 0.5f) == "not in the cell");
        REQUIRE(answer(root, root, 0.5f, p) == "not in the cell");
    }
}

TEST_CASE("a point below a border is below it, however near") {
    for (const float p : {-1e-6f, -1e-12f, -1e-30f, -denormal}) {
        CAPTURE(Number{p});
        REQUIRE(answer(root, root, p, 0.5f) == "quadrant 2");
        REQUIRE(answer(root, root, 0.5f, p) == "quadrant 1");
        REQUIRE(answer(root, children[1], 0.25f, p) == "quadrant 2");
        REQUIRE(answer(root, children[3], 0.25f, p) == "not in the cell");
    }
}

TEST_CASE("what is not a number or infinite is in no cell") {
    for (const float p : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity}) {
        CAPTURE(Number{p});
        REQUIRE(answer(root, root, p, 0.5f) == "not in the cell");
        REQUIRE(answer(root, root, 0.5f, p) == "not in the cell");
    }
}

TEST_CASE(
    "on all borders and one float beside them, a point of the root is in one cell each depth") {
    for (const Box& whole :
         {root, square(-1, 0, 2), square(0.75, -3, 0.25), square(-1048576, 3145728, 1048576)}) {
        const double edge = whole.max.x - whole.min.x;
        for (const float y : on_and_beside_borders(whole.min.y, edge))
            for (const float x : on_and_beside_borders(whole.min.x, edge))
                for (int depth = 0; depth < sized(4, 3); ++depth)
                    require_one_cell_each(whole, x, y, depth);
    }
}

TEST_CASE("thirty levels down the quadrants still hold their points, and no others") {
    Pcg32 random(1);
    for (int i = 0; i < 200; ++i) {
        const int smaller = int(random.below(40));
        const float x = std::ldexp(random.uniform(-1.0f, 1.0f), -smaller);
        const float y = random.uniform(-1.0f, 1.0f);
        Box cell = root;
        for (int depth = 0; depth < 30; ++depth) {
            const double half = 0.5 * (cell.max.x - cell.min.x);
            const int right = double{x} >= cell.min.x + half, up = double{y} >= cell.min.y + half;
            CAPTURE(Point2(x, y), depth, cell.min, cell.max);
            REQUIRE(answer(root, cell, x, y) == fmt::format("quadrant {}", right + 2 * up));
            const auto child = [&](int column, int row) {
                return square(cell.min.x + column * half, cell.min.y + row * half, half);
            };
            REQUIRE(answer(root, child(1 - right, up), x, y) == "not in the cell");
            REQUIRE(answer(root, child(right, 1 - up), x, y) == "not in the cell");
            cell = child(right, up);
        }
    }
}
