#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/measured/fast.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_charts.hpp"
#include "common/measure.hpp"

namespace space::ch10 {

Chart fig_10_02(const Options& options) {
    return ladder_chart(measured_once<measure_fast>(options).ladder);
}

Chart fig_10_03(const Options& options) {
    return ladder_exactness_chart(measured_once<measure_fast>(options).ladder);
}

Chart fig_10_04(const Options& options) {
    return fast_peers_chart(measured_once<measure_fast>(options).peers, diffuse_kind);
}

Chart fig_10_05(const Options& options) {
    return aimed_chart(measured_once<measure_fast>(options).aimed);
}

Chart fig_10_06(const Options& options) {
    return latency_chart(measured_once<measure_fast>(options).memory);
}

Chart fig_10_07(const Options& options) {
    return size_chart(measured_once<measure_fast>(options).sizes);
}

Chart fig_10_13(const Options& options) {
    return modes_chart(measured_once<measure_fast>(options).modes, camera_kind);
}

Chart fig_10_14(const Options& options) {
    return modes_chart(measured_once<measure_fast>(options).modes, diffuse_kind);
}

}  // namespace space::ch10
