#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>

// The exercise is to do without the tree's own: the compiler refuses it from here on.
#pragma GCC poison locate
#include "ex07_inside_or_outside.hpp"

namespace space {

static std::ostream& operator<<(std::ostream& out, Location location) {
    constexpr std::array names{"outside", "inside", "boundary"};
    return out << names[static_cast<std::size_t>(location)];
}

}  // namespace space

using namespace space;

namespace {

using Outline = std::vector<Point2>;

/// The edges of outlines that go round clockwise, and round holes the other way: their fronts, to
/// the left, look outwards.
std::vector<Segment> edges_of(const std::vector<Outline>& outlines) {
    std::vector<Segment> edges;
    for (const Outline& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i)
            edges.push_back({outline[i], outline[(i + 1) % outline.size()]});
    return edges;
}

/// By counting the edges to the right of the point, in numbers for which doubles are exact.
Location exactly(const std::vector<Segment>& edges, const Double2& p) {
    bool inside = false;
    for (const Segment& edge : edges) {
        const Double2 a = Double2(edge.a) - p, b = Double2(edge.b) - p;
        const double area = a.x * b.y - a.y * b.x;
        if (area == 0.0 && glm::dot(a, b) <= 0.0) return Location::boundary;
        if ((a.y > 0.0) != (b.y > 0.0) && (area > 0.0) == (b.y > a.y)) inside = !inside;
    }
    return inside ? Location::inside : Location::outside;
}

void check(const std::vector<Outline>& outlines, std::uint64_t seed) {
    const std::vector<Segment> edges = edges_of(outlines);
    const auto tree =
        BspBuilder<2>::build(edges, {.splitter = BspConfig::SplitterChoice::random, .seed = seed});
    for (int y = -4; y <= 20; ++y)
        for (int x = -4; x <= 20; ++x) {
            const Point2 p(0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y));
            CAPTURE(edges, p);
            REQUIRE(where_is(tree, p) == exactly(edges, Double2(p)));
        }
}

const Outline square{{1, 1}, {1, 7}, {7, 7}, {7, 1}};
const Outline angle{{0, 0}, {0, 8}, {4, 8}, {4, 4}, {8, 4}, {8, 0}};
const Outline hole{{3, 3}, {5, 3}, {5, 5}, {3, 5}};
const Outline far_square{{6, 6}, {6, 8}, {8, 8}, {8, 6}};

}  // namespace

TEST_CASE("without edges all is outside") {
    CHECK(where_is(BspTree<2>{}, {1, 2}) == Location::outside);
}

TEST_CASE("a square has an inside, an outside and a boundary") {
    check({square}, 1);
}

TEST_CASE("on the line of an edge, but not on the edge, a point is inside or outside") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) check({angle}, seed);
}

TEST_CASE("what is in a hole is outside, and its edges are boundary") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) check({square, hole}, seed);
}

TEST_CASE("two bodies that have lines in common are told apart") {
    const Outline small{{1, 1}, {1, 3}, {3, 3}, {3, 1}}, beside{{5, 1}, {5, 3}, {7, 3}, {7, 1}};
    for (std::uint64_t seed = 1; seed <= 8; ++seed) check({small, beside, far_square}, seed);
}

TEST_CASE("a star of random whole corners is told from what is around it") {
    Pcg32 random(37);
    for (int i = 0; i < 100; ++i) {
        // Clockwise around (4, 4), one corner in each of eight directions.
        constexpr std::array<std::array<int, 2>, 8> ways{
            {{-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}}};
        Outline star;
        for (const auto& [x, y] : ways) {
            const int length = 1 + static_cast<int>(random.below(4));
            star.push_back(Point2(4 + length * x, 4 + length * y));
        }
        check({star}, static_cast<std::uint64_t>(i));
    }
}
