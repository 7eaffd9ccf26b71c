/// Chapter 1: naive ray tracing, Heinonen16's Algorithm 1 as printed and corrected, beside a
/// rasteriser.
///     ch01_naive_ray_tracing --scene room --out pictures
///     ch01_naive_ray_tracing --figure fig_01_03 --out figures
#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/measurements.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch01 {
namespace {

struct ChapterOptions : Options {
    int samples = 0;
};

ChapterOptions read_options(int argc, char** argv) {
    int samples = 0;
    const auto add_samples = [&](CLI::App& app) {
        add_whole_number(
            app, "--samples", 1, 16, [&](std::uint64_t n) { samples = static_cast<int>(n); },
            "rays per pixel and axis; default: 2, with --quick 1");
    };
    ChapterOptions options{parse_options(
        argc, argv,
        {.name = this_chapter.name,
         .about = "Chapter 1: naive ray tracing, wrong and right, beside a rasteriser",
         .defaults = {.scene = "room:3", .width = 240, .height = 180},
         .examples =
             "  ch01_naive_ray_tracing --out pictures             the chapter, in two minutes\n"
             "  ch01_naive_ray_tracing --quick --scene soup:500   another scene, fewer "
             "measurements\n"
             "  ch01_naive_ray_tracing --scene bunny --size 60x45 --samples 1\n"
             "  ch01_naive_ray_tracing --figure all --out figures"},
        add_samples)};
    if (options.small) options.width = 32, options.height = 24;
    options.samples = samples ? samples : options.quick || options.small ? 1 : 2;
    return options;
}

/// The same scene three times: by Algorithm 1 as it should be, as it is printed, and by the
/// rasteriser.
void draw_pictures(const ChapterOptions& options) {
    const Scene scene = asked_scene(options);
    const RenderSettings settings{.width = options.width,
                                  .height = options.height,
                                  .samples = options.samples,
                                  .threads = options.threads};
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());

    Progress tracing("ray tracing " + options.scene, static_cast<std::size_t>(settings.height));
    const Rendering corrected = render(scene, naive, settings, &tracing);

    // As printed, nothing is seen but the list's last triangle, and that only where it is hit
    // first, in front of the eye or behind it: here, nothing at all.
    Progress as_printed("the same as printed", static_cast<std::size_t>(settings.height));
    const Rendering printed =
        algorithm1_as_printed(scene, scene.mesh.triangles(), settings, &as_printed);

    const Image rasterised =
        render_rasterised(scene, settings.width, settings.height, settings.samples);

    print_heading(fmt::format(
        "{}: {} triangles, {} lights, {} x {} pixels, {} each", options.scene,
        with_commas(scene.mesh.faces.size()), scene.lights.size(), settings.width, settings.height,
        options.samples == 1 ? "1 ray"
                             : fmt::format("{} rays", options.samples * options.samples)));
    const RenderCounts& counts = corrected.counts;
    Table table({"", "count", "per pixel"});
    const auto row = [&](const char* what, std::uint64_t count) {
        table.row({what, with_commas(count),
                   fmt::format("{:.1f}", double(count) / (settings.width * settings.height))});
    };
    row("camera rays", counts.camera_rays);
    row("that hit a triangle", counts.hits);
    row("left by Algorithm 1 as printed", printed.counts.hits);
    row("shadow rays", counts.shadow_rays);
    row("that meet an occluder", counts.occluded);
    row("ray-triangle tests", counts.traversal.triangles_tested);
    table.print();

    const PixelGrid grid(scene.camera, settings.width, settings.height);
    const Coverage coverage = compare_coverage(scene, trace_depth(grid, naive, settings.threads),
                                               rasterise(scene, settings.width, settings.height));
    fmt::print(
        "\nThe rasteriser sees another triangle in {} of {} pixels, {} of them within {:.4f} "
        "pixels of an edge\n"
        "(farthest {:.4f}), {} where two triangles meet or overlap at the same depth.\n",
        with_commas(coverage.disagree), with_commas(coverage.pixels),
        with_commas(coverage.near_edge), coverage_distance(grid), coverage.farthest,
        with_commas(coverage.same_depth));

    write_png(options.out / "ch01_corrected.png", corrected.image);
    write_png(options.out / "ch01_as_printed.png", printed.image);
    write_png(options.out / "ch01_rasterised.png", rasterised);
    write_png(options.out / "ch01_side_by_side.png",
              side_by_side({corrected.image, printed.image, rasterised}));
}

int run(int argc, char** argv) {
    const ChapterOptions options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    if (!options.counts) draw_pictures(options);

    const Measurements measured = measure(options);
    print_counts(measured.counts);
    quoted(measured).write(options.out, provenance(std::string(this_chapter.name), options));
    std::uint64_t unexplained = 0;  // pixels in which the renderers differ
    for (const SceneCounts& scene : measured.counts) unexplained += scene.unexplained;
    if (options.counts) return exit_code(unexplained);

    if (!options.small) print_times(measured.growth, measured.shares);
    return finish(options, answer_claims(measured), unexplained);
}

}  // namespace
}  // namespace space::ch01

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch01::run, argc, argv);
}
