/// Chapter 7: bounding volume hierarchies, boxes around boxes around triangles.
///     ch07_bounding_volume_hierarchies --out pictures
///     ch07_bounding_volume_hierarchies --figure fig_07_01 --out figures
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/same_picture.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/outcome.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/volumes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch07 {
namespace {

constexpr const char* default_scene = "room:3";

Options read_options(int argc, char** argv) {
    Options options =
        parse_options(argc, argv,
                      {.name = this_chapter.name,
                       .about = "Chapter 7: bounding volume hierarchies",
                       .defaults = {.scene = default_scene, .width = 240, .height = 180}});
    if (options.small && options.scene == default_scene) options.scene = "stadium";
    if (options.small) options.width = 32, options.height = 24;
    if (options.quick) options.width /= 2, options.height /= 2;
    return options;
}

/// One scene by ever better trees: the same picture. @return pixels that are not the same
std::uint64_t draw_pictures(const Options& options) {
    SamePicture same(options);
    const std::span<const Triangle> triangles = same.triangles();
    Table table({"rays and shadow rays", "expected cost", "nodes per ray", "tests per ray",
                 "other pixels"});
    std::uint64_t others = 0;
    const auto draw = [&](const std::string& method, const auto& tree) {
        const ComparedPicture picture = same.draw(method, tree);
        others += picture.other_pixels;
        const std::optional<double> cost = tree.shape().sah_cost;
        table.row({method, cost ? fixed(*cost, 1) : "", fixed(picture.nodes_per_ray(), 1),
                   fixed(picture.tests_per_ray(), 1), with_commas(picture.other_pixels)});
        return picture.drawn.image;
    };

    draw("no tree", Naive<FilteredExact>::build(triangles));
    draw("halved by count", Bvh<MedianBuilder>::build(triangles));
    write_png(options.out / "ch07_tree.png",
              draw("by area, between bins", Bvh<BinnedBuilder>::build(triangles)));
    draw("by area, all cuts", Bvh<SweepBuilder>::build(triangles));
    draw("with spatial splits", Bvh<SpatialSplitBuilder>::build(triangles));

    same.print_heading(options);
    table.print();
    return others;
}

TreeMeasurements measure_all(const Options& options, bool times) {
    TreeMeasurements measured;
    measured.candidates = measure_candidates(options);
    measured.sums = measure_sums(options);
    measured.walks = measure_walks(options);
    measured.spatial = measure_spatial(options);
    measured.from_below = measure_from_below(options);
    print_heuristics(measured, times);
    if (!options.counts || !options.quick) {
        print_leaves(measured.leaves = measured_once<measure_leaves>(options), times);
        measured.accuracy = measured_once<measure_accuracy>(options);
        measured.exact = measure_exact(options);
        print_answers(measured, times);
        print_trees(measured.trees = measured_once<measure_trees>(options), times);
        print_growth(measured.growth = measured_once<measure_growth>(options), times);
    }
    if (times) print_phases(measured.phases = measure_phases(options));
    return measured;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;

    std::uint64_t wrong = options.counts ? 0 : draw_pictures(options);
    const VolumeMeasurements volumes = measure_volumes(options);
    print_volumes(volumes, times);
    const TreeMeasurements measured = measure_all(options, times);
    wrong += wrong_answers(measured);

    Numbers numbers;
    quote_volumes(volumes, times, numbers);
    quote_trees(measured, times, numbers);
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    std::vector<ClaimAnswer> answers = answer_volumes(volumes);
    for (ClaimAnswer& answer : answer_claims(measured)) answers.push_back(std::move(answer));
    return finish(options, answers, wrong);
}

}  // namespace
}  // namespace space::ch07

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch07::run, argc, argv);
}
