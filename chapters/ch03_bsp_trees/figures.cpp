#include "chapters/ch03_bsp_trees/figures.hpp"

#include "chapters/ch03_bsp_trees/drawings.hpp"

namespace space {
namespace {

constexpr Figure figures[] = {
    {"fig_03_01", FigureKind::drawing, draw_heinonen_plane},
    {"fig_03_02", FigureKind::drawing, draw_heinonen_tree},
    {"fig_03_03", FigureKind::drawing, draw_corners},
    {"fig_03_04", FigureKind::drawing, draw_painters_order},
    {"fig_03_05", FigureKind::drawing, draw_fragments_hit},
    {"fig_03_06", FigureKind::drawing, draw_chain},
    {"fig_03_07", FigureKind::drawing, draw_ray},
    {"fig_03_10", FigureKind::drawing, draw_step_through},
};

}  // namespace

std::span<const Figure> chapter03_figures() { return figures; }

}  // namespace space
