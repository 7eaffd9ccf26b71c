#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"
#include "common/measure.hpp"

namespace space::ch09 {

Chart fig_09_12(const Options& options) {
    return nesting_memory_chart(measured_once<measure_nesting>(options));
}

Chart fig_09_13(const Options& options) {
    return nesting_speed_chart(measured_once<measure_nesting>(options));
}

}  // namespace space::ch09
