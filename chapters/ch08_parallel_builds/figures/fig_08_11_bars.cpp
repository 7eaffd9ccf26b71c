// Who works when, by four methods on four cores.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/record_tasks.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch08 {
namespace {

/// What a core works at a stretch: gaps too narrow to be seen are closed.
std::vector<CoreRun> stretches(const Schedule& schedule, double narrow) {
    std::vector<CoreRun> all;
    for (unsigned core = 0; core < schedule.cores; ++core) {
        bool is_first = true;
        for (const CoreRun& run : schedule.runs) {
            if (run.core != core || !is_work(run.doing)) continue;
            if (!is_first && run.begin - all.back().end < narrow)
                all.back().end = run.end;
            else
                all.push_back(run);
            is_first = false;
        }
    }
    return all;
}

}  // namespace

Svg fig_08_11(const Options&) {
    constexpr unsigned cores = 4;
    constexpr double width = 640, row = 18;
    // Nanoseconds, about as on our machine.
    TaskGraph graph = counted_tasks<3>(make_scene("building:1").mesh.triangles(),
                                       {.node = 140.0, .triangle = 24.0, .bin = 42.0});
    graph.boxing = 45.0 * graph.nodes.front().triangles;
    graph.joining = 60.0 * double(graph.nodes.size());
    const SchedulingCosts costs{
        .thread_start = 15e3, .lock = 100.0, .steal = 2e3, .chunk = 1e3, .serial_share = 0.05};
    using Kind = ParallelMethod::Kind;
    const DrawnMethod methods[] = {{"asymmetric", {.kind = Kind::asymmetric}},
                                   {"symmetric", {.kind = Kind::symmetric}},
                                   {"queue", {.kind = Kind::queue}},
                                   {"work stealing", {.large = 4'096, .chunk = 512, .grain = 256}}};
    Svg svg("Who works when while four methods build the same tree on four cores", 660, 472);
    draw_core_names(svg, at(120, 6), cores);
    double longest = 0.0;
    for (const DrawnMethod& drawn : methods)
        longest = std::max(longest, simulate(graph, drawn.method, cores, costs).makespan);
    double top = 44;
    for (const DrawnMethod& drawn : methods) {
        const Schedule schedule = simulate(graph, drawn.method, cores, costs);
        svg.text(at(10, top + 14),
                 fmt::format("{}: {:.2f} times", drawn.name, graph.total() / schedule.makespan),
                 {.anchor = Anchor::start});
        for (const CoreRun& run : stretches(schedule, longest / width)) {
            const double left = width * run.begin / longest, right = width * run.end / longest;
            svg.rect(at(10 + left, top + 22 + row * run.core), at(right - left, row - 4),
                     {.stroke = {}, .fill = core_ink(run.core)});
        }
        const double end = 10 + width * schedule.makespan / longest;
        svg.line(at(end, top + 20), at(end, top + 20 + row * cores), {.stroke = Ink::ink});
        top += 107;
    }
    return svg;
}

}  // namespace space::ch08
