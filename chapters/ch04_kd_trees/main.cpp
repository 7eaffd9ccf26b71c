/// Chapter 4: k-d trees, from a published one and its cures to the surface area heuristic.
///     ch04_kd_trees --out pictures
///     ch04_kd_trees --figure fig_04_01 --out figures
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/same_picture.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "chapters/ch04_kd_trees/measured/outcome.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch04 {
namespace {

constexpr const char* default_scene = "room:3";

Options read_options(int argc, char** argv) {
    Options options = parse_options(
        argc, argv,
        {.name = this_chapter.name,
         .about = "Chapter 4: k-d trees",
         .defaults = {.scene = default_scene, .width = 240, .height = 180},
         .examples = "  ch04_kd_trees --out pictures                 the chapter, in some minutes\n"
                     "  ch04_kd_trees --quick --scene dragon.ply\n"
                     "  ch04_kd_trees --figure all --out figures"});
    if (options.small && options.scene == default_scene) options.scene = "stadium";
    if (options.small) options.width = 32, options.height = 24;
    if (options.quick && !options.counts) options.width /= 2, options.height /= 2;
    return options;
}

/// One scene, without a tree and with ever better ones: the same picture.
std::vector<PicturePoint> draw_pictures(const Options& options) {
    SamePicture same(options);
    const std::span<const Triangle> triangles = same.triangles();
    std::vector<PicturePoint> points;
    const auto draw = [&](const std::string& method, const auto& tree) {
        const ComparedPicture picture = same.draw(method, tree);
        points.push_back({.method = method,
                          .rays = picture.rays(),
                          .nodes = picture.drawn.counts.traversal.nodes_visited,
                          .tests = picture.drawn.counts.traversal.triangles_tested,
                          .other_pixels = picture.other_pixels});
        return picture.drawn.image;
    };

    draw("no tree", Naive<FilteredExact>::build(triangles));
    draw("Lichter23's, cured", PublishedKdTree<>::build(triangles, PublishedKdTreeConfig::cured()));
    using Rule = KdTreeConfig::Rule;
    draw("in the middle", KdTree<>::build(triangles, {.rule = Rule::middle}));
    draw("at the median", KdTree<>::build(triangles, {.rule = Rule::median}));
    write_png(options.out / "ch04_tree.png", draw("by area (SAH)", KdTree<>::build(triangles)));

    same.print_heading(options);
    return points;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const bool all = !options.counts || !options.quick;

    Measurements measured;
    if (all) print_pictures(measured.pictures = draw_pictures(options));
    print_cures(measured.cures = measured_once<measure_cures>(options), times);
    print_trees(measured.trees = measured_once<measure_trees>(options), times);
    if (all) print_growth(measured.growth = measured_once<measure_growth>(options), times);
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
