#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/instanced.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

constexpr InstancedWay world_way{}, local_way{.leaf = LeafTest::local},
    bare_way{.margins = BoxMargins::none};

/// Eight spheres, turned and stretched, in a cube that is so far from the origin.
SceneGraph spheres_at(double away, std::uint32_t detail, std::uint64_t seed) {
    const Scene sphere = make_scene("icosphere:" + std::to_string(detail), seed);
    std::vector<Triangle> triangles = sphere.mesh.triangles();
    const Double3 middle(bounds(triangles).centroid()), extent(bounds(triangles).extent());
    const double size = 1.0 / extent.x;
    std::vector<Instance> instances;
    Pcg32 random(seed);
    for (int i = 0; i < 8; ++i) {
        ObjectPlacement placement = random_placement(random, 0.0, 1.5);
        placement.scale *= 0.5 * size;
        const Double3 corner(i & 1, i >> 1 & 1, i >> 2 & 1);
        placement.translation = Double3(away) + 1.2 * corner - affine(placement).vector(middle);
        instances.push_back({affine(placement), 0});
    }
    return {{{.name = "sphere", .triangles = std::move(triangles)},
             {.name = "spheres", .instances = std::move(instances)}},
            1};
}

/// From the origin: where the usual way's answers begin to differ.
constexpr double timed_place = 1e4;

using Answers = std::vector<std::optional<PlacedHit>>;

/// One place of the objects, with all that answers there.
struct Task {
    double away;
    SceneGraph graph;
    InstancedTrees trees;
    std::vector<Triangle> flat;
    std::vector<Ray> rays;
    Answers truth = {};  ///< the exact test's in the flattened mesh

    Task(double from_origin, std::uint32_t detail, std::size_t count, std::uint64_t seed)
        : away(from_origin),
          graph(spheres_at(from_origin, detail, seed)),
          trees(InstancedTrees::build(graph)),
          flat(flatten(graph)),
          rays(rays_from_around(flat, count, seed)) {}
};

void compare(const Answers& answers, const Answers& truth, AccuracyPoint& point) {
    point.rays = truth.size();
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto &answer = answers[i], &wanted = truth[i];
        point.lost += !answer && wanted;
        point.invented += answer && !wanted;
        if (!answer || !wanted) continue;
        point.other_triangles += answer->triangle != wanted->triangle;
        point.other_bits += answer->triangle == wanted->triangle && *answer != *wanted;
    }
}

/// Asks and times: closest(ray, counts) for each way with one test.
class Asked {
  public:
    explicit Asked(Task& task) : task_(task) {}

    template <TriangleTest Test>
    void ask_all(std::string_view test) {
        using FlatTree = Bvh<BinnedBuilder, Test>;
        const auto flat = std::make_shared<const FlatTree>(FlatTree::build(task_.flat));
        const InstancedTrees& trees = task_.trees;
        ask(test, in_flattened, [flat](const Ray& ray, auto& counts) {
            const auto hit = flat->closest_hit(ray, counts);
            return hit ? std::optional(PlacedHit{hit->t, hit->u, hit->v, hit->triangle})
                       : std::nullopt;
        });
        ask(test, in_world, [&](const Ray& ray, auto& counts) {
            return closest_placed_hit<Test, world_way>(trees, ray, counts);
        });
        ask(test, in_local, [&](const Ray& ray, auto& counts) {
            return closest_placed_hit<Test, local_way>(trees, ray, counts);
        });
        ask(test, without_margins, [&](const Ray& ray, auto& counts) {
            return closest_placed_hit<Test, bare_way>(trees, ray, counts);
        });
    }

    /// The first `timed` of them with times.
    std::vector<AccuracyPoint> points(int rounds, std::size_t timed) {
        if (rounds == 0) return points_;
        const std::vector<double> ms =
            interleaved_medians(std::span(runs_).first(std::min(timed, runs_.size())), rounds);
        for (std::size_t i = 0; i < ms.size(); ++i)
            points_[i].ns = ms[i] * 1e6 / double(task_.rays.size());
        return points_;
    }

  private:
    template <class Closest>
    void ask(std::string_view test, std::string_view way, const Closest& closest) {
        NoCounts none;
        Answers answers;
        for (const Ray& ray : task_.rays) answers.push_back(closest(ray, none));
        if (task_.truth.empty()) task_.truth = answers;  // the first is the exact test's
        points_.push_back({.away = task_.away, .test = test, .way = way});
        compare(answers, task_.truth, points_.back());
        runs_.push_back([&rays = task_.rays, closest] {
            NoCounts nothing;
            for (const Ray& ray : rays) do_not_optimize(closest(ray, nothing));
        });
    }

    Task& task_;
    std::vector<AccuracyPoint> points_;
    std::vector<std::function<void()>> runs_;
};

}  // namespace

std::vector<AccuracyPoint> measure_accuracy(const Options& options) {
    const bool small = options.amount() == Amount::small;
    std::vector<double> places{0.0, 1e2, 1e3, timed_place, 1e5, 1e6};
    if (small) places = {0.0, 1e6};
    const int rounds = small || options.counts ? 0 : 3;
    std::vector<AccuracyPoint> all;
    Progress progress("instances' answers", places.size());
    for (const double away : places) {
        Task task(away, small ? 7 : 22, small ? 2'000 : 20'000, options.seed);
        Asked asked(task);
        asked.ask_all<FilteredExact>("filtered exact");
        asked.ask_all<MollerTrumbore>("Möller-Trumbore, double");
        asked.ask_all<MollerTrumboreFloat>("Möller-Trumbore, float");
        asked.ask_all<Watertight>("watertight, float");
        const std::size_t timed = away == timed_place ? 16 : 4;  // the exact test's ways
        for (AccuracyPoint& point : asked.points(rounds, timed)) all.push_back(point);
        progress.step();
    }
    return all;
}

}  // namespace space::ch09
