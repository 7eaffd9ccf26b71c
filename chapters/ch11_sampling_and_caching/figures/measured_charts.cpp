#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/measured/convergence.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "common/measure.hpp"

namespace space::ch11 {

Chart fig_11_02(const Options& options) {
    return convergence_chart(measured_once<measure_convergence>(options), "ring");
}

Chart fig_11_03(const Options& options) {
    return convergence_chart(measured_once<measure_convergence>(options), "interior");
}

Chart fig_11_04(const Options& options) {
    return lightings_chart(measured_once<measure_sampling>(options).lightings);
}

Chart fig_11_06(const Options& options) {
    return patterns_chart(measured_once<measure_sampling>(options).patterns);
}

}  // namespace space::ch11
