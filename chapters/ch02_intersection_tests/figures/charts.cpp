// Only what a chart shows is measured for it.

#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/measured/measurements.hpp"
#include "chapters/ch02_intersection_tests/measured/outcome.hpp"

namespace space::ch02 {

Chart fig_02_03(const Options& options) {
    return triangle_chart(measure(options, {count_leaks, time_triangles}));
}

Chart fig_02_07(const Options& options) {
    return box_chart(measure(options, {count_boxes, time_patterns}));
}

Chart fig_02_09(const Options& options) {
    return sphere_chart(measure(options, {count_spheres, time_others}));
}

Chart fig_02_11(const Options& options) {
    return root_chart(measure(options, {count_roots, time_others}));
}

}  // namespace space::ch02
