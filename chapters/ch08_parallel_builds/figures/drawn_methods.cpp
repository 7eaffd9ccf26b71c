#include "chapters/ch08_parallel_builds/figures/drawn_methods.hpp"

#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/record_tasks.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

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

TaskGraph formula_graph(std::span<const Triangle> triangles) {
    TaskGraph graph = counted_tasks<3>(triangles, {.node = 140.0, .triangle = 24.0, .bin = 42.0});
    graph.boxing = 45.0 * graph.nodes.front().triangles;
    graph.joining = 60.0 * double(graph.nodes.size());
    return graph;
}

std::array<DrawnSchedule, 4> four_schedules(const TaskGraph& graph, unsigned cores,
                                            const SchedulingCosts& costs) {
    using Kind = ParallelMethod::Kind;
    const auto by = [&](std::string_view name, const ParallelMethod& method) {
        return DrawnSchedule{name, simulate(graph, method, cores, costs)};
    };
    return {by("asymmetric", {.kind = Kind::asymmetric}),
            by("symmetric", {.kind = Kind::symmetric}), by("queue", {.kind = Kind::queue}),
            by("work stealing", {.large = 4'096, .chunk = 512, .grain = 256})};
}

Svg drawn_methods(const TaskGraph& graph, const std::array<DrawnSchedule, 4>& schedules) {
    constexpr double width = 640;
    const unsigned cores = schedules[0].schedule.cores;
    const double row = cores <= 8 ? 18 : 12, height = 35 + row * cores;
    Svg svg(fmt::format("Who works when while four methods build the same tree on {} cores",
                        cores == 4 ? "four" : std::to_string(cores)),
            660, 44 + 4 * height);
    if (cores <= 4)
        draw_core_names(svg, at(120, 6), cores);
    else
        svg.text(at(10, 22), fmt::format("{} cores; above, core 0", cores),
                 {.anchor = Anchor::start, .bold = true});
    double longest = 0.0;
    for (const DrawnSchedule& drawn : schedules)
        longest = std::max(longest, drawn.schedule.makespan);
    double top = 44;
    for (const auto& [name, schedule] : schedules) {
        svg.text(at(10, top + 14),
                 fmt::format("{}: {:.2f} times", name, graph.total() / schedule.makespan),
                 {.anchor = Anchor::start});
        for (const CoreRun& run : stretches(schedule, longest / width)) {
            const double left = width * run.begin / longest, right = width * run.end / longest;
            svg.rect(at(10 + left, top + 22 + row * run.core), at(right - left, row - 4),
                     {.stroke = {}, .fill = core_ink(run.core)});
        }
        const double end = 10 + width * schedule.makespan / longest;
        svg.line(at(end, top + 20), at(end, top + 20 + row * cores), {.stroke = Ink::ink});
        top += height;
    }
    return svg;
}

}  // namespace space::ch08
