// The collapse at the least cost, step by step: from the leaves up what each node costs in so many
// places, then from the root down what was chosen.

#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/collapse_tree.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

constexpr std::size_t places = 3;  ///< of the node above that are asked for: one less than all

/// What a step is about: a node that is asked, or a piece that is chosen; none at the start.
struct CollapseStep {
    std::optional<std::uint32_t> asked;
    std::size_t chosen = 0;  ///< pieces that are there by now
    std::string tells;
};

class CollapseStage {
  public:
    CollapseStage() { write_script(); }
    void draw(Svg& svg) const;

  private:
    void write_script();
    std::string tells_costs(std::uint32_t node) const;
    std::string tells_piece(const Piece& piece) const;
    double cost(std::uint32_t node, std::size_t in) const {
        return double{choice_.row(node).cost[in - 1]};
    }
    std::string names(const std::vector<std::uint32_t>& nodes) const {
        std::vector<std::string> words;
        for (const std::uint32_t node : nodes) words.push_back(walls_.name(node));
        return fmt::format("{}", fmt::join(words, ", "));
    }
    void draw_tree(Svg& svg, const CollapseStep& step) const;
    void draw_row(Svg& svg, double y, std::uint32_t node, Ink ink) const;
    void draw_plane(Svg& svg, const CollapseStep& step) const;

    Walls<2> walls_ = walls_on<2>(clustered_segments(4821, 3, 3));
    Choice4 choice_{walls_.binary, one_segment_leaves(CollapseConfig::Way::least_cost)};
    std::vector<Piece> pieces_ = pieces_of(walls_.binary, choice_);
    CollapseTree tree_{walls_, at(8, 30), at(370, 300)};
    std::vector<CollapseStep> steps_;
    PlaneView view_{.corner = {452, 134}, .scale = 216 / heinonen_size, .size = heinonen_size};
};

/// How a node stands in the places that it may take.
std::string CollapseStage::tells_costs(std::uint32_t node) const {
    const Choice4::Row& row = choice_.row(node);
    const std::uint32_t first = walls_.binary.nodes[node].first;
    std::string text = fmt::format("Node {}. In one place, as a wide node: {:.2f}.",
                                   walls_.name(node), cost(node, 1));
    constexpr std::array<const char*, 2> words{"two", "three"};
    for (std::size_t in = 2; in <= places; ++in) {
        const std::size_t used = row.opened[in - 1], of_first = row.first[in - 1];
        text += used < in ? fmt::format(" In {}: no better.", words[in - 2])
                          : fmt::format(" In {}, {} for {} and {} for {}: {:.2f}.", words[in - 2],
                                        of_first, walls_.name(first), in - of_first,
                                        walls_.name(first + 1), cost(node, in));
    }
    return text;
}

std::string CollapseStage::tells_piece(const Piece& piece) const {
    const std::vector<std::uint32_t> opened(piece.nodes.begin() + 1, piece.nodes.end());
    return fmt::format("Node {} becomes a wide node, {}. Its children are {}.",
                       walls_.name(piece.nodes.front()),
                       opened.empty() ? "and nothing in it is opened"
                                      : fmt::format("in which {} {} opened", names(opened),
                                                    opened.size() == 1 ? "is" : "are"),
                       names(piece.children));
}

void CollapseStage::write_script() {
    steps_.push_back({.asked = {},
                      .tells = fmt::format(
                          "A binary tree over {} segments. Wide nodes will have four places. From "
                          "the leaves up each node says what it costs in one, two or three places "
                          "of a node above it.",
                          walls_.segments.size())});
    std::vector<std::uint32_t> inner;
    walls_.binary.for_each_node([&](std::uint32_t index, unsigned) {
        if (!walls_.binary.nodes[index].is_leaf()) inner.push_back(index);
    });
    std::ranges::sort(inner, std::greater{});
    for (const std::uint32_t node : inner)
        if (node != 0) steps_.push_back({.asked = node, .tells = tells_costs(node)});
    steps_.push_back(
        {.asked = 0,
         .tells = fmt::format("The root has four places to give: the least of all sums is {:.2f}, "
                              "and its own visit costs 1.",
                              cost(0, 1) - 1.0)});
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        steps_.push_back({.asked = {}, .chosen = i + 1, .tells = tells_piece(pieces_[i])});
    const Choice4 greedy(walls_.binary, one_segment_leaves(CollapseConfig::Way::greedy));
    steps_.push_back(
        {.asked = {},
         .chosen = pieces_.size(),
         .tells = fmt::format(
             "{} wide nodes, of which a ray through the root is expected to pay {:.2f}, leaves "
             "included. Opened greedily it would be {:.2f}.",
             pieces_.size(), cost_of(walls_.binary, pieces_),
             cost_of(walls_.binary, pieces_of(walls_.binary, greedy)))});
}

void CollapseStage::draw_tree(Svg& svg, const CollapseStep& step) const {
    const auto ink_of = [&](std::uint32_t node) {
        if (!step.asked) return Ink::quiet;
        const std::uint32_t first = walls_.binary.nodes[*step.asked].first;
        return node == *step.asked                                          ? Ink::green
               : node == first                                              ? Ink::blue
               : node == first + 1                                          ? Ink::vermillion
               : node > *step.asked && !walls_.binary.nodes[node].is_leaf() ? Ink::ink
                                                                            : Ink::quiet;
    };
    const auto for_each = [&](const auto& visit) {
        walls_.binary.for_each_node([&](std::uint32_t index, unsigned) { visit(index); });
    };
    for_each([&](std::uint32_t node) {
        if (walls_.binary.nodes[node].is_leaf()) return;
        const std::uint32_t first = walls_.binary.nodes[node].first;
        for (const std::uint32_t child : {first, first + 1})
            tree_.draw_edge(svg, node, child, step.asked == node ? ink_of(child) : Ink::quiet);
    });
    for_each([&](std::uint32_t node) { tree_.draw_node(svg, node, ink_of(node), false); });
    for (std::size_t i = 0; i < step.chosen; ++i) tree_.draw_piece(svg, pieces_[i], wide_ink(i));
}

void CollapseStage::draw_row(Svg& svg, double y, std::uint32_t node, Ink ink) const {
    svg.text(at(480, y), walls_.name(node), {.ink = ink, .size = 18});
    for (std::size_t in = 1; in <= places; ++in)
        svg.text(at(500 + 52 * static_cast<double>(in), y), fmt::format("{:.2f}", cost(node, in)),
                 {.ink = ink, .size = 18});
}

/// The boxes of the node that is asked and of its children, or of what was chosen last.
void CollapseStage::draw_plane(Svg& svg, const CollapseStep& step) const {
    const auto box = [&](std::uint32_t node, double larger, Ink ink) {
        draw_box_on(svg, view_, walls_.binary.nodes[node].box, larger,
                    {.stroke = ink, .fill = ink, .opacity = 0.14});
    };
    if (step.asked) {
        const std::uint32_t first = walls_.binary.nodes[*step.asked].first;
        box(*step.asked, 4, Ink::green);
        box(first, 1, Ink::blue);
        box(first + 1, 1, Ink::vermillion);
    } else if (step.chosen > 0) {
        const Ink ink = wide_ink(step.chosen - 1);
        for (const std::uint32_t child : pieces_[step.chosen - 1].children) box(child, 1, ink);
    }
}

void CollapseStage::draw(Svg& svg) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const CollapseStep& step = steps_[k];
        svg.begin_step_alone(k, steps_.size(), step.tells);
        draw_tree(svg, step);
        draw_plane(svg, step);
        if (step.asked) {
            const std::uint32_t first = walls_.binary.nodes[*step.asked].first;
            svg.text(at(480, 26), "places", {.ink = Ink::quiet, .size = 17});
            for (int in = 1; in <= static_cast<int>(places); ++in)
                svg.text(at(500 + 52 * in, 26), std::to_string(in),
                         {.ink = Ink::quiet, .size = 17});
            draw_row(svg, 54, first, Ink::blue);
            draw_row(svg, 80, first + 1, Ink::vermillion);
            if (*step.asked != 0) draw_row(svg, 112, *step.asked, Ink::green);
        }
        svg.end_group();
    }
    svg.rect(view_({0, heinonen_size}), at(216, 216), {.stroke = Ink::faint});
    for (const NamedSegment& segment : walls_.named) {
        draw_segment(svg, view_, segment.from, segment.to, {.stroke = {}, .fill = Ink::ink});
        svg.text(heinonen_name_place(view_, segment), drawn_name(segment.name),
                 {.size = 18, .halo = true});
    }
}

}  // namespace

Svg fig_10_15(const Options&) {
    Svg svg("A binary tree of segments, collapsed to nodes of four at the least cost, step by step",
            688, 360);
    CollapseStage().draw(svg);
    return svg;
}

}  // namespace space::ch10
