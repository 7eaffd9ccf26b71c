// Figure 16 of BvhThesis13: both thread methods on both kinds of scenes.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <fmt/format.h>

#include <string>

namespace space::ch08 {

Svg fig_08_10(const Options&) {
    constexpr unsigned cores = 4;
    Svg svg(
        "Who works when, on four cores: two methods that start threads, on a lopsided scene and "
        "on one that is its own mirror image",
        660, 384);
    draw_core_names(svg, at(120, 6), cores);
    const TaskGraph graphs[] = {lopsided_graph(), mirrored_graph()};
    constexpr std::string_view names[] = {"lopsided", "mirrored"};
    for (std::size_t scene = 0; scene < 2; ++scene)
        for (const bool second : {false, true}) {
            const ParallelMethod method{.kind = second ? ParallelMethod::Kind::symmetric
                                                       : ParallelMethod::Kind::asymmetric};
            const Schedule schedule = simulate(graphs[scene], method, cores);
            const Point2 corner = at(scene == 0 ? 10 : 345, second ? 244 : 84);
            svg.text(moved(corner, 0, -12),
                     fmt::format("{}, {}: {:.2f} times", names[scene],
                                 second ? "symmetric" : "asymmetric",
                                 graphs[scene].total() / schedule.makespan),
                     {.anchor = Anchor::start});
            draw_bars(svg, schedule, graphs[scene],
                      {.corner = corner, .width = 305, .row = 28, .time = 100.0});
        }
    return svg;
}

}  // namespace space::ch08
