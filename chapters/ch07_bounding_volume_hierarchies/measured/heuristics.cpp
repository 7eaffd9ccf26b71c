#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/area_sum_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/program/progress.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace space::ch07 {
namespace {

std::vector<std::string> heuristic_scenes(const Options& options) {
    if (options.small) return {"soup:1000", "stadium:2"};
    return {"soup:10000", "icosphere:22", "stadium", "building:1", "slivers"};
}

// --- candidates ---

/// Looks at every node that the sweep cuts, and at the planes that it might have tried.
struct CandidateCounter : NoObserver {
    CandidatePoint& point;

    explicit CandidateCounter(CandidatePoint& counted) : point(counted) {}
    using NoObserver::observe;
    void observe(const BvhChosen<3>& chosen) {
        if (!chosen.cut) return;
        const std::span<const BvhReference<3>> range = chosen.task.range;
        ++point.nodes;
        point.faces += 6 * range.size();
        point.cuts += 3 * (range.size() - 1);
        for (int axis = 0; axis < 3; ++axis) count(range, axis);
    }

  private:
    /// The planes at faces of boxes across one axis. A plane puts each triangle on the side of its
    /// box's middle.
    void count(std::span<const BvhReference<3>> range, int axis) {
        std::vector<float> planes, middles;
        for (const auto& [box, polygon] : range) {
            planes.push_back(box.min[axis]);
            planes.push_back(box.max[axis]);
            middles.push_back(box.centroid()[axis]);
        }
        std::ranges::sort(planes);
        std::ranges::sort(middles);
        planes.erase(std::ranges::unique(planes).begin(), planes.end());
        point.planes += planes.size();
        std::ptrdiff_t last = 0;
        for (const float plane : planes) {
            const auto below = std::ranges::lower_bound(middles, plane) - middles.begin();
            const bool is_cut = below > 0 && below < std::ptrdiff_t(middles.size());
            point.partitions += is_cut && below != last;
            last = below;
        }
    }
};

// --- sums of areas ---

SumPoint count_sum(const RayTask& task, bool has_counts, const Bvh<AnyBuilder>& tree) {
    SumPoint point{.scene = task.scene,
                   .has_counts = has_counts,
                   .n = task.triangles.size(),
                   .nodes = tree.nodes().size(),
                   .depth = tree.nodes().depth,
                   .cost = tree.nodes().sah_cost({})};
    TraversalCounts counts;
    trace(tree, task, diffuse_kind, counts);
    point.rays = {.rays = task.rays[diffuse_kind].size(),
                  .nodes = counts.nodes_visited,
                  .tests = counts.triangles_tested};
    return point;
}

// --- walks ---

/// Another walk through the same tree.
template <BvhWay way>
void add_walk(const RayTask& task, std::string_view name, std::vector<WalkPoint>& points,
              std::vector<std::function<void()>>& traces) {
    using Tree = Bvh<AnyBuilder, FilteredExact, way>;
    const auto tree =
        std::make_shared<const Tree>(Tree::build(task.triangles, any<SweepBuilder>()));
    TraversalCounts counts;
    trace(*tree, task, diffuse_kind, counts);
    points.push_back({.scene = task.scene,
                      .walk = name,
                      .n = task.triangles.size(),
                      .rays = {.rays = task.rays[diffuse_kind].size(),
                               .nodes = counts.nodes_visited,
                               .tests = counts.triangles_tested}});
    traces.push_back(runs(task, tree)[diffuse_kind]);
}

RayTask task_of(const std::string& name, const Options& options) {
    const Limits limit = limits(options);
    return {name, make_scene(name, options.seed), limit.width, limit.height, 0, 1, options.seed};
}

/// Medians into the points' rays, from `first` on.
template <class Point>
void time_rays(std::vector<Point>& points, std::size_t first,
               std::span<const std::function<void()>> traces, int rounds) {
    if (rounds == 0) return;
    const std::vector<double> medians = interleaved_medians(traces, rounds);
    for (std::size_t i = 0; i < medians.size(); ++i) points[first + i].rays.ms = medians[i];
}

}  // namespace

std::vector<CandidatePoint> measure_candidates(const Options& options) {
    std::vector<CandidatePoint> points;
    for (const std::string& name : heuristic_scenes(options)) {
        const std::vector<Triangle> triangles = make_scene(name, options.seed).mesh.triangles();
        points.push_back({.scene = name, .n = triangles.size()});
        CandidateCounter counter(points.back());
        SweepBuilder::build<3>(triangles, {}, counter);
    }
    return points;
}

std::vector<SumPoint> measure_sums(const Options& options) {
    const std::vector<std::string> scenes = heuristic_scenes(options);
    std::vector<SumPoint> points;
    Progress progress("sums of areas", scenes.size());
    for (const std::string& name : scenes) {
        const RayTask task = task_of(name, options);
        std::vector<std::function<void()>> traces;
        for (const bool has_counts : {true, false}) {
            const auto tree = std::make_shared<const Bvh<AnyBuilder>>(Bvh<AnyBuilder>::build(
                task.triangles, any<AreaSumBuilder>({.has_counts = has_counts})));
            points.push_back(count_sum(task, has_counts, *tree));
            traces.push_back(runs(task, tree)[diffuse_kind]);
        }
        time_rays(points, points.size() - traces.size(), traces, limits(options).rounds);
        progress.step();
    }
    return points;
}

std::vector<WalkPoint> measure_walks(const Options& options) {
    std::vector<WalkPoint> points;
    for (const std::string& name : heuristic_scenes(options)) {
        const RayTask task = task_of(name, options);
        std::vector<std::function<void()>> traces;
        add_walk<BvhWay{}>(task, nearest_first, points, traces);
        add_walk<BvhWay{.order = BvhWay::Order::all_boxes}>(task, all_boxes, points, traces);
        time_rays(points, points.size() - traces.size(), traces, limits(options).rounds);
    }
    return points;
}

}  // namespace space::ch07
