#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <string>

namespace space::ch06 {
namespace {

/// Names along an axis have no room for sizes, which the tables have.
Chart without_sizes(Chart chart) {
    for (std::string& scene : chart.categories)
        scene.resize(std::min(scene.find(':'), scene.size()));
    return chart;
}

}  // namespace

Chart fig_06_03(const Options& options) {
    return points_chart(measured_once<measure_points>(options));
}

Chart fig_06_05(const Options& options) {
    return depths_chart(measured_once<measure_depths>(options));
}

Chart fig_06_06(const Options& options) {
    return without_sizes(shapes_chart(measured_once<measure_trees>(options)));
}

Chart fig_06_08(const Options& options) {
    return without_sizes(rays_chart(measured_once<measure_trees>(options)));
}

Chart fig_06_10(const Options& options) {
    return build_chart(measured_once<measure_growth>(options));
}

Chart fig_06_14(const Options& options) {
    return adaptive_chart(measured_once<measure_adaptive>(options));
}

}  // namespace space::ch06
