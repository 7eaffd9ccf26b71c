#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/views.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

namespace space::ch05 {
namespace {

/// Rays that start near the triangles of one side of the scene, and are aimed at them.
std::vector<Ray> rays_to_part(const std::vector<Triangle>& triangles,
                              const std::vector<std::uint32_t>& in_order, double share,
                              std::size_t count, std::uint64_t seed) {
    const auto part = std::uint32_t(std::min(1.0, share) * double(triangles.size()));
    std::vector<Ray> rays;
    Pcg32 random(seed);
    while (part > 0 && rays.size() < count) {
        const Triangle& at = triangles[in_order[random.below(part)]];
        const Point3 aim = (at.a + at.b + at.c) / 3.0f;
        const Point3 origin(Double3(aim) + 0.1 * random_direction(random));
        rays.push_back({.origin = origin, .direction = aim - origin});
    }
    return rays;
}

/// Builds, makes all nodes if so wanted, and asks each ray.
template <class Tree>
void build_and_trace(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays,
                     bool all) {
    const auto tree = Tree::build(triangles);
    if constexpr (requires { tree.build_all(); })
        if (all) tree.build_all();
    for (const Ray& ray : rays) do_not_optimize(closest_hit(tree, ray));
}

}  // namespace

std::vector<ReachPoint> measure_reach(const Options& options) {
    const Limits limit = limits(options);
    const std::vector<Triangle> triangles =
        plants(std::min(limit.plants, 10u), options.seed).scene.mesh.triangles();
    std::vector<std::uint32_t> in_order(triangles.size());
    std::iota(in_order.begin(), in_order.end(), 0u);
    std::ranges::stable_sort(in_order, {}, [&](std::uint32_t i) { return triangles[i].a.x; });

    const auto eager = KdTree<>::build(triangles);
    const std::vector<double> shares{0.0, 0.001, 0.01, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 2.0};
    std::vector<ReachPoint> points;
    Progress progress("parts of a scene", shares.size());
    for (const double share : shares) {
        const std::vector<Ray> rays =
            rays_to_part(triangles, in_order, share, limit.rays, options.seed);
        ReachPoint point{.share = share, .rays = rays.size()};
        const auto lazy = LazyKdTree<>::build(triangles);
        if (point.is_everything()) lazy.build_all();
        for (const Ray& ray : rays)
            point.different += closest_hit(lazy, ray) != closest_hit(eager, ray);
        point.nodes = *lazy.shape().nodes;
        point.all_nodes = *eager.shape().nodes;
        if (!options.small && limit.rounds > 0) {
            const bool all = point.is_everything();
            const std::vector<std::function<void()>> runs{
                [&] { build_and_trace<KdTree<>>(triangles, rays, all); },
                [&] { build_and_trace<LazyKdTree<>>(triangles, rays, all); }};
            const std::vector<double> ms = interleaved_medians(runs, limit.rounds);
            point.eager_ms = ms[0];
            point.lazy_ms = ms[1];
        }
        points.push_back(point);
        progress.step();
    }
    return points;
}

}  // namespace space::ch05
