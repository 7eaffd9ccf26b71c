#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/figures/drawn_edge.hpp"

namespace space::ch02 {

Svg fig_02_02(const Options&) {
    const Ray aim = edge_ray(edge_a, edge_c, edge_share);
    const EdgeScene scene{.a = edge_a,
                          .b = edge_b,
                          .c = edge_c,
                          .d = edge_d,
                          .aim = aim,
                          .step = edge_step(aim),
                          .tests = edge_tests};
    return drawn_edge(scene, edge_verdicts(scene));
}

}  // namespace space::ch02
