#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "common/measure.hpp"

namespace space::ch09 {

Chart fig_09_16(const Options& options) {
    return motion_frames_chart(measured_once<measure_frames>(options));
}

Chart fig_09_18(const Options& options) {
    return motion_policies_chart(measured_once<measure_policies>(options));
}

Chart fig_09_15(const Options& options) {
    return motion_refits_chart(measured_once<measure_refits>(options));
}

}  // namespace space::ch09
