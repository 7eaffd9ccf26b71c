/// @file
/// What chapter 1 counts and measures, and how its claims are answered from that.
#pragma once

#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/chart.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch01 {

/// How many sizes and rounds a measurement takes: for tests, for a look, for the book.
enum class Effort { small, quick, full };
Effort effort_of(const Options& options);

/// The vertex order against the front side, over all triangles with an area.
struct Winding {
    std::uint64_t triangles = 0;
    std::uint64_t flipped = 0;  ///< with two vertices exchanged the normal is the exact opposite
    std::uint64_t kept = 0;     ///< with the vertices turned in a circle it points to the same side

    bool operator==(const Winding&) const = default;
};

/// One scene at a small picture size: counts, the same on every machine.
struct SceneCounts {
    std::string scene;
    std::uint64_t triangles = 0, lights = 0, pixels = 0;
    RenderCounts rendering;
    std::uint64_t hits_as_printed =
        0;  ///< pixels that still show a triangle in Algorithm 1 as printed
    std::uint64_t hits_in_reverse =
        0;  ///< the same, the triangles listed from the last to the first
    Coverage coverage;
    Winding winding;
};
/// The scene with its triangles listed from the last to the first.
Scene in_reverse(Scene scene);
/// For five scenes. --small takes their small sizes.
std::vector<SceneCounts> count_scenes(Effort effort, std::uint64_t seed, unsigned threads);

/// Time to draw one scene with one thread, divided by the picture's pixels: 8 x 6 for the naive ray
/// tracer, whose time is linear in them, 640 x 480 for the rasteriser.
struct GrowthPoint {
    std::string scene;
    double triangles = 0;
    double naive_us = 0,
           rasteriser_us = 0;  ///< microseconds per pixel, medians of interleaved runs
};
/// Five scenes, from 1 K to 1 M triangles (slivers to 100 K).
std::vector<GrowthPoint> measure_growth(Effort effort, std::uint64_t seed);

/// Whitted's share. A picture is rendered once to record its rays; then rendering is timed, and
/// beside it, in turns, the same rays' intersection tests alone.
struct SharePoint {
    std::string scene;
    double triangles = 0;
    double rendering_ms = 0, intersections_ms = 0;  ///< medians of interleaved runs

    /// More than all is the clock's noise.
    double share() const { return std::min(1.0, intersections_ms / rendering_ms); }
};
std::vector<SharePoint> measure_shares(Effort effort, std::uint64_t seed);

/// fig_01_06: time per pixel against triangles, both renderers, two of the scenes.
Chart growth_chart(const std::vector<GrowthPoint>& growth);
/// fig_01_07: share of time in intersection tests against triangles.
Chart share_chart(const std::vector<SharePoint>& shares);

/// The points of one scene, in the order they were measured.
template <class Point>
std::vector<Point> of_scene(const std::vector<Point>& points, const std::string& scene) {
    std::vector<Point> some;
    for (const Point& point : points)
        if (point.scene == scene) some.push_back(point);
    return some;
}
/// The scenes of a measurement, each once, in their order.
template <class Point>
std::vector<std::string> scenes_of(const std::vector<Point>& points) {
    std::vector<std::string> names;
    for (const Point& point : points)
        if (names.empty() || names.back() != point.scene) names.push_back(point.scene);
    return names;
}

/// Growth exponents of one scene: naive tracing over all sizes; rasterising over all, and between
/// the two largest, where the pixels' share has faded.
struct Slopes {
    double naive, rasteriser, rasteriser_last;
};
Slopes slopes(const std::vector<GrowthPoint>& growth, const std::string& scene);

/// The answers to H1, H2, H3, H14 and P1.
std::vector<ClaimAnswer> answer_claims(const std::vector<SceneCounts>& counts,
                                       const std::vector<GrowthPoint>& growth,
                                       const std::vector<SharePoint>& shares);

/// Tables on the terminal.
void print_counts(const std::vector<SceneCounts>& all);
void print_times(const std::vector<GrowthPoint>& growth, const std::vector<SharePoint>& shares);

}  // namespace space::ch01
