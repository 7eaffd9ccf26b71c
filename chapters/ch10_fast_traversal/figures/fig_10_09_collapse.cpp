// One binary tree, collapsed greedily and at the least cost.

#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/collapse_tree.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace space::ch10 {
namespace {

void draw_collapse(Svg& svg, const Walls<2>& walls, double left, const std::string& title,
                   CollapseConfig::Way way) {
    constexpr double width = 330;
    const Choice4 choice(walls.binary, one_segment_leaves(way));
    const std::vector<Piece> pieces = pieces_of(walls.binary, choice);
    const CollapseTree tree(walls, at(left, 58), at(width, 262));
    const double middle = left + width / 2;
    svg.text(at(middle, 24), title, {.size = 19});
    std::vector<std::string> terms;
    double sum = 0.0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        tree.draw_piece(svg, pieces[i], wide_ink(i));
        terms.push_back(svg_number(pieces[i].chance));
        sum += pieces[i].chance;
    }
    svg.text(at(middle, 358), fmt::format("{} wide nodes", pieces.size()), {.size = 18});
    svg.text(at(middle, 382), fmt::format("{} = {:.2f}", fmt::join(terms, " + "), sum),
             {.size = terms.size() > 4 ? 16.0 : 18.0});
}

}  // namespace

Svg fig_10_09(const Options&) {
    const auto walls = walls_on<2>(clustered_segments(4821, 3, 3));
    Svg svg(
        "A binary tree of segments, collapsed to nodes of four: greedily, and at the least cost",
        700, 394);
    draw_collapse(svg, walls, 8, "greedily", CollapseConfig::Way::greedy);
    draw_collapse(svg, walls, 362, "at the least cost", CollapseConfig::Way::least_cost);
    return svg;
}

}  // namespace space::ch10
