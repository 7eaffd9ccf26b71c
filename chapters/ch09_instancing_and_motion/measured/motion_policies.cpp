#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "chapters/ch09_instancing_and_motion/measured/moving_scenes.hpp"
#include "chapters/ch09_instancing_and_motion/rebuild_policy.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch09 {
namespace {

struct PolicyLimits {
    std::size_t frames, rays;
};
PolicyLimits policy_limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {6, 100};
        case Amount::quick:
            return {15, 200};
        case Amount::full:
            break;
    }
    return {40, 400};
}

/// Costs of one ray a triangle, in each frame by each tree that may be there.
MotionCosts costs_of(const MovingScene& moving, const PolicyLimits& limit, const Options& options) {
    std::vector<std::vector<Triangle>> frames;
    for (std::size_t i = 0; i < limit.frames; ++i)
        frames.push_back(moving.at(double(i) / double(limit.frames)));
    const auto n = double(moving.rest.size());
    MotionCosts costs{.build = MotionUnits::binned * double(binned_references(frames[0])),
                      .refit = MotionUnits::refitted * n,
                      .traced = std::vector<std::vector<double>>(limit.frames),
                      .expected = std::vector<std::vector<double>>(limit.frames)};
    parallel_for(limit.frames, options.threads, 1, [&](std::size_t built) {
        RefittedBvh<> bvh = RefittedBvh<>::build(frames[built]);
        for (std::size_t frame = built; frame < limit.frames; ++frame) {
            if (frame > built) bvh.refit(frames[frame]);
            TraversalCounts counts;
            for (const Ray& ray : rays_from_around(frames[frame], limit.rays, options.seed + frame))
                bvh.closest_hit(ray, counts);
            const double per_ray =
                MotionUnits::of_rays(counts.nodes_visited, counts.triangles_tested) /
                double(limit.rays);
            costs.traced[built].push_back(n * per_ray);
            costs.expected[built].push_back(bvh.nodes().sah_cost({}));
        }
    });
    return costs;
}

MotionCosts with_rays(MotionCosts costs, double rays_per_triangle) {
    for (auto& row : costs.traced)
        for (double& cost : row) cost *= rays_per_triangle;
    return costs;
}

void add_policies(const MovingScene& moving, const MotionCosts& of_one, double rays_per_triangle,
                  std::vector<PolicyPoint>& points) {
    const MotionCosts costs = with_rays(of_one, rays_per_triangle);
    const double best = total_cost(costs, best_in_hindsight(costs));
    const auto add = [&](std::string policy, const Rebuilds& rebuilds) {
        points.push_back({.scene = moving.scene,
                          .motion = moving.motion,
                          .policy = std::move(policy),
                          .rays_per_triangle = rays_per_triangle,
                          .frames = costs.frames(),
                          .builds = std::uint64_t(std::ranges::count(rebuilds, true)),
                          .total = total_cost(costs, rebuilds),
                          .best = best});
    };
    add("best in hindsight", best_in_hindsight(costs));
    add("never", decided(RebuildEvery{costs.frames()}, costs));
    add("always", decided(RebuildEvery{1}, costs));
    add("every 10 frames", decided(RebuildEvery{10}, costs));
    for (const double factor : {1.2, 1.5, 2.0})
        add(fmt::format("cost > {:.1f}", factor), decided(RebuildByCost{factor}, costs));
    add("rent or buy", decided(RebuildByExcess{costs.build, costs.refit}, costs));
}

}  // namespace

std::vector<PolicyPoint> measure_policies(const Options& options) {
    const std::vector<MovingScene> scenes = moving_scenes(options);
    std::vector<PolicyPoint> points;
    Progress progress("policies", scenes.size());
    for (const MovingScene& moving : scenes) {
        const MotionCosts costs = costs_of(moving, policy_limits(options), options);
        for (const double rays : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0})
            add_policies(moving, costs, rays, points);
        progress.step();
    }
    return points;
}

}  // namespace space::ch09
