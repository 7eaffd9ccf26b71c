#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/measurements.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch01 {

Chart fig_01_07(const Options& options) {
    return growth_chart(measured_once<measure_growth>(options));
}

Chart fig_01_08(const Options& options) {
    return share_chart(measured_once<measure_shares>(options));
}

Chart fig_01_09(const Options& options) {
    return accuracy_chart(measured_once<measure_leaks>(options));
}

}  // namespace space::ch01
