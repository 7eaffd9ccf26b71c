#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/pcg32.hpp"
#include "common/scene.hpp"
#include "tests/check.hpp"

#include <map>

// The exercise is to do without the tree's own: the compiler refuses it from here on.
#pragma GCC poison depth
#include "ex08_growth.hpp"

using namespace space;

namespace {

using Tree = BspTree<2>;

Tree tree_of(const std::vector<Segment>& segments) {
    return BspBuilder<2>::build(segments, {.splitter = BspConfig::SplitterChoice::first});
}

void levels_below(const Tree& tree, std::uint32_t node, std::size_t level,
                  std::vector<std::size_t>& levels) {
    if (node == Tree::none) return;
    levels.push_back(level);
    levels_below(tree, tree.nodes[node].front, level + 1, levels);
    levels_below(tree, tree.nodes[node].back, level + 1, levels);
}

void check(const Growth& growth, const Growth& wanted) {
    CAPTURE(growth.cuts, growth.most_pieces, growth.levels, growth.mean_level);
    CHECK(growth.cuts == wanted.cuts);
    CHECK(growth.most_pieces == wanted.most_pieces);
    CHECK(growth.levels == wanted.levels);
    REQUIRE(Error{std::abs(growth.mean_level - wanted.mean_level), 1e-9 * wanted.mean_level});
}

}  // namespace

TEST_CASE("of nothing nothing grows") {
    check(growth_of(Tree{}), Growth{});
}

TEST_CASE("parallel segments become a chain without a cut") {
    std::vector<Segment> segments;
    for (int i = 0; i < 7; ++i) segments.push_back({Point2(0, i), Point2(4, i)});
    check(growth_of(tree_of(segments)), {0, 1, 7, 4.0});
}

TEST_CASE("segments in one line share a node") {
    check(growth_of(tree_of({{{0, 0}, {1, 0}}, {{2, 0}, {3, 0}}, {{5, 0}, {4, 0}}})),
          {0, 1, 1, 1.0});
}

TEST_CASE("a segment that two lines cut has three pieces") {
    // Two in the first's line, whose node they share; the last is cut by both lines.
    check(growth_of(
              tree_of({{{0, 0}, {4, 0}}, {{5, 0}, {6, 0}}, {{0, 2}, {4, 2}}, {{2, -2}, {2, 4}}})),
          {2, 3, 3, 2.2});
}

TEST_CASE("trees of random segments are counted node by node") {
    Pcg32 random(38);
    const auto place = [&] { return static_cast<float>(random.below(17)); };
    for (int i = 0; i < 50; ++i) {
        std::vector<Segment> segments;
        while (segments.size() < 40) {
            const float ax = place(), ay = place(), bx = place(), by = place();
            if (ax != bx || ay != by) segments.push_back({{ax, ay}, {bx, by}});
        }
        const Tree tree = tree_of(segments);
        std::map<std::uint32_t, std::size_t> pieces;
        for (const auto& fragment : tree.fragments) ++pieces[fragment.polygon];
        std::vector<std::size_t> levels;
        levels_below(tree, 0, 1, levels);
        Growth wanted;
        for (const auto& [polygon, count] : pieces) {
            wanted.cuts += count - 1;
            wanted.most_pieces = std::max(wanted.most_pieces, count);
        }
        for (const std::size_t level : levels) {
            wanted.levels = std::max(wanted.levels, level);
            wanted.mean_level += static_cast<double>(level) / static_cast<double>(levels.size());
        }
        check(growth_of(tree), wanted);
    }
}

TEST_CASE("a chain of 400,000 levels is counted") {
    Tree tree;
    for (std::uint32_t i = 0; i < 400'000; ++i) {
        const Segment segment{Point2(i, 1), Point2(i, 0)};
        tree.polygons.push_back(segment);
        tree.planes.emplace_back(segment);
        tree.fragments.push_back(whole_polygon<2>(segment, i));
        tree.nodes.push_back({i, i + 1 < 400'000 ? i + 1 : Tree::none, Tree::none, i, 1});
    }
    check(growth_of(tree), {0, 1, 400'000, 200'000.5});
}
