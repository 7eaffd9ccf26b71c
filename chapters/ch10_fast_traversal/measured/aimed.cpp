#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/measured/wrong_hits.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "common/aimed_rays.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// A scene with aimed rays, and the naive loop's answers: exact arithmetic's.
struct AimedScene {
    std::string name;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    Answers truth;

    AimedScene(const std::string& scene, std::size_t count, const Options& options)
        : name(scene),
          triangles(make_scene(scene, options.seed).mesh.triangles()),
          rays(rays_at_edges(triangles, count, options.seed)),
          truth(rays.size()) {
        const auto naive = Naive<FilteredExact>::build(triangles);
        parallel_for(rays.size(), options.threads, 64,
                     [&](std::size_t i) { truth[i] = closest_hit(naive, rays[i]); });
    }
};

void measure_tracers(const AimedScene& scene, int rounds, FastMeasurements& measured) {
    std::vector<Tracer> all;
    all.push_back(our_tracer("ours", FastBvh<>::build(scene.triangles)));
    all.push_back(our_tracer("ours, compressed", CompressedBvh<>::build(scene.triangles)));
    all.push_back(our_tracer("binary, float test",
                             Bvh<BinnedBuilder, MollerTrumboreFloat>::build(scene.triangles)));
    all.push_back(our_tracer("binary, watertight test",
                             Bvh<BinnedBuilder, Watertight>::build(scene.triangles)));
    if (rounds > 0)
        for (Tracer& tracer : embree_tracers(scene.triangles, {embree_default, embree_robust}))
            all.push_back(std::move(tracer));
    std::vector<std::function<void()>> runs;
    for (const Tracer& tracer : all)
        runs.push_back([&] { tracer.trace(scene.rays, ManyQuery::closest); });
    const std::vector<double> ms =
        rounds > 0 ? thread_medians(runs, rounds) : std::vector<double>(all.size(), 0.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Answers got = all[i].answers(scene.rays, ManyQuery::closest);
        const bool is_ours = all[i].name.starts_with("ours");
        measured.aimed.push_back({.scene = scene.name,
                                  .tracer = all[i].name,
                                  .triangles = scene.triangles.size(),
                                  .rays = scene.rays.size(),
                                  // Of ours a single bit is too much.
                                  .wrong = is_ours
                                               ? differences(got, scene.truth, ManyQuery::closest)
                                               : wrong_hits(got, scene.truth),
                                  .ns = 1e6 * ms[i] / double(scene.rays.size())});
    }
}

template <int N>
void measure_kernels(const AimedScene& scene, FastMeasurements& measured, bool on_any_machine) {
    for (const InstructionSet set : usable_instruction_sets()) {
        // Tables of counts name what every machine has.
        if (on_any_machine && set != InstructionSet::scalar && set != InstructionSet::portable)
            continue;
        WideBvhConfig<QuickBuilder> config;
        config.instructions = set;
        const auto bvh = WideBvh<N, QuickBuilder>::build(scene.triangles, config);
        KernelPoint point{.scene = scene.name,
                          .instruction_set = std::string(name_of(set)),
                          .width = N,
                          .triangles = scene.triangles.size(),
                          .rays = scene.rays.size()};
        for (std::size_t i = 0; i < scene.rays.size(); ++i)
            point.differ += closest_hit(bvh, scene.rays[i]) != scene.truth[i] ||
                            any_hit(bvh, scene.rays[i]) != scene.truth[i].has_value();
        measured.kernels.push_back(std::move(point));
    }
}

}  // namespace

void measure_aimed(const Options& options, FastMeasurements& measured) {
    const FastEffort effort = fast_effort(options);
    Progress progress("aimed rays", effort.aimed.size());
    for (const std::string& name : effort.aimed) {
        const AimedScene scene(name, effort.aimed_rays, options);
        measure_tracers(scene, effort.rounds, measured);
        const bool on_any_machine = effort.rounds == 0;
        measure_kernels<4>(scene, measured, on_any_machine);
        measure_kernels<8>(scene, measured, on_any_machine);
        progress.step();
    }
}

}  // namespace space::ch10
