#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/measured/instanced.hpp"
#include "common/measure.hpp"

namespace space::ch09 {

Chart fig_09_10(const Options& options) {
    return away_chart(measured_once<measure_accuracy>(options));
}

Chart fig_09_02(const Options& options) {
    return accuracy_chart(measured_once<measure_accuracy>(options));
}

Chart fig_09_03(const Options& options) {
    return levels_chart(measured_once<measure_levels>(options));
}

}  // namespace space::ch09
