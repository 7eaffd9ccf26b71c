#include "ex01_first_touch.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

using namespace space;

namespace {

using Nodes = std::set<std::size_t>;

/// A whole tree; it counts who is made.
struct Line {
    std::map<std::size_t, LineNode> nodes;
    std::map<std::size_t, int> made = {};

    MakeNode maker() {
        return [this](std::size_t node) {
            if (!nodes.contains(node)) FAIL("there is no node " << node);
            if (++made[node] > 1) FAIL("node " << node << " is made twice");
            return nodes.at(node);
        };
    }
    Nodes made_nodes() const {
        Nodes all;
        for (const auto& [node, times] : made) all.insert(node);
        return all;
    }
};

LineNode plane(double at) {
    return {false, at, {}};
}
LineNode leaf(std::vector<double> points) {
    return {true, 0.0, std::move(points)};
}

/// Planes at 4, 2 and 6, and a point or two in each of the four leaves.
Line four_leaves() {
    return {{{0, plane(4)},
             {1, plane(2)},
             {2, plane(6)},
             {3, leaf({1.5, 1})},
             {4, leaf({3})},
             {5, leaf({5, 4.5})},
             {6, leaf({7})}}};
}

bool on_way(double point, double from, double to) {
    return std::min(from, to) <= point && point <= std::max(from, to);
}
std::optional<double> first_of(const Line& line, double from, double to) {
    std::optional<double> first;
    for (const auto& [node, made] : line.nodes)
        for (const double p : made.points)
            if (on_way(p, from, to) && (!first || std::abs(p - from) < std::abs(*first - from)))
                first = p;
    return first;
}

/// The nodes that the walk must make: the closed cell holds a point of the way, and no found point
/// lies before all of those.
void needed(const Line& line, std::size_t node, double low, double high, double from, double to,
            std::optional<double>& best, Nodes& nodes) {
    const double first = std::max(std::min(from, to), low),
                 last = std::min(std::max(from, to), high);
    if (first > last) return;
    const double enter = from <= to ? first - from : from - last;
    if (best && std::abs(*best - from) <= enter) return;
    nodes.insert(node);
    const LineNode& made = line.nodes.at(node);
    for (const double p : made.points)
        if (on_way(p, from, to) && (!best || std::abs(p - from) < std::abs(*best - from))) best = p;
    if (made.is_leaf) return;
    const auto below = [&] { needed(line, 2 * node + 1, low, made.plane, from, to, best, nodes); };
    const auto above = [&] { needed(line, 2 * node + 2, made.plane, high, from, to, best, nodes); };
    if (from <= to)
        below(), above();
    else
        above(), below();
}
Nodes needed(const Line& line, double from, double to) {
    std::optional<double> best;
    Nodes nodes;
    needed(line, 0, -HUGE_VAL, HUGE_VAL, from, to, best, nodes);
    return nodes;
}

/// A random tree over points at halves of whole numbers, planes among them.
void grow(Line& line, std::size_t node, int low, int high, int depth, Pcg32& random) {
    if (depth == 0 || high - low < 2 || random.below(5) == 0) {
        std::vector<double> points;
        for (std::uint32_t i = random.below(3); i > 0; --i)
            points.push_back(0.5 * (low + int(random.below(std::uint32_t(high - low + 1)))));
        line.nodes[node] = leaf(points);
        return;
    }
    const int at = low + 1 + int(random.below(std::uint32_t(high - low - 1)));
    line.nodes[node] = plane(0.5 * at);
    grow(line, 2 * node + 1, low, at, depth - 1, random);
    grow(line, 2 * node + 2, at, high, depth - 1, random);
}

}  // namespace

TEST_CASE("the first point of the way is found, upwards and downwards") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    CHECK(tree.nearest(0, 8) == 1.0);
    CHECK(tree.nearest(8, 0) == 7.0);
    CHECK(tree.nearest(1.25, 8) == 1.5);
    CHECK(tree.nearest(3.5, 8) == 4.5);
    CHECK(tree.nearest(6.5, 0) == 5.0);
}

TEST_CASE("both ends belong to the way, and nothing beyond them") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    CHECK(tree.nearest(3, 8) == 3.0);
    CHECK(tree.nearest(1.75, 3) == 3.0);
    CHECK(tree.nearest(3.5, 4.25) == std::nullopt);
    CHECK(tree.nearest(7.5, 7.25) == std::nullopt);
    CHECK(tree.nearest(5, 5) == 5.0);
}

TEST_CASE("before the first walk nothing is made") {
    Line line = four_leaves();
    const LazyLine tree(line.maker());
    CHECK(line.made_nodes().empty());
}

TEST_CASE("a walk that ends in the near half makes nothing of the far one") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    tree.nearest(0, 8);
    CHECK(line.made_nodes() == Nodes{0, 1, 3});
    tree.nearest(2.5, 3.5);
    CHECK(line.made_nodes() == Nodes{0, 1, 3, 4});
}

TEST_CASE("a walk that finds nothing goes on, up to its end and no farther") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    CHECK(tree.nearest(1.75, 2.5) == std::nullopt);
    CHECK(line.made_nodes() == Nodes{0, 1, 3, 4});
    CHECK(tree.nearest(3.5, 8) == 4.5);
    CHECK(line.made_nodes() == Nodes{0, 1, 2, 3, 4, 5});
}

TEST_CASE("downwards the half above is the near one") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    CHECK(tree.nearest(8, 0) == 7.0);
    CHECK(line.made_nodes() == Nodes{0, 2, 6});
}

TEST_CASE("a way that begins or ends in a plane has a point in both closed halves") {
    for (const double point : {1.0, 2.0, 3.0}) {
        Line line{{{0, plane(2)}, {1, leaf({})}, {2, leaf({})}}};
        line.nodes[point == 1.0 ? 1 : 2].points = {2.0};
        CAPTURE(point);
        LazyLine tree(line.maker());
        CHECK(tree.nearest(2, 5) == 2.0);
        CHECK(tree.nearest(2, -5) == 2.0);
        CHECK(tree.nearest(5, 2) == 2.0);
        CHECK(tree.nearest(-5, 2) == 2.0);
        CHECK(tree.nearest(2, 2) == 2.0);
    }
}

TEST_CASE("what is found in the plane keeps the walk out of the far half") {
    Line line{{{0, plane(2)}, {1, leaf({2.0})}, {2, leaf({2.5})}}};
    LazyLine tree(line.maker());
    CHECK(tree.nearest(0, 5) == 2.0);
    CHECK(line.made_nodes() == Nodes{0, 1});
}

TEST_CASE("a node that stands is not made again") {
    Line line = four_leaves();
    LazyLine tree(line.maker());
    for (int i = 0; i < 3; ++i) tree.nearest(0, 8), tree.nearest(8, 0);
    CHECK(line.made_nodes() == Nodes{0, 1, 2, 3, 6});
}

TEST_CASE("two trees know nothing of each other") {
    Line first = four_leaves(), second = four_leaves();
    LazyLine one(first.maker()), other(second.maker());
    one.nearest(0, 8);
    CHECK(second.made_nodes().empty());
    CHECK(other.nearest(8, 0) == 7.0);
    CHECK(second.made_nodes() == Nodes{0, 2, 6});
}

TEST_CASE("random walks in random trees find the first point, and make what they need") {
    Pcg32 random(51);
    std::size_t made = 0, all = 0;
    for (int i = 0; i < 3'000; ++i) {
        Line line;
        grow(line, 0, 0, 24, 6, random);
        LazyLine tree(line.maker());
        Nodes expected;
        for (int walk = 0; walk < 3; ++walk) {
            const double from = 0.25 * random.below(56) - 1.0, to = 0.25 * random.below(56) - 1.0;
            if (from == to) continue;  // in a plane, either half might come first
            CAPTURE(from, to);
            REQUIRE(tree.nearest(from, to) == first_of(line, from, to));
            expected.merge(needed(line, from, to));
            REQUIRE(line.made_nodes() == expected);
        }
        made += expected.size();
        all += line.nodes.size();
    }
    CHECK(4 * made < 3 * all);
}
