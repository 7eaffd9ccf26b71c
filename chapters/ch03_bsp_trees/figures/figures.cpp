#include "chapters/ch03_bsp_trees/figures/figures.hpp"

#include "chapters/ch03_bsp_trees/figures/drawings.hpp"
#include "chapters/ch03_bsp_trees/measured/measurements.hpp"

namespace space::ch03 {
namespace {

/// Only what the chart shows is measured.
template <auto measure, auto chart>
void measured_chart(const Options& options) {
    write_chart(options.out, chart(measure(options)));
}

constexpr Figure figures[] = {
    {"fig_03_01", FigureKind::drawing, draw_heinonen_plane},
    {"fig_03_02", FigureKind::drawing, draw_heinonen_tree},
    {"fig_03_03", FigureKind::drawing, draw_corners},
    {"fig_03_04", FigureKind::drawing, draw_painters_order},
    {"fig_03_05", FigureKind::drawing, draw_fragments_hit},
    {"fig_03_06", FigureKind::drawing, draw_chain},
    {"fig_03_07", FigureKind::drawing, draw_ray},
    {"fig_03_09", FigureKind::rendering, draw_painting},
    {"fig_03_10", FigureKind::drawing, draw_step_through},
    {"fig_03_11", FigureKind::chart, measured_chart<measure_growth, fragments_chart>},
    {"fig_03_12", FigureKind::chart, measured_chart<measure_growth, build_chart>},
    {"fig_03_13", FigureKind::chart, measured_chart<measure_grades, grades_chart>},
    {"fig_03_14", FigureKind::chart, measured_chart<measure_growth, rays_chart>},
};

}  // namespace

std::span<const Figure> chapter03_figures() {
    return figures;
}

}  // namespace space::ch03
