// What a node's eight bytes say in each of its states, and what leads from one to another.

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch05_lazy_kd_trees/figures.hpp"

#include <fmt/format.h>

#include <bitset>
#include <string>
#include <vector>

namespace space::ch05 {
namespace {

/// A part of the word; its width on the paper is not that of its bits.
struct Field {
    std::string what;
    double width;
};

constexpr double left = 190, row_height = 44;

void draw_word(Svg& svg, double y, const std::string& state, Ink ink,
               const std::vector<Field>& fields) {
    svg.text(at(left - 16, y + 28), state, {.anchor = Anchor::end, .ink = ink, .bold = true});
    double x = left;
    for (const Field& field : fields) {
        svg.rect(at(x, y), at(field.width, row_height), {.stroke = ink});
        svg.text(at(x + field.width / 2, y + 28), field.what, {.size = 17});
        x += field.width;
    }
}

/// From one state down to a later one, beside the words; `lane` keeps arrows apart.
void draw_arrow(Svg& svg, double from, double to, double lane, const std::string& text) {
    const double x = left + 456 + lane;
    svg.polyline({at(left + 446, from), at(x, from), at(x, to), at(left + 448, to)},
                 {.stroke = Ink::quiet, .arrow = true});
    svg.text(at(x + 8, 0.5 * (from + to) + 6), text, {.anchor = Anchor::start, .size = 17});
}

std::string low_bits(KdNode node) {
    return std::bitset<2>(node.bits() & 3u).to_string();
}

}  // namespace

Svg fig_05_03(const Options&) {
    const KdNode inner = KdNode::inner({1, 11.5f}, 2), leaf = KdNode::leaf(0, 3);
    Svg svg(
        "The bits of a node that waits, that is being made, and that stands, and the ways "
        "between these states",
        840, 330);
    const double waits = 40, made = 110, stands = 200, leaf_row = 254;
    svg.text(at(left + 190, 26), "61 bits", {.ink = Ink::quiet, .size = 17});
    svg.text(at(left + 401, 26), "bit 2, 1, 0", {.ink = Ink::quiet, .size = 17});
    draw_word(svg, waits, "waits", Ink::vermillion,
              {{"address of what waits", 360}, {"1", 28}, {"0", 28}, {"0", 28}});
    draw_word(svg, made, "is being made", Ink::green,
              {{"address of what waits", 360}, {"1", 28}, {"0", 28}, {"1", 28}});
    draw_word(svg, stands, "inner node", Ink::blue,
              {{fmt::format("position {}", inner.position()), 180},
               {fmt::format("children {}, {}", inner.below(), inner.below() + 1), 180},
               {inner.keeps() ? "1" : "0", 28},
               {low_bits(inner), 56}});
    draw_word(svg, leaf_row, "or leaf", Ink::blue,
              {{fmt::format("first {}", leaf.first()), 180},
               {fmt::format("count {}", leaf.count()), 180},
               {"0", 28},
               {low_bits(leaf), 56}});
    draw_arrow(svg, waits + 14, made + 14, 0, "first to come");
    draw_arrow(svg, made + 30, stands + 22, 0, "it stands");
    svg.polyline({at(24, made + 22), at(10, made + 22), at(10, waits + 22), at(96, waits + 22)},
                 {.stroke = Ink::quiet, .dashed = true, .arrow = true});
    svg.text(at(14, waits - 10), "it can't be made", {.anchor = Anchor::start, .size = 17});
    return svg;
}

}  // namespace space::ch05
