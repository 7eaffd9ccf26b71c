#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "chapters/ch03_bsp_trees/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch03 {

Chart fig_03_09(const Options& options) {
    return fragments_chart(measured_once<measure_growth>(options));
}

Chart fig_03_10(const Options& options) {
    return build_chart(measured_once<measure_growth>(options));
}

Chart fig_03_11(const Options& options) {
    return rays_chart(measured_once<measure_growth>(options));
}

Chart fig_03_12(const Options& options) {
    return grades_chart(measured_once<measure_grades>(options));
}

}  // namespace space::ch03
