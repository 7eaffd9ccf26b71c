#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace space::ch01 {
namespace {

/// H1, P18 and P1: how the times grow.
std::array<ClaimAnswer, 3> growth_claims(const std::vector<GrowthPoint>& growth) {
    const auto linear = [](double slope) { return slope >= 0.9 && slope <= 1.1; };
    const auto quadratic = [](double slope) { return slope >= 1.8 && slope <= 2.2; };
    std::vector<std::string> naive_slopes, rasteriser_slopes;
    std::size_t naive_linear = 0, naive_quadratic = 0, rasteriser_linear = 0;
    const std::vector<std::string> grown = scenes_of(growth);
    for (const std::string& scene : grown) {
        const Slopes slope = slopes(growth, scene);
        naive_slopes.push_back(fmt::format("{} {:.2f}", scene, slope.naive));
        rasteriser_slopes.push_back(fmt::format("{} {:.2f} ({:.2f} over all)", scene,
                                                slope.rasteriser_last, slope.rasteriser));
        naive_linear += linear(slope.naive);
        naive_quadratic += quadratic(slope.naive);
        rasteriser_linear += slope.rasteriser_last >= 0.8 && slope.rasteriser_last <= 1.2;
    }
    const auto [least, most] =
        std::minmax_element(growth.begin(), growth.end(),
                            [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
    const std::string range = fmt::format("{}; {} to {} triangles", joined(grown),
                                          with_commas(static_cast<std::uint64_t>(least->triangles)),
                                          with_commas(static_cast<std::uint64_t>(most->triangles)));

    return {
        {{"H1", verdict_of(naive_linear, grown.size()),
          fmt::format("log-log slopes: {}", joined(naive_slopes)), range,
          "confirmed if the slope of naive tracing time over the triangles is within 0.9 .. 1.1 on "
          "every scene, refuted if on none"},
         {"P18", verdict_of(naive_quadratic, grown.size()),
          fmt::format("log-log slopes of naive tracing time per pixel: {}", joined(naive_slopes)),
          range,
          "confirmed if the slope over the triangles is within 1.8 .. 2.2 on every scene, refuted "
          "if "
          "on none"},
         {"P1", verdict_of(rasteriser_linear, grown.size()),
          fmt::format("log-log slopes between the two largest sizes: {}",
                      joined(rasteriser_slopes)),
          range,
          "confirmed if the slope of rasterising time over the triangles, at the largest sizes, is "
          "within 0.8 .. 1.2 on every scene, refuted if on none"}}};
}

/// H2: the share of the tests.
ClaimAnswer share_claim(const std::vector<SharePoint>& shares) {
    const auto [lowest, highest] =
        std::minmax_element(shares.begin(), shares.end(),
                            [](const auto& a, const auto& b) { return a.share() < b.share(); });
    std::size_t steps = 0, rises = 0;
    std::vector<double> rest_slopes;
    for (const std::string& scene : scenes_of(shares)) {
        const std::vector<SharePoint> points = of_scene(shares, scene);
        for (std::size_t i = 1; i < points.size(); ++i, ++steps)
            rises += points[i].share() > points[i - 1].share();
        rest_slopes.push_back(share_slopes(shares, scene).rest);
    }
    const auto [flattest, steepest] = std::minmax_element(rest_slopes.begin(), rest_slopes.end());
    const Verdict share_verdict = highest->share() < 0.90    ? Verdict::refuted
                                  : highest->share() <= 0.97 ? Verdict::confirmed
                                                             : Verdict::depends;

    return {
        "H2", share_verdict,
        fmt::format(
            "from {:.1f} % ({}, {} triangles) to {:.4f} % ({}, {} triangles); from one size "
            "of a scene to the next the share rises {} of {} times; log-log slopes of "
            "the time without tests: {:.2f} to {:.2f}",
            100.0 * lowest->share(), lowest->scene,
            with_commas(static_cast<std::uint64_t>(lowest->triangles)), 100.0 * highest->share(),
            highest->scene, with_commas(static_cast<std::uint64_t>(highest->triangles)), rises,
            steps, *flattest, *steepest),
        joined(scenes_of(shares)),
        "confirmed if the largest share is within 90 .. 97 %, depends (on the number of "
        "triangles) if it is larger, "
        "refuted if it is smaller"};
}

/// H3, H14 and H16: counts.
std::array<ClaimAnswer, 3> count_claims(const std::vector<SceneCounts>& counts) {
    Winding winding;
    std::uint64_t hits = 0, printed = 0, reversed = 0, behind = 0, behind_wins = 0;
    std::size_t erasing = 0;
    std::vector<std::string> counted, surrounded;
    for (const SceneCounts& scene : counts) {
        winding.triangles += scene.winding.triangles;
        winding.flipped += scene.winding.flipped;
        winding.kept += scene.winding.kept;
        hits += scene.hits;
        printed += scene.hits_as_printed;
        reversed += scene.hits_in_reverse;
        behind += scene.behind;
        behind_wins += scene.behind_wins;
        if (scene.behind) surrounded.push_back(scene.scene);
        erasing += scene.hits_as_printed < scene.hits;
        counted.push_back(scene.scene);
    }
    const bool flips = winding.flipped == winding.triangles && winding.kept == winding.triangles;

    return {
        {{"H3", flips ? Verdict::confirmed : Verdict::refuted,
          fmt::format("of {} triangles {} flip when two vertices are exchanged, {} keep their side "
                      "when the vertices are "
                      "turned in a circle",
                      with_commas(winding.triangles), with_commas(winding.flipped),
                      with_commas(winding.kept)),
          joined(counted), "confirmed if all triangles do both"},
         {"H14", verdict_of(erasing, counts.size()),
          fmt::format("of {} pixels that hit something {} still show it as printed, {} with the "
                      "triangles in reverse order",
                      with_commas(hits), with_commas(printed), with_commas(reversed)),
          joined(counted),
          "confirmed if Algorithm 1 as printed shows fewer hits than there are on every scene, "
          "refuted if on none"},
         {"H16", behind_wins ? Verdict::confirmed : Verdict::refuted,
          fmt::format(
              "with t in R the smallest t of {} pixels' rays is behind the eye, on {}; {} of "
              "these see something in front, which loses",
              with_commas(behind), surrounded.empty() ? "no scene" : joined(surrounded),
              with_commas(behind_wins)),
          joined(counted),
          "confirmed if what is behind the eye wins over something in front in one pixel"}}};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    const auto [h1, p18, p1] = growth_claims(measured.growth);
    const auto [h3, h14, h16] = count_claims(measured.counts);
    return {h1, share_claim(measured.shares), h3, h14, h16, p1, p18};
}

}  // namespace space::ch01
