#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/pcg32.hpp"
#include "common/scene.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <limits>

// The exercise is to do without the tree's own: the compiler refuses it from here on.
#pragma GCC poison back_to_front
#include "ex04_painters_order.hpp"

using namespace space;

namespace {

using Tree = BspTree<2>;
using Order = std::vector<std::uint32_t>;

Tree tree_of(const std::vector<Segment>& segments) {
    return BspBuilder<2>::build(segments, {.splitter = BspConfig::SplitterChoice::first});
}

/// Where in the order the fragments of a subtree stand.
struct Range {
    std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;

    bool is_empty() const { return first > last; }
    void extend(const Range& other) {
        first = std::min(first, other.first);
        last = std::max(last, other.last);
    }
    bool is_before(const Range& other) const {
        return is_empty() || other.is_empty() || last < other.first;
    }
};

struct Faults {
    /// Fragments; a number that no fragment has counts as twice.
    std::size_t lost = 0, twice = 0;
    int nodes = 0;  ///< of which what is near comes before what is far
    bool operator==(const Faults&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Faults& faults) {
    return out << faults.lost << " fragments lost, " << faults.twice
               << " numbers twice or unknown, " << faults.nodes << " nodes in a wrong order";
}

Faults faults(const Tree& tree, const Point2& eye, const Order& order) {
    Faults found;
    std::vector<Range> places(tree.fragments.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool known = order[i] < places.size() && places[order[i]].is_empty();
        if (known)
            places[order[i]] = {i, i};
        else
            ++found.twice;
    }
    found.lost = static_cast<std::size_t>(std::count_if(
        places.begin(), places.end(), [](const Range& place) { return place.is_empty(); }));

    // Of a node and everything below it, which comes after it.
    std::vector<Range> below(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const Tree::Node& node = tree.nodes[i];
        const auto of = [&](std::uint32_t child) {
            return child == Tree::none ? Range{} : below[child];
        };
        const Range front = of(node.front), back = of(node.back);
        Range own;
        for (std::uint32_t k = 0; k < node.count; ++k) own.extend(places[node.first + k]);
        const int side = tree.side_of(eye, node);
        const Range &far = side > 0 ? back : front, &near = side > 0 ? front : back;
        const bool either = side == 0 && (far.is_before(near) || near.is_before(far));
        found.nodes +=
            !(either || (far.is_before(own) && own.is_before(near) && far.is_before(near)));
        below[i] = own;
        below[i].extend(front);
        below[i].extend(back);
    }
    return found;
}

/// Parallel segments at x = 0, 1, ..., each in front of the one before: a level for each.
Tree chain(std::uint32_t count) {
    Tree tree;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        const Segment segment{Point2(x, 1), Point2(x, 0)};  // front: larger x
        tree.polygons.push_back(segment);
        tree.planes.emplace_back(segment);
        tree.fragments.push_back(whole_polygon<2>(segment, i));
        const auto next = i + 1 < count ? i + 1 : Tree::none;
        tree.nodes.push_back({i, next, Tree::none, i, 1});
    }
    return tree;
}

}  // namespace

TEST_CASE("one node: what is beyond its line comes first, what is on the eye's side last") {
    const Tree tree = tree_of({{{0, 0}, {4, 0}}, {{0, 2}, {4, 2}}, {{0, -2}, {4, -2}}});
    CHECK(tree.nodes.size() == 3);
    const auto polygons = [&](const Point2& eye) {
        Order seen;
        for (const std::uint32_t number : painters_order(tree, eye))
            seen.push_back(tree.fragments[number].polygon);
        return seen;
    };
    CHECK(polygons({2, 9}) == Order{2, 0, 1});
    CHECK(polygons({2, -9}) == Order{1, 0, 2});
}

TEST_CASE("no tree, no order") {
    CHECK(painters_order(Tree{}, {0, 0}).empty());
}

TEST_CASE("Heinonen's segments are in order from every whole point around and among them") {
    const Tree tree = tree_of(heinonen_segments());
    for (int y = -4; y <= 20; ++y)
        for (int x = -4; x <= 20; ++x) {
            const Point2 eye(x, y);
            CAPTURE(eye);
            REQUIRE(faults(tree, eye, painters_order(tree, eye)) == Faults{});
        }
}

TEST_CASE("an eye on the plane of a node loses nothing") {
    // Two lie on the first's line, and one on the fourth's: nodes with more fragments than one.
    const Tree tree = tree_of({{{0, 0}, {4, 0}},
                               {{0, 2}, {4, 2}},
                               {{0, -2}, {4, -2}},
                               {{6, 1}, {6, 9}},
                               {{-4, 0}, {-2, 0}},
                               {{-1, 0}, {-2, 0}},
                               {{6, 12}, {6, 14}}});
    CHECK(tree.nodes[0].count == 3);
    for (const Point2 eye :
         {Point2(9, 0), Point2(2, 0), Point2(-3, 2), Point2(6, -5), Point2(6, 0), Point2(5, 5)}) {
        CAPTURE(eye);
        REQUIRE(faults(tree, eye, painters_order(tree, eye)) == Faults{});
    }
}

TEST_CASE(
    "random segments are in order from a thousand eyes, on planes, off them and nearly on them") {
    Pcg32 random(34);
    const auto place = [&] { return static_cast<float>(random.below(33)) - 16.0f; };
    std::vector<Segment> segments;
    while (segments.size() < 60) {
        const Segment segment{{place(), place()}, {place(), place()}};
        if (segment.a != segment.b) segments.push_back(segment);
    }
    const Tree tree = tree_of(segments);
    CHECK(tree.fragments.size() > 100);
    for (int i = 0; i < 1000; ++i) {
        Point2 eye = segments[random.below(60)].a;
        if (i % 3 == 0) eye = {place(), place()};
        if (i % 3 == 1) eye += 0x1p-18f * Point2(1, -1);  // only just off it
        CAPTURE(eye);
        REQUIRE(faults(tree, eye, painters_order(tree, eye)) == Faults{});
    }
}

TEST_CASE("a tree of 400,000 levels is painted without recursion") {
    const Tree tree = chain(400'000);
    for (const float x : {-1.0f, 0.0f, 50'000.5f, 399'999.0f, 800'000.0f}) {
        const Point2 eye(x, 0.5f);
        CAPTURE(eye);
        REQUIRE(faults(tree, eye, painters_order(tree, eye)) == Faults{});
    }
}
