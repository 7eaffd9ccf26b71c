#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "chapters/ch08_parallel_builds/measured/schedule_runs.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "chapters/ch08_parallel_builds/stealing_parts.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/measure.hpp"

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace space::ch08 {
namespace {

// The simulator's method is the builder's.
static_assert(ParallelMethod{}.large == StealingSizes{}.large &&
              ParallelMethod{}.chunk == StealingSizes{}.chunk &&
              ParallelMethod{}.grain == StealingSizes{}.grain);

template <class Builder>
std::function<void()> build_of(std::span<const Triangle> triangles, unsigned threads) {
    typename Builder::Config config;
    config.threads = threads;
    return [=] { do_not_optimize(Builder::template build<3>(triangles, config).nodes.data()); };
}

std::function<void()> build_by(std::string_view method, std::span<const Triangle> triangles,
                               unsigned threads) {
    if (method == symmetric) return build_of<SymmetricBuilder>(triangles, threads);
    if (method == by_queue) return build_of<QueueBuilder>(triangles, threads);
    return build_of<WorkStealingBuilder>(triangles, threads);
}

}  // namespace

std::vector<ValidationPoint> validate(const RecordedBuild& build, const SchedulingCosts& costs,
                                      int rounds) {
    std::vector<ValidationPoint> points;
    std::vector<std::function<void()>> runs;
    for (const NamedMethod& method : compared_methods(false))
        for (const unsigned threads : {1u, 2u}) {
            if (method.name == asymmetric || (threads == 1 && method.name == by_queue)) continue;
            runs.push_back(build_by(method.name, build.triangles, threads));
            points.push_back(
                {.scene = build.scene,
                 .method = method.name,
                 .threads = threads,
                 .simulated_ms =
                     1e-6 * simulate(build.graph, method.method, threads, costs).makespan});
        }
    const std::vector<double> ms = interleaved_medians(runs, rounds);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].measured_ms = ms[i];
    return points;
}

}  // namespace space::ch08
