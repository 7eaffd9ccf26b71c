// Figures 12 and 13 of BvhThesis13: who makes which node where nodes start threads.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <string>
#include <utility>
#include <vector>

namespace space::ch08 {

Svg fig_08_07(const Options&) {
    constexpr unsigned cores = 4;
    const TaskGraph graph = mirrored_graph();
    Svg svg(
        "The same tree twice, built by four cores: by the asymmetric and by the symmetric "
        "method",
        676, 660);
    draw_core_names(svg, at(120, 6), cores);
    double top = 74;
    for (const auto& [name, kind] : {std::pair{"asymmetric", ParallelMethod::Kind::asymmetric},
                                     std::pair{"symmetric", ParallelMethod::Kind::symmetric}}) {
        const Schedule schedule = simulate(graph, {.kind = kind}, cores);
        const std::vector<MadeBy> made = makers(graph, schedule);
        const std::vector<Point2> places =
            tree_places(graph, {.corner = at(28, top), .slot = 40, .level = 44});
        svg.text(at(14, top), name, {.anchor = Anchor::start, .bold = true});
        draw_edges(svg, graph, places);
        for (std::size_t i = 0; i < places.size(); ++i)
            draw_task(svg, graph.nodes[i], places[i], core_ink(made[i].core), true,
                      std::to_string(made[i].core));
        top += 316;
    }
    return svg;
}

}  // namespace space::ch08
