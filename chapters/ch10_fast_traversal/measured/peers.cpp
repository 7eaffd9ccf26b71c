#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

BuildPoint build_point(const TracedScene& scene, std::string_view structure,
                       const TreeShape& shape) {
    return {.scene = scene.name,
            .structure = std::string(structure),
            .triangles = scene.triangles.size(),
            .nodes = shape.nodes.value_or(0) - shape.leaves.value_or(0),
            .blocks = shape.leaves.value_or(0),
            .bytes = shape.bytes,
            .depth = shape.depth.value_or(0),
            .cost = shape.sah_cost.value_or(0.0)};
}

/// Whole builds, interleaved; of large scenes one.
void time_builds(const TracedScene& scene, const FastEffort& effort,
                 std::vector<BuildPoint>& points) {
    if (effort.rounds == 0) return;
    const int rounds = scene.triangles.size() < 300'000 ? effort.rounds : 1;
    std::vector<std::vector<double>> times(points.size());
    const auto ours = [&](const auto& build) {
        const double before = process_ms();
        do_not_optimize(build());
        return process_ms() - before;
    };
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::string& name = points[i].structure;
            const bool is_high = name == "high";
            if (is_high && round > 0) continue;
            times[i].push_back(
                name == embree_default ? embree_build_ms(scene.triangles)
                : is_high              ? ours([&] { return FastHighBvh<>::build(scene.triangles); })
                : name == "fast"       ? ours([&] { return FastBvh<>::build(scene.triangles); })
                                 : ours([&] { return CompressedBvh<>::build(scene.triangles); }));
        }
    for (std::size_t i = 0; i < points.size(); ++i) points[i].ms = median(times[i]);
}

/// Real time of a ray by two threads together.
std::vector<double> two_thread_times(const std::vector<Tracer>& tracers, const TracedScene& scene,
                                     RayKind kind, int rounds) {
    const std::span<const Ray> rays = scene.rays[kind];
    static constexpr std::size_t block = 512;
    std::vector<std::function<void()>> runs;
    for (const Tracer& tracer : tracers)
        runs.push_back([&tracer, rays, kind] {
            parallel_for((rays.size() + block - 1) / block, 2, 1, [&](std::size_t i) {
                const std::size_t first = i * block;
                tracer.trace(rays.subspan(first, std::min(block, rays.size() - first)),
                             query_of(kind));
            });
        });
    std::vector<double> times = interleaved_medians(runs, rounds);
    for (double& ms : times) ms *= 1e6 / double(rays.size());
    return times;
}

}  // namespace

void measure_peers(const TracedScene& scene, const Options& options, FastMeasurements& measured) {
    const FastEffort effort = fast_effort(options);
    std::vector<Tracer> all;
    {
        const BvhNodes<3> binary = QuickBuilder::build<3>(scene.triangles);
        all.push_back(our_tracer("fast", FastBvh<>::over(binary, scene.triangles)));
        all.push_back(our_tracer("compressed", CompressedBvh<>::over(binary, scene.triangles)));
    }
    const bool has_high = scene.triangles.size() <= effort.most_high;
    if (has_high) all.push_back(our_tracer("high", FastHighBvh<>::build(scene.triangles)));
    const std::size_t ours = all.size();
    if (effort.rounds > 0)
        for (Tracer& tracer :
             embree_tracers(scene.triangles, {embree_default, embree_robust, embree_high}))
            all.push_back(std::move(tracer));

    std::vector<BuildPoint> builds;
    for (const Tracer& tracer : all)
        if (tracer.name != embree_robust && tracer.name != embree_high)
            builds.push_back(build_point(scene, tracer.name, tracer.shape));
    time_builds(scene, effort, builds);
    for (BuildPoint& point : builds) measured.builds.push_back(std::move(point));

    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
        if (scene.rays[kind].empty()) continue;
        PeerPoint point{.scene = scene.name,
                        .is_long = scene.is_long,
                        .kind = kind,
                        .triangles = scene.triangles.size(),
                        .rays = scene.ray_count(kind)};
        for (std::size_t i = 0; i < ours; ++i)
            point.differ += differences(all[i].answers(scene.rays[kind], query_of(kind)),
                                        scene.answers[kind], query_of(kind));
        const std::vector<double> ns = ray_times(all, scene, kind, effort.rounds);
        point.ours_ns = ns[0];
        point.compressed_ns = ns[1];
        if (has_high) point.ours_high_ns = ns[2];
        if (all.size() > ours) {
            point.embree_ns = ns[ours];
            point.robust_ns = ns[ours + 1];
            point.embree_high_ns = ns[ours + 2];
            const std::vector<double> both =
                two_thread_times({all[0], all[ours]}, scene, kind, effort.rounds);
            point.two_threads_ns = both[0];
            point.embree_two_threads_ns = both[1];
        }
        measured.peers.push_back(point);
    }
}

}  // namespace space::ch10
