// Who works when, by four methods on four cores.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/drawn_methods.hpp"
#include "common/scene.hpp"

namespace space::ch08 {

Svg fig_08_11(const Options&) {
    const TaskGraph graph = formula_graph(make_scene("building:1").mesh.triangles());
    return drawn_methods(graph, four_schedules(graph, 4, formula_costs));
}

}  // namespace space::ch08
