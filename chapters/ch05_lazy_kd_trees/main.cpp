/// Chapter 5: lazy k-d trees, whose nodes are made when a ray first enters them.
///     ch05_lazy_kd_trees --out pictures
///     ch05_lazy_kd_trees --figure fig_05_01 --out figures
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/outcome.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch05 {
namespace {

constexpr const char* default_scene = "room:3";

Options read_options(int argc, char** argv) {
    Options options = parse_options(
        argc, argv,
        {.name = this_chapter.name,
         .about = "Chapter 5: lazy k-d trees",
         .defaults = {.scene = default_scene, .width = 320, .height = 240},
         .examples =
             "  ch05_lazy_kd_trees --out pictures                 the chapter, in some minutes\n"
             "  ch05_lazy_kd_trees --quick --scene dragon.ply\n"
             "  ch05_lazy_kd_trees --figure all --out figures"});
    if (options.small && options.scene == default_scene) {
        options.scene = "stadium";
        options.width = 32, options.height = 24;
    }
    return options;
}

/// One picture by a tree of which nothing stands at first, and then only what rays have entered.
void draw_picture(const Options& options) {
    const Scene scene = asked_scene(options);
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const auto tree = LazyKdTree<>::build(triangles, {.at_once = 0});
    const auto print_state = [&](std::string_view when) {
        const LazyKdCounts counts = tree.nodes().counts();
        fmt::print("{}: {} nodes stand, {} wait with {} references.\n", when,
                   with_commas(counts.standing()), with_commas(counts.waiting),
                   with_commas(counts.waiting_references));
    };
    print_heading(fmt::format("{}: {} triangles, {} x {} pixels", options.scene,
                              with_commas(triangles.size()), options.width, options.height));
    print_state("Before the first ray");
    const PixelGrid grid(scene.camera, options.width, options.height);
    closest_hit(tree, grid.ray(options.width / 2, options.height / 2));
    print_state("After one ray");
    Progress progress("picture", static_cast<std::size_t>(options.height));
    const Rendering drawn = render(
        scene, tree, {.width = options.width, .height = options.height, .threads = options.threads},
        &progress);
    write_png(options.out / "ch05_tree.png", drawn.image);
    print_state("After the picture");
    tree.build_all();
    print_state("With all nodes");
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const bool all = !options.counts || !options.quick;

    if (!options.counts) draw_picture(options);
    Measurements measured;
    if (all) print_views(measured.views = measured_once<measure_views>(options), times);
    print_reach(measured.reach = measured_once<measure_reach>(options), times);
    print_memory(measured.memory = measured_once<measure_memory>(options));
    if (all) {
        print_lists(measured.lists = measure_lists(options), times);
        print_geometry(measured.geometry = measure_geometry(options), times);
        print_first_pictures(
            measured.first_pictures = measured_once<measure_first_pictures>(options), times);
    }
    const std::uint64_t wrong = wrong_answers(measured);
    quoted(measured, all, times)
        .write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, answer_claims(measured), wrong);
}

}  // namespace
}  // namespace space::ch05

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch05::run, argc, argv);
}
