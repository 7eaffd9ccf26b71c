#include "chapters/ch05_lazy_kd_trees/figures.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch05 {

Chart fig_05_05(const Options& options) {
    return reach_chart(measured_once<measure_reach>(options));
}

Chart fig_05_06(const Options& options) {
    return memory_chart(measured_once<measure_memory>(options));
}

Chart fig_05_08(const Options& options) {
    return first_picture_chart(measured_once<measure_first_pictures>(options));
}

}  // namespace space::ch05
