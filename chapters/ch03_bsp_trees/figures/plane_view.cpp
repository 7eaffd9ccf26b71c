#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <algorithm>

namespace space::ch03 {

std::vector<Point2> PlaneView::operator()(const ConvexCell& cell) const {
    std::vector<Point2> points;
    for (const Double2& p : cell) points.push_back((*this)(p));
    return points;
}

Style cell_style(const Story& story, std::size_t cell) {
    // Cells in front of the root's splitter in one colour, those behind it in another.
    std::uint32_t node = story.cells[cell].node;
    bool in_front = story.cells[cell].in_front;
    while (node != 0) {
        in_front = story.turns[node].in_front;
        node = story.turns[node].parent;
    }
    constexpr double opacities[] = {0.14, 0.42, 0.26, 0.54, 0.2};
    return {
        .stroke = {}, .fill = in_front ? Ink::sky : Ink::orange, .opacity = opacities[cell % 5]};
}

void draw_segment(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                  const Style& style) {
    const Point2 a = view(from), b = view(to);
    const Vector2 along = glm::normalize(b - a), across = 2.2f * Vector2(-along.y, along.x);
    svg.polygon({a + across, b + across, b - across, a - across}, style);
}

Point2 beside(const PlaneView& view, const Double2& from, const Double2& to, double along,
              double away) {
    const Double2 way = glm::normalize(to - from), front(-way.y, way.x);
    return view(from + along * (to - from) + away / view.scale * front);
}

void draw_front_tick(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                     Ink ink) {
    svg.line(beside(view, from, to, 0.5, 0.0), beside(view, from, to, 0.5, 11.0), {.stroke = ink});
}

Point2 heinonen_name_place(const PlaneView& view, const Piece& piece) {
    const char letter = piece.name.front();
    const double away = letter == 'B' || letter == 'G' ? -21.0 : letter == 'C' ? 27.0 : 21.0;
    return moved(beside(view, piece.from, piece.to, letter == 'G' ? 0.3 : 0.5, away), 0, 7);
}

std::pair<Double2, Double2> line_in_cell(const Story& story, std::size_t turn) {
    const auto& plane = story.tree.planes[story.tree.nodes[turn].plane];
    const ConvexCell& cell = story.turns[turn].cell;
    std::vector<Double2> ends;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const Double2 &p = cell[i], &q = cell[(i + 1) % cell.size()];
        const double at_p = plane.distance(p), at_q = plane.distance(q);
        if (at_p * at_q < 0.0 || at_p == 0.0)
            ends.push_back(at_p == 0.0 ? p : p + at_p / (at_p - at_q) * (q - p));
    }
    // Of a line through a corner, rounding may leave more than two: the outermost are its ends.
    const Double2 along(plane.normal.y, -plane.normal.x);
    const auto [first, last] =
        std::ranges::minmax_element(ends, {}, [&](const Double2& p) { return glm::dot(p, along); });
    return {*first, *last};
}

}  // namespace space::ch03
