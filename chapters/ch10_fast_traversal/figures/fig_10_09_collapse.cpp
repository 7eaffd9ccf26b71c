// One binary tree, collapsed greedily and at the least cost.

#include "chapters/ch10_fast_traversal/collapse_choice.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"
#include "common/program/tree_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

using Choice4 = CollapseChoice<4, 2>;

CollapseConfig one_segment_leaves(CollapseConfig::Way way) {
    return {.way = way, .node_cost = 1.0, .block_cost = 1.0, .max_leaf = 1, .block_size = 1};
}

/// A wide node: the nodes of the binary tree that it takes the place of, the first of them on top.
struct Piece {
    std::vector<std::uint32_t> nodes;
    double chance;  ///< that a ray through the root meets it
};

/// The pieces in the order in which they are made.
std::vector<Piece> pieces_of(const BvhNodes<2>& tree, const Choice4& choice) {
    const HitChance<2> chance(tree.nodes[0].box);
    std::vector<Piece> pieces;
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
        const std::uint32_t top = waiting.back();
        waiting.pop_back();
        std::vector<std::uint32_t> children;
        choice.for_each_child(top, [&](std::uint32_t child) { children.push_back(child); });
        Piece piece{.nodes = {top}, .chance = chance(tree.nodes[top].box)};
        for (std::size_t i = 0; i < piece.nodes.size(); ++i)
            for (const std::uint32_t child :
                 {tree.nodes[piece.nodes[i]].first, tree.nodes[piece.nodes[i]].first + 1})
                if (std::ranges::find(children, child) == children.end())
                    piece.nodes.push_back(child);
        pieces.push_back(std::move(piece));
        for (std::size_t i = children.size(); i-- > 0;)
            if (!choice.row(children[i]).is_leaf) waiting.push_back(children[i]);
    }
    return pieces;
}

/// The binary tree, in the colours of the pieces that become wide nodes.
class CollapsePanel {
  public:
    CollapsePanel(const Walls<2>& walls, double left) : walls_(walls), left_(left) {
        std::vector<std::vector<std::size_t>> children(walls.binary.nodes.size());
        walls.binary.for_each_node([&](std::uint32_t index, unsigned) {
            const BvhNode<2>& node = walls.binary.nodes[index];
            if (!node.is_leaf()) children[index] = {node.first, node.first + 1u};
        });
        layout_ = tree_layout(children);
        for (const Double2& place : layout_) {
            levels_ = std::max(levels_, place.y);
            leaves_ = std::max(leaves_, place.x + 0.5);
        }
    }

    void draw(Svg& svg, const std::string& title, CollapseConfig::Way way) const {
        const Choice4 choice(walls_.binary, one_segment_leaves(way));
        const std::vector<Piece> pieces = pieces_of(walls_.binary, choice);
        svg.text(at(left_ + width / 2, 24), title, {.size = 19});
        for (std::size_t i = 0; i < pieces.size(); ++i) draw_edges(svg, pieces[i], wide_ink(i));
        for (std::size_t i = 0; i < pieces.size(); ++i) draw_nodes(svg, pieces[i], wide_ink(i));
        walls_.binary.for_each_node([&](std::uint32_t index, unsigned) {
            if (!walls_.binary.nodes[index].is_leaf()) return;
            svg.rect(moved(place(index), -12, -12), at(24, 24), {.fill = Ink::paper});
            svg.text(moved(place(index), 0, 6), "*" + walls_.name(index) + "*", {.size = 18});
        });
        std::vector<std::string> terms;
        double sum = 0.0;
        for (const Piece& piece : pieces) {
            terms.push_back(svg_number(piece.chance));
            sum += piece.chance;
        }
        svg.text(at(left_ + width / 2, 358), fmt::format("{} wide nodes", pieces.size()),
                 {.size = 18});
        svg.text(at(left_ + width / 2, 382),
                 fmt::format("{} = {:.2f}", fmt::join(terms, " + "), sum),
                 {.size = terms.size() > 4 ? 16.0 : 18.0});
    }

  private:
    static constexpr double width = 330;

    Point2 place(std::uint32_t node) const {
        return at(left_ + width / leaves_ * layout_[node].x, 58 + 262 / levels_ * layout_[node].y);
    }
    void draw_edges(Svg& svg, const Piece& piece, Ink ink) const {
        for (const std::uint32_t node : piece.nodes)
            for (const std::uint32_t child :
                 {walls_.binary.nodes[node].first, walls_.binary.nodes[node].first + 1})
                svg.line(place(node), place(child), {.stroke = ink});
    }
    /// The one on top is the wide node; the others are opened.
    void draw_nodes(Svg& svg, const Piece& piece, Ink ink) const {
        for (const std::uint32_t node : piece.nodes) {
            const bool is_top = node == piece.nodes.front();
            svg.circle(place(node), 15, {.stroke = ink, .fill = Ink::paper});
            svg.circle(place(node), 15,
                       {.stroke = ink,
                        .fill = is_top ? std::optional(ink) : std::nullopt,
                        .opacity = 0.3});
            svg.text(moved(place(node), 0, 6), walls_.name(node), {.size = 17});
        }
    }

    const Walls<2>& walls_;
    double left_, levels_ = 1.0, leaves_ = 1.0;
    std::vector<Double2> layout_;
};

}  // namespace

Svg fig_10_09(const Options&) {
    const Walls<2> walls = walls_on<2>(clustered_segments(1625, 3, 3));
    Svg svg(
        "A binary tree of segments, collapsed to nodes of four: greedily, and at the least cost",
        700, 394);
    CollapsePanel(walls, 8).draw(svg, "greedily", CollapseConfig::Way::greedy);
    CollapsePanel(walls, 362).draw(svg, "at the least cost", CollapseConfig::Way::least_cost);
    return svg;
}

}  // namespace space::ch10
