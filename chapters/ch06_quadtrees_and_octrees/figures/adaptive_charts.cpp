#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "common/measure.hpp"

namespace space::ch06 {

Chart fig_06_13(const Options& options) {
    return adaptive_chart(measured_once<measure_adaptive>(options));
}

}  // namespace space::ch06
