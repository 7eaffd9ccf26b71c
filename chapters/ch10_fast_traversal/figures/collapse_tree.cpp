#include "chapters/ch10_fast_traversal/figures/collapse_tree.hpp"

#include "common/program/tree_layout.hpp"

#include <algorithm>
#include <utility>

namespace space::ch10 {

CollapseConfig one_segment_leaves(CollapseConfig::Way way) {
    return {.way = way, .node_cost = 1.0, .block_cost = 1.0, .max_leaf = 1, .block_size = 1};
}

std::vector<Piece> pieces_of(const BvhNodes<2>& tree, const Choice4& choice) {
    const HitChance<2> chance(tree.nodes[0].box);
    std::vector<Piece> pieces;
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
        const std::uint32_t top = waiting.back();
        waiting.pop_back();
        Piece piece{.nodes = {top}, .children = {}, .chance = chance(tree.nodes[top].box)};
        choice.for_each_child(top, [&](std::uint32_t child) { piece.children.push_back(child); });
        for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
            const std::uint32_t first = tree.nodes[piece.nodes[i]].first;
            for (const std::uint32_t child : {first, first + 1})
                if (std::ranges::find(piece.children, child) == piece.children.end())
                    piece.nodes.push_back(child);
        }
        for (std::size_t i = piece.children.size(); i-- > 0;)
            if (!choice.row(piece.children[i]).is_leaf) waiting.push_back(piece.children[i]);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

double cost_of(const BvhNodes<2>& tree, const std::vector<Piece>& pieces) {
    const HitChance<2> chance(tree.nodes[0].box);
    double cost = 0.0;
    for (const Piece& piece : pieces) cost += piece.chance;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (tree.nodes[index].is_leaf()) cost += chance(tree.nodes[index].box);
    });
    return cost;
}

CollapseTree::CollapseTree(const Walls<2>& walls, Point2 corner, Vector2 size)
    : walls_(walls), corner_(corner), size_(size) {
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

Point2 CollapseTree::place(std::uint32_t node) const {
    return moved(corner_, double{size_.x} / leaves_ * layout_[node].x,
                 double{size_.y} / levels_ * layout_[node].y);
}

void CollapseTree::draw_edge(Svg& svg, std::uint32_t node, std::uint32_t child, Ink ink) const {
    svg.line(place(node), place(child), {.stroke = ink});
}

void CollapseTree::draw_node(Svg& svg, std::uint32_t node, Ink ink, bool filled) const {
    const Point2 at_node = place(node);
    if (walls_.binary.nodes[node].is_leaf()) {
        svg.rect(moved(at_node, -12, -12), at(24, 24), {.stroke = ink, .fill = Ink::paper});
        svg.text(moved(at_node, 0, 6), "*" + walls_.name(node) + "*", {.ink = ink, .size = 18});
        return;
    }
    svg.circle(at_node, 15, {.stroke = ink, .fill = Ink::paper});
    if (filled) svg.circle(at_node, 15, {.stroke = ink, .fill = ink, .opacity = 0.3});
    svg.text(moved(at_node, 0, 6), walls_.name(node), {.size = 17});
}

void CollapseTree::draw_piece(Svg& svg, const Piece& piece, Ink ink) const {
    for (const std::uint32_t node : piece.nodes) {
        const std::uint32_t first = walls_.binary.nodes[node].first;
        for (const std::uint32_t child : {first, first + 1}) draw_edge(svg, node, child, ink);
    }
    for (const std::uint32_t node : piece.nodes)
        draw_node(svg, node, ink, node == piece.nodes.front());
    for (const std::uint32_t child : piece.children)
        if (walls_.binary.nodes[child].is_leaf()) draw_node(svg, child, Ink::ink, false);
}

}  // namespace space::ch10
