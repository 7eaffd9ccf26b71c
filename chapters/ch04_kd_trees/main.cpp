/// Chapter 4: k-d trees, from a published one and its cures to the surface area heuristic.
///     ch04_kd_trees --out pictures
///     ch04_kd_trees --figure fig_04_01 --out figures
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "chapters/ch04_kd_trees/measured/outcome.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace space::ch04 {
namespace {

constexpr const char* default_scene = "room:3";

Options read_options(int argc, char** argv) {
    const auto add_examples = [](CLI::App& app) {
        app.footer(
            "Examples:\n"
            "  ch04_kd_trees --out pictures                 the chapter, in some minutes\n"
            "  ch04_kd_trees --quick --scene dragon.ply\n"
            "  ch04_kd_trees --figure all --out figures");
    };
    Options options =
        parse_options(argc, argv,
                      {.name = this_chapter.name,
                       .about = "Chapter 4: k-d trees",
                       .defaults = {.scene = default_scene, .width = 240, .height = 180}},
                      add_examples);
    if (options.small && options.scene == default_scene) options.scene = "stadium";
    if (options.small) options.width = 32, options.height = 24;
    if (options.quick && !options.counts) options.width /= 2, options.height /= 2;
    return options;
}

/// One scene, without a tree and with ever better ones: the same picture.
std::vector<PicturePoint> draw_pictures(const Options& options) {
    const Scene scene = asked_scene(options);
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const RenderSettings settings{
        .width = options.width, .height = options.height, .threads = options.threads};
    std::vector<PicturePoint> points;
    Image naive(options.width, options.height);
    const auto draw = [&](const std::string& method, const auto& accelerator) {
        Progress progress(method, static_cast<std::size_t>(settings.height));
        const Rendering drawn = render(scene, accelerator, settings, &progress);
        if (points.empty()) naive = drawn.image;
        points.push_back({.method = method,
                          .rays = drawn.counts.camera_rays + drawn.counts.shadow_rays,
                          .nodes = drawn.counts.traversal.nodes_visited,
                          .tests = drawn.counts.traversal.triangles_tested});
        for (int y = 0; y < options.height; ++y)
            for (int x = 0; x < options.width; ++x)
                points.back().other_pixels += drawn.image.at(x, y) != naive.at(x, y);
        return drawn.image;
    };

    draw("no tree", Naive<FilteredExact>::build(triangles));
    draw("Lichter23's, cured", PublishedKdTree<>::build(triangles, PublishedKdTreeConfig::cured()));
    using Rule = KdTreeConfig::Rule;
    draw("in the middle", KdTree<>::build(triangles, {.rule = Rule::middle}));
    draw("at the median", KdTree<>::build(triangles, {.rule = Rule::median}));
    write_png(options.out / "ch04_tree.png", draw("by area (SAH)", KdTree<>::build(triangles)));

    print_heading(fmt::format("{}: {} triangles, {} x {} pixels", options.scene,
                              with_commas(triangles.size()), options.width, options.height));
    return points;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const bool all = !options.counts || !options.quick;

    Measurements measured;
    print_pictures(measured.pictures = draw_pictures(options));
    print_cures(measured.cures = measured_once<measure_cures>(options), times);
    print_trees(measured.trees = measured_once<measure_trees>(options), times);
    print_growth(measured.growth = measured_once<measure_growth>(options), times);
    if (all) print_care(measured.care = measured_once<measure_care>(options), times);
    print_overlaps(measured.overlaps = measure_overlaps(options));
    if (all) print_points(measured.points = measured_once<measure_point_searches>(options), times);
    if (!options.counts) measured.planes = measure_planes(options);
    if (times) print_planes(measured.planes);
    const std::uint64_t wrong = wrong_answers(measured);
    quoted(measured, times).write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, answer_claims(measured), wrong);
}

}  // namespace
}  // namespace space::ch04

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch04::run, argc, argv);
}
