#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/measured/builds.hpp"
#include "common/measure.hpp"

namespace space::ch08 {

Chart fig_08_02(const Options& options) {
    return gains_chart(measured_once<measure_scenes>(options).points);
}

Chart fig_08_03(const Options& options) {
    return build_growth_chart(measured_once<measure_build_growth>(options));
}

Chart fig_08_04(const Options& options) {
    return quality_chart(measured_once<measure_scenes>(options).points);
}

}  // namespace space::ch08
