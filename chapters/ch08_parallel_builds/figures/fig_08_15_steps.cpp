// A tree of 16 segments by three cores.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/drawn_stealing.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

namespace space::ch08 {

Svg fig_08_15(const Options&) {
    const TaskGraph graph = lopsided_graph();
    return drawn_stealing(
        graph, simulate(graph, stealing_method, stealing_cores, {.steal = stealing_cost}));
}

}  // namespace space::ch08
