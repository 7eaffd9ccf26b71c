#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch09_instancing_and_motion/crowd.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scenes/shapes.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace space::ch09 {
namespace {

struct CrowdLimits {
    std::size_t walkers, frames, rays;
    std::uint32_t detail;  ///< of a walker
};
CrowdLimits crowd_limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {16, 3, 200, 1};
        case Amount::quick:
            return {100, 4, 1'000, 3};
        case Amount::full:
            break;
    }
    return {400, 10, 4'000, 3};
}

using PlacedAnswers = std::vector<std::optional<PlacedHit>>;

auto closest_in(const RefittedBvh<>& bvh) {
    return [&bvh](const Ray& ray, TraversalCounts& counts) -> std::optional<PlacedHit> {
        const std::optional<Hit> hit = bvh.closest_hit(ray, counts);
        if (!hit) return {};
        return PlacedHit{hit->t, hit->u, hit->v, hit->triangle};
    };
}
template <InstancedWay way>
auto closest_placed_in(const InstancedTrees& trees) {
    return [&trees](const Ray& ray, TraversalCounts& counts) {
        return closest_placed_hit<FilteredExact, way>(trees, ray, counts);
    };
}

/// A crowd, and the trees that follow it.
class FollowedCrowd {
  public:
    explicit FollowedCrowd(const CrowdLimits& limit)
        : crowd_(limit.walkers, 0.8 * std::sqrt(double(limit.walkers)), 2.0, 3),
          graph_({{.name = "teapot", .triangles = teapot(limit.detail).triangles()},
                  {.name = "crowd", .instances = crowd_.instances(0, 0.0)}},
                 1),
          trees_(InstancedTrees::build(graph_)),
          refitted_(RefittedBvh<>::build(flatten(graph_))),
          rotated_(refitted_) {
        for (const std::string_view way :
             {two_levels, two_levels_local, built_anew, refitted, rotated})
            points_.push_back({.way = way, .walkers = crowd_.size(), .n = graph_.triangle_count()});
    }

    void frame(double time, std::size_t rays_of_frame, std::uint64_t seed) {
        graph_.move(1, crowd_.instances(0, time));
        const std::vector<Triangle> world = flatten(graph_);
        const std::vector<Ray> rays = rays_from_around(world, rays_of_frame, seed);
        RefittedBvh<> anew;
        const auto update = [&](std::string_view way, const auto& follow) {
            Stopwatch stopwatch;
            follow();
            point(way).update_ms += stopwatch.lap().count();
        };
        const auto flat = [&](std::string_view way, auto& bvh, const auto& follow) {
            update(way, [&] { follow(bvh, flatten(graph_)); });
        };
        update(two_levels, [&] {
            graph_.move(1, crowd_.instances(0, time));
            trees_.rebuild_groups(graph_);
        });
        point(two_levels_local).update_ms = point(two_levels).update_ms;
        flat(built_anew, anew, [](auto& bvh, const auto& to) { bvh.rebuild(to); });
        flat(refitted, refitted_, [](auto& bvh, const auto& to) { bvh.refit(to); });
        flat(rotated, rotated_, [](auto& bvh, const auto& to) { bvh.refit_and_rotate(to); });

        const PlacedAnswers answers = traced(built_anew, rays, closest_in(anew));
        compare(refitted, traced(refitted, rays, closest_in(refitted_)), answers);
        compare(rotated, traced(rotated, rays, closest_in(rotated_)), answers);
        constexpr InstancedWay exact{}, local{.leaf = LeafTest::local};
        compare(two_levels, traced(two_levels, rays, closest_placed_in<exact>(trees_)), answers);
        compare(two_levels_local, traced(two_levels_local, rays, closest_placed_in<local>(trees_)),
                answers);
    }

    std::vector<CrowdPoint> points() {
        for (CrowdPoint& p : points_) {
            const bool is_flat = p.way != two_levels && p.way != two_levels_local;
            p.boxes = is_flat ? p.n : p.walkers;
            p.bytes = is_flat ? refitted_.shape().bytes : trees_.bytes();
            p.update_ms /= double(p.frames);
            p.trace_ms /= double(p.frames);
        }
        return points_;
    }

  private:
    CrowdPoint& point(std::string_view way) {
        return *std::ranges::find(points_, way, &CrowdPoint::way);
    }
    template <class Closest>
    PlacedAnswers traced(std::string_view way, const std::vector<Ray>& rays,
                         const Closest& closest) {
        PlacedAnswers answers;
        answers.reserve(rays.size());
        TraversalCounts counts, unused;
        for (const Ray& ray : rays) do_not_optimize(closest(ray, unused));  // warms up
        Stopwatch stopwatch;
        for (const Ray& ray : rays) answers.push_back(closest(ray, counts));
        CrowdPoint& p = point(way);
        p.trace_ms += stopwatch.lap().count();
        ++p.frames;
        p.rays += rays.size();
        p.nodes += counts.nodes_visited;
        p.tests += counts.triangles_tested;
        return answers;
    }
    void compare(std::string_view way, const PlacedAnswers& answers,
                 const PlacedAnswers& expected) {
        for (std::size_t i = 0; i < answers.size(); ++i)
            point(way).wrong += answers[i] != expected[i];
    }

    Crowd crowd_;
    SceneGraph graph_;
    InstancedTrees trees_;
    RefittedBvh<> refitted_, rotated_;
    std::vector<CrowdPoint> points_;
};

}  // namespace

std::vector<CrowdPoint> measure_crowd(const Options& options) {
    const CrowdLimits limit = crowd_limits(options);
    FollowedCrowd crowd(limit);
    Progress progress("crowd", limit.frames);
    for (std::size_t frame = 1; frame <= limit.frames; ++frame) {
        crowd.frame(double(frame), limit.rays, options.seed + frame);
        progress.step();
    }
    return crowd.points();
}

}  // namespace space::ch09
