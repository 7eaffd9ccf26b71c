#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch09_instancing_and_motion/forest.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting_run.hpp"
#include "chapters/ch09_instancing_and_motion/mesh_places.hpp"
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "common/accelerator.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"

#include <fmt/format.h>

#include <bit>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

/// Larger meshes are not flattened, and more places not given to Embree: both take too long.
constexpr std::uint64_t most_flattened = 3'000'000, most_places = 1'000'000;

bool same_answer_bits(const PlacedHit& a, const PlacedHit& b) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return bits(a.t) == bits(b.t) && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v);
}

void compare_answers(const PlacedAnswers& exact, const PlacedAnswers& answers,
                     NestingTrace& trace) {
    for (std::size_t i = 0; i < exact.size(); ++i)
        if (exact[i].has_value() != answers[i].has_value())
            ++trace.other_hit;
        else if (exact[i] && exact[i]->triangle != answers[i]->triangle)
            ++trace.other_triangle;
        else if (exact[i] && !same_answer_bits(*exact[i], *answers[i]))
            ++trace.other_bits;
}

template <LeafTest leaf>
std::optional<PlacedHit> closest(const InstancedTrees& trees, const Ray& ray) {
    NoCounts none;
    return closest_placed_hit<FilteredExact, InstancedWay{.leaf = leaf}>(trees, ray, none);
}

/// Every way that the graph is small enough for. The exact one is the first.
std::vector<NestingRun> all_runs(const SceneGraph& graph, bool with_embree) {
    std::vector<NestingRun> runs;
    std::size_t bytes = 0;
    const auto build = [&] {
        InstancedTrees trees = InstancedTrees::build(graph);
        bytes = graph.bytes() + trees.bytes();
        return trees;
    };
    runs.push_back(nesting_run(nesting_way::exact, build, closest<LeafTest::world>));
    runs.push_back(nesting_run(nesting_way::usual, build, closest<LeafTest::local>));
    for (NestingRun& run : runs) run.trace.bytes = bytes;

    std::vector<Triangle> triangles;
    if (graph.triangle_count() <= most_flattened) {
        triangles = flatten(graph);
        using Tree = Bvh<BinnedBuilder>;
        runs.push_back(nesting_run(
            nesting_way::flattened,
            [&] {
                Tree tree = Tree::build(triangles);
                bytes = tree.shape().bytes;
                return tree;
            },
            [](const Tree& tree, const Ray& ray) -> std::optional<PlacedHit> {
                const std::optional<Hit> hit = closest_hit(tree, ray);
                if (!hit) return std::nullopt;
                return PlacedHit{hit->t, hit->u, hit->v, hit->triangle};
            }));
        runs.back().trace.bytes = bytes;
    }
    if (with_embree)
        for (NestingRun& run : embree_nesting_runs(graph, triangles, most_places))
            runs.push_back(std::move(run));
    return runs;
}

NestingPoint measure_nested(const std::string& scene, const Options& options) {
    const SceneGraph graph = make_nested_scene(scene);
    const bool timed = !options.small && !options.counts;
    std::vector<NestingRun> runs = all_runs(graph, timed);
    const std::vector<Ray> rays =
        camera_rays({nested_camera(scene), options.small ? 64 : 256, options.small ? 48 : 192});

    NestingPoint point{.scene = scene,
                       .triangles = graph.triangle_count(),
                       .objects = graph.objects().size(),
                       .places = mesh_place_count(graph),
                       .rays = rays.size()};
    for (const GraphObject& object : graph.objects()) point.instances += object.instances.size();
    TraversalCounts counts;
    const InstancedTrees trees = InstancedTrees::build(graph);
    for (const Ray& ray : rays) point.hits += closest_placed_hit(trees, ray, counts).has_value();
    point.visits = double(counts.nodes_visited) / double(rays.size());
    point.tests = double(counts.triangles_tested) / double(rays.size());

    std::vector<PlacedAnswers> answers(runs.size(), PlacedAnswers(rays.size()));
    std::vector<std::function<void()>> turns;
    for (std::size_t i = 0; i < runs.size(); ++i)
        turns.push_back([&, i] { runs[i].run(rays, answers[i]); });
    const std::vector<double> ms = interleaved_medians(turns, timed ? 3 : 0);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (timed) runs[i].trace.ray_ns = ms[i] * 1e6 / double(rays.size());
        compare_answers(answers[0], answers[i], runs[i].trace);
        point.traces.push_back(runs[i].trace);
    }
    return point;
}

}  // namespace

Camera nested_camera(std::string_view scene) {
    const std::string_view name = scene.substr(0, scene.find(':'));
    Camera camera{.eye = {2.1f, 1.3f, 1.7f},  // the sphereflake's
                  .target = {0.05f, 0.0f, -0.02f},
                  .up = {0, 0, 1},
                  .field_of_view = 38};
    if (name == "tetra")
        camera = {.eye = {1.022846f, -3.177154f, -2.174512f},
                  .target = {-0.23f, -0.17f, 0.07f},
                  .up = {-0.816497f, -0.816497f, 0.816497f},
                  .field_of_view = 37};
    if (name == "jacks")
        camera = {.eye = {2.2f, 1.5f, -6.5f}, .target = {0, 0, 0}, .field_of_view = 21};
    if (name == "forest") {
        const auto above = [](float x, float y, double height) {
            return Point3(x, y, forest_ground(x, y) + height);
        };
        camera = {.eye = above(-300, 100, 20),
                  .target = above(0, 60, -19),
                  .up = {0, 0, 1},
                  .field_of_view = 42};
    }
    return camera;
}

NestingMeasurements measure_nesting(const Options& options) {
    NestingMeasurements measured;
    const std::vector<std::string> large =
        options.small
            ? std::vector<std::string>{"tetra:9", "jacks:4", "forest:20"}
            : std::vector<std::string>{"sphereflake:7", "tetra:14", "jacks:8", "forest:320"};
    const std::uint32_t levels = options.small ? 4 : 11;
    Progress progress("scenes of scenes", levels + large.size());
    for (std::uint32_t level = 0; level < levels; ++level) {
        measured.levels.push_back(measure_nested(fmt::format("sphereflake:{}", level), options));
        progress.step();
    }
    for (const std::string& scene : large) {
        measured.large.push_back(measure_nested(scene, options));
        progress.step();
    }
    return measured;
}

}  // namespace space::ch09
