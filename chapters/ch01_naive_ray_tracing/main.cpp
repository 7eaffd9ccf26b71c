/// Chapter 1: naive ray tracing, Heinonen16's Algorithm 1 as printed and corrected, beside a rasteriser.
/// Run   ch01_naive_ray_tracing --scene room --out pictures
/// Draw  ch01_naive_ray_tracing --figure fig_01_03 --out figures
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/measurements.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/error.hpp"
#include "common/report.hpp"

namespace space {
namespace {

int samples = 2;  // --samples

Options read_options(int argc, char** argv) {
    return parse_options(argc, argv,
                         {.name = "ch01_naive_ray_tracing",
                          .about = "Chapter 1: naive ray tracing, wrong and right, beside a rasteriser",
                          .defaults = {.scene = "room:3", .width = 240, .height = 180}},
                         [](CLI::App& app) {
                             app.add_option("--samples", samples, "rays per pixel and axis")
                                 ->check(CLI::Range(1, 16))
                                 ->capture_default_str();
                             app.footer(
                                 "Examples:\n"
                                 "  ch01_naive_ray_tracing --out pictures           the chapter, in a minute or two\n"
                                 "  ch01_naive_ray_tracing --quick --scene soup:500 another scene, fewer measurements\n"
                                 "  ch01_naive_ray_tracing --scene bunny.ply --size 60x45 --samples 1\n"
                                 "  ch01_naive_ray_tracing --figure all --out figures");
                         });
}

/// The same scene three times: by Algorithm 1 as it should be, as it is printed, and by the rasteriser.
void draw_pictures(const Options& options) {
    // [pictures]
    const Scene scene = make_scene(options.scene, options.seed, options.small);
    const RenderSettings settings{
        .width = options.width, .height = options.height, .samples = samples, .threads = options.threads};
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());

    Progress tracing("ray tracing " + options.scene, static_cast<std::size_t>(settings.height));
    const Rendering corrected = render(scene, naive, settings, &tracing);

    // As printed, only what the list's last triangle leaves is seen; from back to front of the list that is a wall.
    Scene reversed = scene;
    std::reverse(reversed.mesh.faces.begin(), reversed.mesh.faces.end());
    std::reverse(reversed.colors.begin(), reversed.colors.end());
    Progress as_printed("the same as printed", static_cast<std::size_t>(settings.height));
    const Rendering printed = algorithm1_as_printed(reversed, reversed.mesh.triangles(), settings, &as_printed);

    const Image rasterised = render_rasterised(scene, settings.width, settings.height, settings.samples);
    // [pictures]

    print_heading(fmt::format("{}: {} triangles, {} lights, {} x {} pixels, {} each", options.scene,
                              with_commas(scene.mesh.faces.size()), scene.lights.size(), settings.width,
                              settings.height, samples == 1 ? "1 ray" : fmt::format("{} rays", samples * samples)));
    const RenderCounts& counts = corrected.counts;
    Table table({"", "count", "per pixel"});
    const auto row = [&](const char* what, std::uint64_t count) {
        table.row(
            {what, with_commas(count), fmt::format("{:.1f}", double(count) / (settings.width * settings.height))});
    };
    row("camera rays", counts.camera_rays);
    row("that hit a triangle", counts.hits);
    row("left by Algorithm 1 as printed", printed.counts.hits);
    row("shadow rays", counts.shadow_rays);
    row("that meet an occluder", counts.occluded);
    row("ray-triangle tests", counts.traversal.triangles_tested);
    table.print();

    write_png(options.out / "ch01_corrected.png", corrected.image);
    write_png(options.out / "ch01_as_printed.png", printed.image);
    write_png(options.out / "ch01_rasterised.png", rasterised);
    write_png(options.out / "ch01_side_by_side.png", side_by_side({corrected.image, printed.image, rasterised}));
}

void print_counts(const std::vector<SceneCounts>& all) {
    print_heading("Tests per pixel, and hits that Algorithm 1 as printed erases");
    Table tests({"scene", "triangles", "lights", "pixels", "hits", "as printed", "in reverse", "shadow rays",
                 "occluded", "tests", "per pixel"});
    for (const SceneCounts& s : all)
        tests.row({s.scene, with_commas(s.triangles), with_commas(s.lights), with_commas(s.pixels),
                   with_commas(s.rendering.hits), with_commas(s.hits_as_printed), with_commas(s.hits_in_reverse),
                   with_commas(s.rendering.shadow_rays), with_commas(s.rendering.occluded),
                   with_commas(s.rendering.traversal.triangles_tested),
                   with_commas(s.rendering.traversal.triangles_tested / s.pixels)});
    tests.print();

    print_heading("Ray tracer and rasteriser: pixels in which they see different triangles");
    Table coverage({"scene", "pixels", "covered", "differ", "near an edge", "same depth", "unexplained"});
    for (const SceneCounts& s : all)
        coverage.row({s.scene, with_commas(s.coverage.pixels), with_commas(s.coverage.covered),
                      with_commas(s.coverage.disagree), with_commas(s.coverage.near_edge),
                      with_commas(s.coverage.same_depth), with_commas(s.coverage.unexplained)});
    coverage.print();
}

void print_times(const std::vector<GrowthPoint>& growth, const std::vector<SharePoint>& shares) {
    print_heading("Time per pixel against triangles (one thread, medians of interleaved runs)");
    Table times({"scene", "triangles", "naive, µs", "rasteriser, µs", "ratio"});
    for (const GrowthPoint& point : growth)
        times.row({point.scene, with_commas(std::uint64_t(point.triangles)), fmt::format("{:.1f}", point.naive_us),
                   fmt::format("{:.4f}", point.rasteriser_us),
                   fmt::format("{:.0f}", point.naive_us / point.rasteriser_us)});
    times.print();

    print_heading("Share of the time spent in intersection tests");
    Table share({"scene", "triangles", "rendering, ms", "its tests alone, ms", "share"});
    for (const SharePoint& point : shares)
        share.row({point.scene, with_commas(std::uint64_t(point.triangles)), fmt::format("{:.2f}", point.rendering_ms),
                   fmt::format("{:.2f}", point.intersections_ms), fmt::format("{:.1f} %", 100 * point.share())});
    share.print();
}

int run(int argc, char** argv) {
    Options options = read_options(argc, argv);
    if (options.figure) return make_figures(chapter01_figures(), options);
    const Effort effort = effort_of(options);
    if (effort == Effort::small) options.width = 32, options.height = 24, samples = 1;
    if (effort == Effort::quick) samples = 1;

    draw_pictures(options);
    const std::vector<SceneCounts> counts = count_scenes(effort, options.seed, options.threads);
    print_counts(counts);

    const std::vector<GrowthPoint> growth = measure_growth(effort, options.seed);
    const std::vector<SharePoint> shares = measure_shares(effort, options.seed);
    const Results results{"ch01_naive_ray_tracing", options.small, answer_claims(counts, growth, shares)};
    write_results(options.out / "results.json", results);
    const bool agree =
        std::all_of(counts.begin(), counts.end(), [](const auto& s) { return s.coverage.unexplained == 0; });
    const int exit_code = static_cast<int>(agree ? ExitCode::ok : ExitCode::wrong_answer);
    if (effort == Effort::small) return exit_code;  // times are no test's business

    print_times(growth, shares);
    write_chart(options.out, growth_chart(growth));
    write_chart(options.out, share_chart(shares));
    print_heading("The sources' claims");
    for (const ClaimAnswer& answer : results.answers)
        fmt::print("{:4} {}: {}\n", answer.claim, name(answer.verdict), answer.measured);
    return exit_code;
}

}  // namespace
}  // namespace space

int main(int argc, char** argv) {
    return space::run_program("ch01_naive_ray_tracing", space::run, argc, argv);
}
