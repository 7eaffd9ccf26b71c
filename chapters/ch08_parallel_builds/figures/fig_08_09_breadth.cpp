// Figure 17 of BvhThesis13: breadth first while nodes go through the queue, then depth first.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace space::ch08 {

Svg fig_08_09(const Options&) {
    constexpr unsigned cores = 4;
    const TaskGraph graph = mirrored_graph();
    const Schedule schedule = simulate(graph,
                                       {.kind = ParallelMethod::Kind::queue,
                                        .condition = ParallelMethod::Condition::depth,
                                        .deepest = 1},
                                       cores, {.lock = 0.25});
    const std::vector<MadeBy> made = makers(graph, schedule);
    std::vector<std::size_t> order(made.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return made[i].begin; });
    std::vector<std::size_t> turn(made.size());
    for (std::size_t i = 0; i < order.size(); ++i) turn[order[i]] = i + 1;

    Svg svg("A tree whose first levels are made breadth first by a queue, and the rest depth first",
            676, 316);
    draw_core_names(svg, at(120, 6), cores);
    const std::vector<Point2> places =
        tree_places(graph, {.corner = at(28, 70), .slot = 40, .level = 44});
    draw_edges(svg, graph, places);
    for (std::size_t i = 0; i < places.size(); ++i)
        draw_task(svg, graph.nodes[i], places[i], core_ink(made[i].core), !made[i].in_subtree,
                  std::to_string(turn[i]));
    return svg;
}

}  // namespace space::ch08
