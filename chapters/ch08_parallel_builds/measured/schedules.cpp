#include "chapters/ch08_parallel_builds/measured/schedules.hpp"

#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "chapters/ch08_parallel_builds/measured/schedule_runs.hpp"
#include "chapters/ch08_parallel_builds/record_tasks.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <utility>

namespace space::ch08 {
namespace {

using Kind = ParallelMethod::Kind;
using Condition = ParallelMethod::Condition;
using Doing = CoreRun::Doing;

/// Of this order on the machine that the text was measured on; for runs without a clock.
constexpr NodeCost usual_node{.node = 140.0, .triangle = 24.0, .bin = 42.0};
constexpr double usual_boxing = 45.0, usual_joining = 60.0;  ///< of a triangle, of a node; ns
constexpr MeasuredCosts usual_costs{.thread_start_us = 20.0,
                                    .lock_ns = 100.0,
                                    .steal_us = 2.0,
                                    .chunk_us = 1.0,
                                    .serial_share = 0.02};

std::vector<std::string> scenes_for(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {"icosphere:8", "stadium", "building:1"};
        case Amount::quick:
            return {"icosphere:60", "soup:50000", "building:3"};
        default: {
            std::vector<std::string> scenes;
            for (const PublishedBuild& row : published_builds())
                if (row.threads == 2) scenes.emplace_back(row.stand_in);
            return scenes;
        }
    }
}

/// The middle time of a build that nobody watches, in nanoseconds.
double unwatched_ns(std::span<const Triangle> triangles, int rounds) {
    const std::function<void()> run = [&] {
        do_not_optimize(BinnedBuilder::build<3>(triangles).nodes.data());
    };
    return 1e6 * interleaved_medians(std::span(&run, 1), rounds).front();
}

/// Looking at the clock slows a build, and warms or cools its caches: costs are scaled until they
/// add up to the time of a build without it.
RecordedBuild recorded(const std::string& scene, std::vector<Triangle> triangles, bool is_timed) {
    RecordedBuild build{scene, std::move(triangles)};
    TaskGraph& graph = build.graph;
    if (is_timed) {
        graph = timed_tasks(build.triangles, 3);
        build.scaled = unwatched_ns(build.triangles, 3) / graph.total();
        for (TaskNode& node : graph.nodes) node.cost *= build.scaled;
        graph.boxing *= build.scaled;
        graph.joining *= build.scaled;
    } else {
        graph = counted_tasks<3>(build.triangles, usual_node);
        graph.boxing = usual_boxing * double(build.triangles.size());
        graph.joining = usual_joining * double(graph.nodes.size());
    }
    return build;
}

GraphPoint described(const RecordedBuild& build) {
    const TaskGraph& graph = build.graph;
    const TaskNode& root = graph.nodes.front();
    GraphPoint point{.scene = build.scene, .n = root.triangles, .nodes = graph.nodes.size()};
    for (const TaskNode& node : graph.nodes)
        point.depth = std::max<std::uint64_t>(point.depth, node.depth);
    if (!root.is_leaf())
        point.larger_share = double(std::max(graph.nodes[root.first].triangles,
                                             graph.nodes[root.first + 1].triangles)) /
                             double(root.triangles);
    point.scaled = build.scaled;
    point.total_ms = 1e-6 * graph.total();
    point.boxing_ms = 1e-6 * graph.boxing;
    point.joining_ms = 1e-6 * graph.joining;
    point.critical_ms = 1e-6 * (critical_path(graph) - graph.boxing - graph.joining);
    std::vector<std::pair<std::uint32_t, double>> largest;
    for (const TaskNode& node : graph.nodes) largest.push_back({node.triangles, node.cost});
    const auto end = largest.begin() + std::ptrdiff_t(std::min<std::size_t>(4, largest.size()));
    std::partial_sort(largest.begin(), end, largest.end(), std::greater<>());
    for (auto each = largest.begin(); each != end; ++each) point.top_ms += 1e-6 * each->second;
    const CostFormula formula = fitted_cost(graph);
    point.node_ns = formula.cost.node;
    point.triangle_ns = formula.cost.triangle;
    point.bin_ns = formula.cost.bin;
    point.formula_error = formula.largest_error;
    return point;
}

SimulatedPoint simulated(const RecordedBuild& build, const MeasuredCosts& costs,
                         const NamedMethod& method, unsigned cores, bool has_bandwidth) {
    const Schedule schedule =
        simulate(build.graph, method.method, cores, scheduling_costs(costs, has_bandwidth));
    const double all = schedule.makespan * cores;
    return {.scene = build.scene,
            .method = method.name,
            .cores = cores,
            .has_bandwidth = has_bandwidth,
            .ms = 1e-6 * schedule.makespan,
            .gain = build.graph.total() / schedule.makespan,
            .idle = schedule.idle() / all,
            .lock_wait = schedule.spent(Doing::lock_wait) / all};
}

/// All methods from 1 to 256 cores, with as much memory as they ask for, and on 64 with this
/// machine's; the queue's conditions on four.
void simulate_all(const RecordedBuild& build, const MeasuredCosts& costs, const Options& options,
                  std::vector<SimulatedPoint>& points) {
    struct Simulation {
        NamedMethod method;
        unsigned cores;
        bool has_bandwidth;
    };
    std::vector<Simulation> all;
    for (const NamedMethod& method : compared_methods(options.small))
        for (unsigned cores = 1; cores <= 256; cores *= 2) {
            all.push_back({method, cores, false});
            if (costs.bandwidth_share() > 0.0 && (cores == 64 || method.name == ours))
                all.push_back({method, cores, true});
        }
    for (const NamedMethod& method : condition_methods()) all.push_back({method, 4, false});
    const std::size_t first = points.size();
    points.resize(first + all.size());
    parallel_for(all.size(), options.threads, 1, [&](std::size_t i) {
        const auto& [method, cores, has_bandwidth] = all[i];
        points[first + i] = simulated(build, costs, method, cores, has_bandwidth);
    });
}

/// Nothing for a file that this machine does not have; says so.
std::vector<RecordedBuild> recorded_build(const std::string& scene, const Options& options,
                                          bool is_timed) {
    try {
        std::vector<Triangle> triangles =
            make_scene(scene, options.seed, options.small).mesh.triangles();
        return {recorded(scene, std::move(triangles), is_timed)};
    } catch (const Error& error) {
        fmt::print(stderr, "left out: {}\n", error.what());
        return {};
    }
}

}  // namespace

std::vector<NamedMethod> compared_methods(bool small) {
    const ParallelMethod queue{.kind = Kind::queue, .big_scene = small ? 1'000u : 500'000u};
    ParallelMethod stealing;
    if (small) stealing.large = 512, stealing.chunk = 64, stealing.grain = 32;
    return {{symmetric, {.kind = Kind::symmetric}},
            {asymmetric, {.kind = Kind::asymmetric}},
            {by_queue, queue},
            {ours, stealing}};
}

std::vector<NamedMethod> condition_methods() {
    std::vector<NamedMethod> methods;
    constexpr std::array conditions{Condition::threads, Condition::twice_threads,
                                    Condition::threads_to_threads, Condition::depth};
    for (std::size_t i = 0; i < conditions.size(); ++i)
        methods.push_back({queue_conditions[i], {.kind = Kind::queue, .condition = conditions[i]}});
    return methods;
}

SchedulingCosts scheduling_costs(const MeasuredCosts& costs, bool has_bandwidth) {
    return {.thread_start = 1e3 * costs.thread_start_us,
            .lock = costs.lock_ns,
            .steal = 1e3 * costs.steal_us,
            .chunk = 1e3 * costs.chunk_us,
            .serial_share = costs.serial_share,
            .bandwidth_share = has_bandwidth ? costs.bandwidth_share() : 0.0};
}

ScheduleMeasurements measure_schedules(const Options& options) {
    ScheduleMeasurements measured{.is_timed = !options.small && !options.counts,
                                  .costs = usual_costs};
    if (options.counts) return measured;  // nothing is the same on every machine
    const std::vector<std::string> scenes = scenes_for(options);
    const int rounds = options.quick ? 3 : 7;
    Progress progress("schedules", scenes.size());
    for (const std::string& scene : scenes) {
        for (const RecordedBuild& build : recorded_build(scene, options, measured.is_timed)) {
            measured.graphs.push_back(described(build));
            // By the first scene, which is among the larger ones.
            if (measured.is_timed && measured.graphs.size() == 1)
                measured.costs = measure_costs(build, rounds);
            simulate_all(build, measured.costs, options, measured.simulated);
            if (!measured.is_timed) continue;
            for (const ValidationPoint& point :
                 validate(build, scheduling_costs(measured.costs, true), 3))
                measured.validation.push_back(point);
        }
        progress.step();
    }
    return measured;
}

const SimulatedPoint* simulated_point(const std::vector<SimulatedPoint>& points,
                                      std::string_view scene, std::string_view method,
                                      unsigned cores, bool has_bandwidth) {
    for (const SimulatedPoint& point : points)
        if (point.scene == scene && point.method == method && point.cores == cores &&
            point.has_bandwidth == has_bandwidth)
            return &point;
    return nullptr;
}

}  // namespace space::ch08
