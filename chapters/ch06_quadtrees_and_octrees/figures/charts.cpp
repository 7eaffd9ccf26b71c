#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch06 {

Chart fig_06_03(const Options& options) {
    return points_chart(measured_once<measure_points>(options));
}

Chart fig_06_05(const Options& options) {
    return depths_chart(measured_once<measure_depths>(options));
}

Chart fig_06_07(const Options& options) {
    return rays_chart(measured_once<measure_trees>(options));
}

Chart fig_06_09(const Options& options) {
    return build_chart(measured_once<measure_growth>(options));
}

Chart fig_06_13(const Options& options) {
    return adaptive_chart(measured_once<measure_adaptive>(options));
}

}  // namespace space::ch06
