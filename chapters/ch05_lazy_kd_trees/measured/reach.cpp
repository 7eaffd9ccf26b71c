#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/views.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"

#include <algorithm>
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

template <class Tree>
void ask_all(const Tree& tree, const std::vector<Ray>& rays) {
    for (const Ray& ray : rays) do_not_optimize(closest_hit(tree, ray));
}

/// Builds, makes all nodes if so wanted, and asks each part's rays, both trees in turn. The eager
/// tree is the same for all parts, so each round builds it once.
void time_parts(std::vector<ReachPoint>& points, const std::vector<std::vector<Ray>>& rays,
                const std::vector<Triangle>& triangles, int rounds) {
    std::vector<std::vector<double>> eager_ms(points.size()), lazy_ms(points.size());
    Progress progress("times of parts", std::size_t(rounds) * points.size());
    for (int round = 0; round < rounds; ++round) {
        Stopwatch stopwatch;
        const auto eager = KdTree<>::build(triangles);
        const double build_ms = stopwatch.lap().count();
        for (std::size_t i = 0; i < points.size(); ++i) {
            stopwatch.lap();
            ask_all(eager, rays[i]);
            eager_ms[i].push_back(build_ms + stopwatch.lap().count());
            const auto lazy = LazyKdTree<>::build(triangles);
            if (points[i].is_everything()) lazy.build_all();
            ask_all(lazy, rays[i]);
            lazy_ms[i].push_back(stopwatch.lap().count());
            progress.step();
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].eager_ms = median(eager_ms[i]);
        points[i].lazy_ms = median(lazy_ms[i]);
    }
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
    std::vector<std::vector<Ray>> rays_to;
    Progress progress("parts of a scene", shares.size());
    for (const double share : shares) {
        const std::vector<Ray>& rays = rays_to.emplace_back(
            rays_to_part(triangles, in_order, share, limit.rays, options.seed));
        ReachPoint point{.share = share, .rays = rays.size()};
        const auto lazy = LazyKdTree<>::build(triangles);
        if (point.is_everything()) lazy.build_all();
        for (const Ray& ray : rays)
            point.different += closest_hit(lazy, ray) != closest_hit(eager, ray);
        point.nodes = *lazy.shape().nodes;
        point.all_nodes = *eager.shape().nodes;
        points.push_back(point);
        progress.step();
    }
    if (!options.small && limit.rounds > 0) time_parts(points, rays_to, triangles, limit.rounds);
    return points;
}

}  // namespace space::ch05
