#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/outcome.hpp"
#include "common/measure.hpp"

namespace space::ch07 {

Chart fig_07_04(const Options& options) {
    return leaves_chart(measured_once<measure_leaves>(options));
}

Chart fig_07_06(const Options& options) {
    return accuracy_chart(measured_once<measure_accuracy>(options));
}

Chart fig_07_07(const Options& options) {
    return pareto_chart(measured_once<measure_trees>(options));
}

Chart fig_07_08(const Options& options) {
    return growth_chart(measured_once<measure_growth>(options));
}

Chart fig_07_09(const Options& options) {
    return steps_chart(measured_once<measure_growth>(options));
}

Chart fig_07_10(const Options& options) {
    return peers_chart(measured_once<measure_trees>(options));
}

}  // namespace space::ch07
