#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <algorithm>

namespace space::ch03 {

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

Point2 heinonen_name_place(const PlaneView& view, const Piece& piece) {
    return heinonen_name_place(view, NamedSegment{piece.name, piece.from, piece.to});
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
    if (ends.empty()) return {Double2(plane.through.a), Double2(plane.through.b)};  // a thin cell
    // Of a line through a corner, rounding may leave more than two: the outermost are its ends.
    const Double2 along(plane.normal.y, -plane.normal.x);
    const auto [first, last] =
        std::ranges::minmax_element(ends, {}, [&](const Double2& p) { return glm::dot(p, along); });
    return {*first, *last};
}

}  // namespace space::ch03
