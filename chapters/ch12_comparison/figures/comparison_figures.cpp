#include "chapters/ch12_comparison/figures.hpp"
#include "chapters/ch12_comparison/figures/accuracy_chart.hpp"
#include "chapters/ch12_comparison/figures/advice_charts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"
#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "chapters/ch12_comparison/measured/advice_fit.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "common/measure.hpp"

namespace space::ch12 {

Chart fig_12_02(const Options& options) {
    return pareto_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_03(const Options& options) {
    return regret_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_04(const Options& options) {
    return ray_kinds_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_05(const Options& options) {
    return growth_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_06(const Options& options) {
    return memory_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_07(const Options& options) {
    return break_even_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_08(const Options& options) {
    return total_cost_chart(measured_once<measure_comparison>(options));
}

Chart fig_12_09(const Options& options) {
    return advice_chart(measured_once<measure_advice>(options));
}

Chart fig_12_10(const Options& options) {
    return advice_misses_chart(measured_once<measure_advice>(options));
}

Chart fig_12_11(const Options& options) {
    return accuracy_chart(measured_once<measure_accuracy>(options));
}

Chart fig_12_13(const Options& options) {
    return decision_chart(measured_once<measure_comparison>(options));
}

}  // namespace space::ch12
