#include "chapters/ch01_naive_ray_tracing/measured/measurements.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

namespace space::ch01 {
namespace {

/// A scene with the sizes that give it about 1 K, 10 K, 100 K and 1 M triangles; fewer where it has
/// no such size.
struct Sizes {
    const char* name;
    std::vector<std::uint32_t> large;
    std::vector<std::uint32_t> small;  ///< about 10, 100 and 1,000 triangles
};
const std::array<Sizes, 5>& sized_scenes() {
    static const std::array<Sizes, 5> scenes{{
        {"soup", {1'000, 10'000, 100'000, 1'000'000}, {10, 100, 1'000}},
        {"icosphere", {7, 22, 71, 224}, {1, 2, 7}},
        {"tetra", {5, 7, 8, 10}, {2, 3, 5}},
        {"slivers", {1'000, 10'000, 100'000}, {10, 100, 1'000}},
        {"boxes", {80, 800, 8'000, 80'000}, {1, 8, 80}},
    }};
    return scenes;
}

struct Measured {
    std::string name, spec;
};
/// The scenes of a series of measurements, size after size: the first few small ones, the first few
/// large ones.
std::vector<Measured> series(std::size_t small_sizes, std::size_t large_sizes) {
    std::vector<Measured> measured;
    for (const Sizes& scene : sized_scenes()) {
        const auto add = [&](const std::vector<std::uint32_t>& sizes, std::size_t count) {
            for (std::size_t i = 0; i < std::min(count, sizes.size()); ++i)
                measured.push_back({scene.name, fmt::format("{}:{}", scene.name, sizes[i])});
        };
        add(scene.small, small_sizes);
        add(scene.large, large_sizes);
    }
    return measured;
}

int rounds(Effort effort) {
    return effort == Effort::full ? 5 : 3;
}

/// How often one run repeats its work, so that it takes some milliseconds with few triangles too.
int repeats_for(Effort effort, int work, double triangles) {
    return effort == Effort::small ? 1 : std::max(1, static_cast<int>(work / triangles));
}

Winding check_winding(std::span<const Triangle> triangles) {
    Winding winding;
    for (const Triangle& t : triangles) {
        const Double3 n = normal(t);
        if (n == Double3(0.0)) continue;
        ++winding.triangles;
        winding.flipped += normal({t.a, t.c, t.b}) == -n;
        winding.kept += glm::dot(normal({t.b, t.c, t.a}), n) > 0.0;
    }
    return winding;
}

struct RecordedRays {
    std::vector<Ray> camera, shadow;
};
RecordedRays record_rays(const Scene& scene, const Naive<>& naive, int width, int height) {
    RecordedRays rays;
    const CameraFrame frame(scene.camera);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            rays.camera.push_back(camera_ray(scene.camera, frame, x + 0.5, y + 0.5, width, height));
            if (const auto hit = closest_hit(naive, rays.camera.back()))
                shade(scene, rays.camera.back(), *hit, [&](const Ray& shadow) {
                    rays.shadow.push_back(shadow);
                    return true;
                });
        }
    return rays;
}

/// confirmed where all scenes agree, refuted where none does.
Verdict over_scenes(std::size_t agree, std::size_t scenes) {
    return agree == scenes ? Verdict::confirmed : agree == 0 ? Verdict::refuted : Verdict::depends;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

Effort effort_of(const Options& options) {
    return options.small ? Effort::small : options.quick ? Effort::quick : Effort::full;
}

Scene in_reverse(Scene scene) {
    std::reverse(scene.mesh.faces.begin(), scene.mesh.faces.end());
    std::reverse(scene.colors.begin(), scene.colors.end());
    return scene;
}

std::vector<SceneCounts> count_scenes(Effort effort, std::uint64_t seed, unsigned threads) {
    constexpr std::array names{"room", "sphereflake", "soup", "icosphere", "lattice"};
    const int width = effort == Effort::small ? 24 : 40, height = effort == Effort::small ? 18 : 30;
    std::vector<SceneCounts> all;
    Progress progress("counting", names.size());
    for (const char* name : names) {
        const Scene scene = make_scene(name, seed, effort == Effort::small);
        const std::vector<Triangle> triangles = scene.mesh.triangles();
        const Naive<> naive = Naive<>::build(triangles);
        const RenderSettings settings{.width = width, .height = height, .threads = threads};

        const Scene reversed = in_reverse(scene);
        all.push_back(
            {.scene = name,
             .triangles = triangles.size(),
             .lights = scene.lights.size(),
             .pixels = static_cast<std::uint64_t>(width * height),
             .rendering = render(scene, naive, settings).counts,
             .hits_as_printed = algorithm1_as_printed(scene, triangles, settings).counts.hits,
             .hits_in_reverse =
                 algorithm1_as_printed(reversed, reversed.mesh.triangles(), settings).counts.hits,
             .coverage =
                 compare_coverage(scene, trace_depth(scene.camera, naive, width, height, threads),
                                  rasterise(scene, width, height)),
             .winding = check_winding(triangles)});
        progress.step();
    }
    return all;
}

// [growth]
std::vector<GrowthPoint> measure_growth(Effort effort, std::uint64_t seed) {
    constexpr int naive_width = 8, naive_height = 6, width = 160, height = 120;
    const std::vector<Measured> scenes = effort == Effort::small   ? series(2, 0)
                                         : effort == Effort::quick ? series(0, 3)
                                                                   : series(0, 4);
    std::vector<GrowthPoint> growth;
    Progress progress("time against triangles", scenes.size());
    for (const Measured& measured : scenes) {
        const Scene scene = make_scene(measured.spec, seed);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const auto triangles = static_cast<double>(scene.mesh.faces.size());
        const int repeats = repeats_for(effort, 20'000, triangles);
        const std::array<std::function<void()>, 2> candidates{
            [&] {
                for (int i = 0; i < repeats; ++i)
                    keep(render<NoCounts>(scene, naive,
                                          {.width = naive_width, .height = naive_height})
                             .image);
            },
            [&] {
                for (int i = 0; i < repeats; ++i) keep(rasterise(scene, width, height).pixels);
            }};
        const std::vector<double> ms = interleaved_medians(candidates, rounds(effort));
        growth.push_back({.scene = measured.name,
                          .triangles = triangles,
                          .naive_us = 1000.0 * ms[0] / (repeats * naive_width * naive_height),
                          .rasteriser_us = 1000.0 * ms[1] / (repeats * width * height)});
        progress.step();
    }
    return growth;
}
// [growth]

// [share]
std::vector<SharePoint> measure_shares(Effort effort, std::uint64_t seed) {
    constexpr int width = 20, height = 15;
    const std::vector<Measured> scenes = effort == Effort::small   ? series(2, 0)
                                         : effort == Effort::quick ? series(3, 0)
                                                                   : series(2, 2);
    std::vector<SharePoint> shares;
    Progress progress("share of time in intersection tests", scenes.size());
    for (const Measured& measured : scenes) {
        const Scene scene = make_scene(measured.spec, seed);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const RecordedRays rays = record_rays(scene, naive, width, height);
        const auto triangles = static_cast<double>(scene.mesh.faces.size());
        const int repeats = repeats_for(effort, 1'000, triangles);
        const std::array<std::function<void()>, 2> candidates{
            [&] {
                for (int i = 0; i < repeats; ++i)
                    keep(render<NoCounts>(scene, naive, {.width = width, .height = height}).image);
            },
            [&] {
                for (int i = 0; i < repeats; ++i) {
                    for (const Ray& ray : rays.camera) keep(closest_hit(naive, ray));
                    for (const Ray& ray : rays.shadow) keep(any_hit(naive, ray));
                }
            }};
        const std::vector<double> ms = interleaved_medians(candidates, 2 * rounds(effort) + 1);
        shares.push_back({measured.name, triangles, ms[0] / repeats, ms[1] / repeats});
        progress.step();
    }
    return shares;
}
// [share]

Slopes slopes(const std::vector<GrowthPoint>& growth, const std::string& scene) {
    std::vector<double> triangles, naive, rasteriser;
    for (const GrowthPoint& point : of_scene(growth, scene)) {
        triangles.push_back(point.triangles);
        naive.push_back(point.naive_us);
        rasteriser.push_back(point.rasteriser_us);
    }
    const auto last_two = [](const std::vector<double>& v) { return std::span(v).last(2); };
    return {log_log_slope(triangles, naive), log_log_slope(triangles, rasteriser),
            log_log_slope(last_two(triangles), last_two(rasteriser))};
}

Chart growth_chart(const std::vector<GrowthPoint>& growth) {
    Chart chart{
        .id = "fig_01_06",
        .title = "Time per pixel against the number of triangles, naive ray tracer and rasteriser",
        .x_label = "triangles",
        .y_label = "time per pixel in µs",
        .log_x = true,
        .log_y = true,
        .series = {}};
    for (const std::string scene : {"soup", "icosphere"}) {
        std::vector<double> triangles, naive, rasteriser;
        for (const GrowthPoint& point : of_scene(growth, scene)) {
            triangles.push_back(point.triangles);
            naive.push_back(point.naive_us);
            rasteriser.push_back(point.rasteriser_us);
        }
        const Slopes slope = slopes(growth, scene);
        chart.series.push_back({.name = "naive, " + scene,
                                .x = triangles,
                                .y = naive,
                                .note = fmt::format("slope {:.2f}", slope.naive)});
        chart.series.push_back(
            {.name = "rasteriser, " + scene,
             .x = triangles,
             .y = rasteriser,
             .note = fmt::format("slope at the end {:.2f}", slope.rasteriser_last)});
    }
    return chart;
}

Chart share_chart(const std::vector<SharePoint>& shares) {
    Chart chart{
        .id = "fig_01_07",
        .title = "Share of the time spent in intersection tests against the number of triangles",
        .x_label = "triangles",
        .y_label = "share of time in intersection tests, %",
        .log_x = true,
        .series = {}};
    for (const std::string& scene : scenes_of(shares)) {
        std::vector<double> triangles, percent;
        for (const SharePoint& point : of_scene(shares, scene)) {
            triangles.push_back(point.triangles);
            percent.push_back(100.0 * point.share());
        }
        chart.series.push_back({.name = scene, .x = triangles, .y = percent});
    }
    return chart;
}

std::vector<ClaimAnswer> answer_claims(const std::vector<SceneCounts>& counts,
                                       const std::vector<GrowthPoint>& growth,
                                       const std::vector<SharePoint>& shares) {
    const auto linear = [](double slope) { return slope >= 0.9 && slope <= 1.1; };

    // H1 and P1: growth.
    std::vector<std::string> naive_slopes, rasteriser_slopes;
    std::size_t naive_linear = 0, rasteriser_linear = 0;
    const std::vector<std::string> grown = scenes_of(growth);
    for (const std::string& scene : grown) {
        const Slopes slope = slopes(growth, scene);
        naive_slopes.push_back(fmt::format("{} {:.2f}", scene, slope.naive));
        rasteriser_slopes.push_back(fmt::format("{} {:.2f} ({:.2f} over all)", scene,
                                                slope.rasteriser_last, slope.rasteriser));
        naive_linear += linear(slope.naive);
        rasteriser_linear += slope.rasteriser_last >= 0.8 && slope.rasteriser_last <= 1.2;
    }
    const auto [least, most] =
        std::minmax_element(growth.begin(), growth.end(),
                            [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
    const std::string range = fmt::format("{}; {} to {} triangles", joined(grown),
                                          with_commas(static_cast<std::uint64_t>(least->triangles)),
                                          with_commas(static_cast<std::uint64_t>(most->triangles)));

    // H2: the share.
    const auto [lowest, highest] =
        std::minmax_element(shares.begin(), shares.end(),
                            [](const auto& a, const auto& b) { return a.share() < b.share(); });
    const Verdict share_verdict = highest->share() < 0.90    ? Verdict::refuted
                                  : highest->share() <= 0.97 ? Verdict::confirmed
                                                             : Verdict::depends;

    // H3 and H14: counts.
    Winding winding;
    std::uint64_t hits = 0, printed = 0, reversed = 0;
    std::size_t erasing = 0;
    std::vector<std::string> counted;
    for (const SceneCounts& scene : counts) {
        winding.triangles += scene.winding.triangles;
        winding.flipped += scene.winding.flipped;
        winding.kept += scene.winding.kept;
        hits += scene.rendering.hits;
        printed += scene.hits_as_printed;
        reversed += scene.hits_in_reverse;
        erasing += scene.hits_as_printed < scene.rendering.hits;
        counted.push_back(scene.scene);
    }
    const bool flips = winding.flipped == winding.triangles && winding.kept == winding.triangles;

    return {
        {"H1", over_scenes(naive_linear, grown.size()),
         fmt::format("log-log slopes: {}", joined(naive_slopes)), range,
         "confirmed if the slope of naive tracing time over the triangles is within 0.9 .. 1.1 on "
         "every scene, refuted "
         "if "
         "on none"},
        {"H2", share_verdict,
         fmt::format("from {:.1f} % ({}, {} triangles) to {:.1f} % ({}, {} triangles): the share "
                     "grows with the triangles",
                     100.0 * lowest->share(), lowest->scene,
                     with_commas(static_cast<std::uint64_t>(lowest->triangles)),
                     100.0 * highest->share(), highest->scene,
                     with_commas(static_cast<std::uint64_t>(highest->triangles))),
         joined(scenes_of(shares)),
         "confirmed if the largest share is within 90 .. 97 %, depends (on the number of "
         "triangles) if it is larger, "
         "refuted if it is smaller"},
        {"H3", flips ? Verdict::confirmed : Verdict::refuted,
         fmt::format("of {} triangles {} flip when two vertices are exchanged, {} keep their side "
                     "when the vertices are "
                     "turned in a circle",
                     with_commas(winding.triangles), with_commas(winding.flipped),
                     with_commas(winding.kept)),
         joined(counted), "confirmed if all triangles do both"},
        {"H14", over_scenes(erasing, counts.size()),
         fmt::format("of {} pixels that hit something {} still show it as printed, {} with the "
                     "triangles in reverse order",
                     with_commas(hits), with_commas(printed), with_commas(reversed)),
         joined(counted),
         "confirmed if Algorithm 1 as printed shows fewer hits than there are on every scene, "
         "refuted if on none"},
        {"P1", over_scenes(rasteriser_linear, grown.size()),
         fmt::format("log-log slopes between the two largest sizes: {}", joined(rasteriser_slopes)),
         range,
         "confirmed if the slope of rasterising time over the triangles, at the largest sizes, is "
         "within 0.8 .. 1.2 on "
         "every "
         "scene, refuted if on none"},
    };
}

void print_counts(const std::vector<SceneCounts>& all) {
    print_heading("Tests per pixel, and hits that Algorithm 1 as printed erases");
    Table tests({"scene", "triangles", "lights", "pixels", "hits", "as printed", "in reverse",
                 "shadow rays", "occluded", "tests", "per pixel"});
    for (const SceneCounts& s : all)
        tests.row({s.scene, with_commas(s.triangles), with_commas(s.lights), with_commas(s.pixels),
                   with_commas(s.rendering.hits), with_commas(s.hits_as_printed),
                   with_commas(s.hits_in_reverse), with_commas(s.rendering.shadow_rays),
                   with_commas(s.rendering.occluded),
                   with_commas(s.rendering.traversal.triangles_tested),
                   with_commas(s.rendering.traversal.triangles_tested / s.pixels)});
    tests.print();

    print_heading("Ray tracer and rasteriser: pixels in which they see different triangles");
    Table coverage(
        {"scene", "pixels", "covered", "differ", "near an edge", "same depth", "unexplained"});
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
        times.row({point.scene, with_commas(std::uint64_t(point.triangles)),
                   fmt::format("{:.1f}", point.naive_us),
                   fmt::format("{:.4f}", point.rasteriser_us),
                   fmt::format("{:.0f}", point.naive_us / point.rasteriser_us)});
    times.print();

    print_heading("Share of the time spent in intersection tests");
    Table share({"scene", "triangles", "rendering, ms", "its tests alone, ms", "share"});
    for (const SharePoint& point : shares)
        share.row({point.scene, with_commas(std::uint64_t(point.triangles)),
                   fmt::format("{:.2f}", point.rendering_ms),
                   fmt::format("{:.2f}", point.intersections_ms),
                   fmt::format("{:.1f} %", 100 * point.share())});
    share.print();
}

}  // namespace space::ch01
