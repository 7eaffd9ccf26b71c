/// Chapter 9: one object in many places, and objects that move.
///     ch09_instancing_and_motion --out pictures
///     ch09_instancing_and_motion --figure fig_09_01 --out figures
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/boxing.hpp"
#include "chapters/ch09_instancing_and_motion/measured/instanced.hpp"
#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"
#include "chapters/ch09_instancing_and_motion/measured/transforms.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"
#include "common/program/results.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

constexpr const char* default_scene = "stadium";

Options read_options(int argc, char** argv) {
    Options options = parse_options(argc, argv,
                                    {.name = this_chapter.name,
                                     .about = "Chapter 9: instancing and motion",
                                     .defaults = {.scene = default_scene}});
    if (options.small && options.scene == default_scene) options.scene = "boxes:36";
    return options;
}

/// One mesh in 27 places, turned, stretched, and one in three of them mirrored.
SceneGraph many_of(std::vector<Triangle> mesh, std::uint64_t seed) {
    const Aabb box = bounds(std::span<const Triangle>(mesh));
    const double spacing = 2.0 * glm::length(Double3(box.extent()));
    Pcg32 random(seed);
    std::vector<Instance> instances;
    for (int i = 0; i < 27; ++i) {
        ObjectPlacement placement = random_placement(random, 0.0, 1.5);
        if (i % 3 == 0) placement.scale.x = -placement.scale.x;
        placement.translation = spacing * Double3(i % 3, i / 3 % 3, i / 9);
        instances.push_back({.to_parent = affine(placement), .object = 0});
    }
    return SceneGraph({{.name = "mesh", .triangles = std::move(mesh)},
                       {.name = "many", .instances = std::move(instances)}},
                      1);
}

/// A scene in 27 places, as one mesh and as two levels. @return answers that are not the mesh's
std::uint64_t place_one_scene(const Options& options) {
    const SceneGraph graph = many_of(asked_scene(options).mesh.triangles(), options.seed);
    const std::vector<Triangle> mesh = flatten(graph);
    const auto tree = Bvh<BinnedBuilder>::build(mesh);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const std::vector<Ray> rays = rays_within(mesh, options.small ? 500 : 50'000, options.seed);

    Table table(
        {"27 times", "bytes", "nodes per ray", "tests per ray", "other triangles", "other bits"});
    std::uint64_t wrong = 0;
    const auto show = [&](const std::string& way, std::size_t bytes, const auto& closest) {
        TraversalCounts counts;
        std::uint64_t triangles = 0, bits = 0;
        for (const Ray& ray : rays) {
            NoCounts none;
            const std::optional<Hit> wanted = tree.closest_hit(ray, none);
            const std::optional<PlacedHit> hit = closest(ray, counts);
            const bool is_same = hit.has_value() == wanted.has_value() &&
                                 (!hit || hit->triangle == wanted->triangle);
            triangles += !is_same;
            bits += !is_same ||
                    (hit && (hit->t != wanted->t || hit->u != wanted->u || hit->v != wanted->v));
        }
        const auto per_ray = [&](std::uint64_t n) {
            return fixed(double(n) / double(rays.size()), 1);
        };
        table.row({way, with_commas(bytes), per_ray(counts.nodes_visited),
                   per_ray(counts.triangles_tested), with_commas(triangles), with_commas(bits)});
        return bits;
    };
    show("one mesh", tree.shape().bytes, [&](const Ray& ray, TraversalCounts& counts) {
        const std::optional<Hit> hit = tree.closest_hit(ray, counts);
        return hit ? std::optional(PlacedHit{hit->t, hit->u, hit->v, hit->triangle}) : std::nullopt;
    });
    show("two levels, as usual", trees.bytes(), [&](const Ray& ray, TraversalCounts& counts) {
        constexpr InstancedWay usual{.leaf = LeafTest::local};
        return closest_placed_hit<FilteredExact, usual>(trees, ray, counts);
    });
    wrong += show("two levels, exact", trees.bytes(), [&](const Ray& ray, TraversalCounts& counts) {
        return closest_placed_hit<FilteredExact>(trees, ray, counts);
    });
    print_heading(fmt::format("{} in 27 places: {} triangles", options.scene,
                              with_commas(graph.triangle_count())));
    table.print();
    return wrong;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;

    std::uint64_t wrong = options.counts ? 0 : place_one_scene(options);
    const TransformMeasurements transforms = measure_transforms(options);
    print_transforms(transforms, times);
    const BoxingMeasurements boxing = measure_boxing(options);
    print_boxing(boxing, times);
    if (options.counts && options.quick) {  // what takes seconds
        Numbers numbers;
        quote_transforms(transforms, times, numbers);
        quote_boxing(boxing, times, numbers);
        numbers.write(options.out, provenance(std::string(this_chapter.name), options));
        return exit_code(wrong_transforms(transforms) + wrong_boxing(boxing));
    }
    const InstancedMeasurements instanced = measure_instanced(options);
    print_instanced(instanced, times);
    const NestingMeasurements& nesting = measured_once<measure_nesting>(options);
    print_nesting(nesting, times);
    const MotionMeasurements motion = measure_motion(options);
    print_motion(motion, times);
    wrong += wrong_transforms(transforms) + wrong_boxing(boxing) + wrong_instanced(instanced) +
             wrong_nesting(nesting) + wrong_motion(motion);

    Numbers numbers;
    quote_transforms(transforms, times, numbers);
    quote_boxing(boxing, times, numbers);
    quote_instanced(instanced, times, numbers);
    quote_nesting(nesting, times, numbers);
    quote_motion(motion, times, numbers);
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);

    std::vector<ClaimAnswer> answers;
    const auto add = [&](std::vector<ClaimAnswer> some) {
        for (ClaimAnswer& answer : some) answers.push_back(std::move(answer));
    };
    add(answer_transforms(transforms));
    add(answer_boxing(boxing));
    add(answer_motion(motion));
    return finish(options, answers, wrong);
}

}  // namespace
}  // namespace space::ch09

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch09::run, argc, argv);
}
