#include "chapters/ch03_bsp_trees/figures.hpp"

#include "chapters/ch03_bsp_trees/drawings.hpp"

namespace space {
namespace {

constexpr Figure figures[] = {
    {"fig_03_01", FigureKind::drawing, draw_heinonen_plane},
    {"fig_03_02", FigureKind::drawing, draw_heinonen_tree},
    {"fig_03_10", FigureKind::drawing, draw_step_through},
};

}  // namespace

std::span<const Figure> chapter03_figures() { return figures; }

}  // namespace space
