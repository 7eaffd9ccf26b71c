#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "chapters/ch04_kd_trees/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch04 {

Chart fig_04_06(const Options& options) {
    return build_chart(measured_once<measure_growth>(options));
}

Chart fig_04_08(const Options& options) {
    return rules_chart(measured_once<measure_trees>(options));
}

Chart fig_04_10(const Options& options) {
    return care_chart(measured_once<measure_care>(options));
}

Chart fig_04_11(const Options& options) {
    return rays_chart(measured_once<measure_growth>(options));
}

Chart fig_04_13(const Options& options) {
    return points_chart(measured_once<measure_point_searches>(options));
}

}  // namespace space::ch04
