/// Chapter 6: quadtrees and octrees, whose cells are cut in the middle of every axis at once.
///     ch06_quadtrees_and_octrees --out pictures
///     ch06_quadtrees_and_octrees --figure fig_06_07 --out figures
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/same_picture.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch06 {
namespace {

constexpr const char* default_scene = "room:3";

Options read_options(int argc, char** argv) {
    Options options =
        parse_options(argc, argv,
                      {.name = this_chapter.name,
                       .about = "Chapter 6: quadtrees and octrees",
                       .defaults = {.scene = default_scene, .width = 240, .height = 180}});
    if (options.small && options.scene == default_scene) options.scene = "stadium";
    if (options.small) options.width = 32, options.height = 24;
    if (options.quick && !options.counts) options.width /= 2, options.height /= 2;
    return options;
}

/// One scene by ever other cells: the same picture. @return pixels that are not the same
std::uint64_t draw_pictures(const Options& options) {
    SamePicture same(options);
    const std::span<const Triangle> triangles = same.triangles();
    Table table({"rays and shadow rays", "bytes per triangle", "nodes per ray", "tests per ray",
                 "other pixels"});
    std::uint64_t others = 0;
    const auto draw = [&](const std::string& method, const auto& tree) {
        const ComparedPicture picture = same.draw(method, tree);
        others += picture.other_pixels;
        table.row({method, fixed(double(tree.shape().bytes) / double(triangles.size()), 0),
                   fixed(picture.nodes_per_ray(), 1), fixed(picture.tests_per_ray(), 1),
                   with_commas(picture.other_pixels)});
        return picture.drawn.image;
    };

    using Straddlers = OctreeConfig::Straddlers;
    draw("no tree", Naive<FilteredExact>::build(triangles));
    write_png(options.out / "ch06_octree.png", draw("octree", Octree<>::build(triangles)));
    draw("straddlers kept", Octree<>::build(triangles, {.straddlers = Straddlers::keep}));
    draw("kept in loose cells",
         Octree<>::build(triangles, {.straddlers = Straddlers::keep, .looseness = 2.0}));
    draw("linear, with boxes", LinearOctree<>::build(triangles));
    draw("SAH k-d tree", KdTree<>::build(triangles));

    same.print_heading(options);
    table.print();
    return others;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const bool all = !options.counts || !options.quick;

    std::uint64_t wrong = options.counts ? 0 : draw_pictures(options);
    Measurements measured;
    print_codes(measured.codes = measure_codes(options));
    print_segments(measured.segments = measure_segments(options));
    print_overlaps(measured.overlaps = measure_overlaps(options));
    print_planes(measured.planes = measure_planes(options));
    if (all) {
        print_points(measured.points = measured_once<measure_points>(options), times);
        print_searches(measured.searches = measure_searches(options), times);
        print_trees(measured.trees = measured_once<measure_trees>(options), times);
        print_growth(measured.growth = measured_once<measure_growth>(options), times);
        print_depths(measured.depths = measured_once<measure_depths>(options), times);
        print_adaptive(measured.adaptive = measured_once<measure_adaptive>(options), times);
    }
    if (times) print_sorts(measured.sorts = measure_sorts(options));
    wrong += wrong_answers(measured);
    quoted(measured, times).write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, answer_claims(measured), wrong);
}

}  // namespace
}  // namespace space::ch06

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch06::run, argc, argv);
}
