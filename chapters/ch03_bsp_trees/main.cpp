/// Chapter 3: BSP trees with polygon splitting, by six choices of splitters and in four grades of
/// care.
///     ch03_bsp_trees --out pictures
///     ch03_bsp_trees --figure fig_03_02 --out figures
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/same_picture.hpp"
#include "chapters/ch03_bsp_trees/measured/known_errors.hpp"
#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "chapters/ch03_bsp_trees/measured/outcome.hpp"
#include "chapters/ch03_bsp_trees/painter.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace space::ch03 {
namespace {

constexpr const char* default_scene = "room:3";

struct ChapterOptions : Options {
    BspConfig tree = {};
};

ChapterOptions read_options(int argc, char** argv) {
    BspConfig tree{.max_fragments = max_scene_fragments, .max_placed = max_scene_placed};
    std::map<std::string, SplitterChoice> splitters;
    for (const Method& method : methods)
        if (method.straddlers == Straddlers::split) splitters.emplace(method.name, method.splitter);
    std::vector<std::string> names;
    for (const auto& [name, _] : splitters) names.push_back(name);
    std::string splitter = "weighted";
    const auto add_tree = [&](CLI::App& app) {
        add_choice(app, "--splitter", names, splitter, "how the pictures' tree chooses its planes");
        add_whole_number(app, "--max-fragments", 1, max_scene_fragments, tree.max_fragments,
                         "give the pictures' tree up beyond");
    };
    ChapterOptions options{parse_options(
        argc, argv,
        {.name = this_chapter.name,
         .about = "Chapter 3: BSP trees with polygon splitting",
         .defaults = {.scene = default_scene, .width = 240, .height = 180},
         .examples = "  ch03_bsp_trees --out pictures       the chapter, in some minutes\n"
                     "  ch03_bsp_trees --quick --scene stadium --splitter free\n"
                     "  ch03_bsp_trees --figure all --out figures"},
        add_tree)};
    options.tree = tree;
    options.tree.splitter = splitters.at(splitter);
    if (options.small && options.scene == default_scene) options.scene = "lattice";
    if (options.small) options.width = 32, options.height = 24;
    if (options.quick && !options.counts) options.width /= 2, options.height /= 2;
    return options;
}

/// The scene by rays through its tree and by the painter.
Pictures draw_pictures(const ChapterOptions& options) {
    SamePicture same(options);
    const std::span<const Triangle> triangles = same.triangles();
    const Bsp<> bsp = Bsp<>::build(triangles, options.tree);
    const ComparedPicture by_all = same.draw("naively", Naive<FilteredExact>::build(triangles));
    const ComparedPicture by_tree = same.draw("the same, through the tree", bsp);

    const PixelGrid grid(same.scene().camera, options.width, options.height);
    const DepthBuffer painted = paint(bsp.tree(), options.tree.grade, grid);
    const DepthBuffer nearest = z_buffer(triangles, grid);

    const PixelDifferences painter = pixel_differences(painted, nearest);

    same.print_heading(options);
    Table table({"rays and shadow rays", "tree", "naive"});
    table.row(
        {"nodes per ray", fixed(by_tree.nodes_per_ray(), 1), fixed(by_all.nodes_per_ray(), 1)});
    table.row({"ray-triangle tests per ray", fixed(by_tree.tests_per_ray(), 1),
               fixed(by_all.tests_per_ray(), 1)});
    table.print();
    fmt::print(
        "\nThe pictures differ in {} of {} pixels. The painter, who knows no depths, shows another "
        "triangle\n"
        "than the z-buffer in {}; in {} more, two triangles lie at the same depth.\n",
        with_commas(by_tree.other_pixels), with_commas(painter.pixels), with_commas(painter.wrong),
        with_commas(painter.same_depth));

    write_png(options.out / "ch03_tree.png", by_tree.drawn.image);
    write_png(options.out / "ch03_painter.png", picture_of(same.scene(), painted));
    return {.pixels = painter.pixels,
            .rays = by_tree.rays(),
            .nodes = by_tree.drawn.counts.traversal.nodes_visited,
            .tests = by_tree.drawn.counts.traversal.triangles_tested,
            .naive_tests = by_all.drawn.counts.traversal.triangles_tested,
            .other_pixels = by_tree.other_pixels,
            .painter_wrong = painter.wrong,
            .same_depth = painter.same_depth};
}

int run(int argc, char** argv) {
    const ChapterOptions options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const bool all = !options.counts || !options.quick;

    Measurements measured;
    if (all) measured.pictures = draw_pictures(options);
    measured.worst_known_share = worst_known_share();
    print_methods(measured.methods = measure_methods(options.scene, options), times);
    if (all) print_scenes(measured.scenes = measure_scenes(options), times);
    print_crossings(measured.crossings = measure_crossings(options));
    if (all) print_grades(measured.grades = measured_once<measure_grades>(options), times);
    if (all) {
        print_growth(measured.growth = measured_once<measure_growth>(options), times);
        measured.printed = build_as_printed(options);
    }
    const std::uint64_t wrong =
        wrong_answers(measured) + measured.pictures.other_pixels + measured.pictures.painter_wrong;
    quoted(measured, times).write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, answer_claims(measured), wrong);
}

}  // namespace
}  // namespace space::ch03

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch03::run, argc, argv);
}
