/// @file
/// What chapter 1 counts and measures, as plain values: enough for its tables, charts and verdicts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace space::ch01 {

/// The vertex order against the front side, over all triangles with an area.
struct Winding {
    std::uint64_t triangles = 0;
    std::uint64_t flipped = 0;  ///< with two vertices exchanged the normal is the exact opposite
    std::uint64_t kept = 0;     ///< with the vertices turned in a circle it points to the same side
};

/// One scene at a small picture size: counts, the same on every machine.
struct SceneCounts {
    std::string scene;
    std::uint64_t triangles = 0, lights = 0, pixels = 0;
    std::uint64_t hits = 0, shadow_rays = 0, occluded = 0, tests = 0;  ///< of the ray tracer
    std::uint64_t hits_as_printed =
        0;  ///< pixels that still show a triangle in Algorithm 1 as printed
    std::uint64_t hits_in_reverse =
        0;  ///< the same, the triangles listed from the last to the first
    /// Pixels whose ray, with any real t, first meets what is behind the eye, and those of them
    /// that see something in front.
    std::uint64_t behind = 0, behind_wins = 0;
    /// Pixels in which ray tracer and rasteriser see different triangles, and why (coverage.hpp).
    std::uint64_t covered = 0, disagree = 0, near_edge = 0, same_depth = 0, unexplained = 0;
    Winding winding;
};

/// Time to draw one scene with one thread, divided by the picture's pixels: 8 x 6 for the naive ray
/// tracer, whose time is linear in them, 160 x 120 for the rasteriser.
struct GrowthPoint {
    std::string scene;
    double triangles = 0;
    double naive_us = 0,
           rasteriser_us = 0;  ///< microseconds per pixel, medians of interleaved runs
};

/// Whitted's share. A picture is rendered once to record its rays and their answers. Then two
/// things are timed in turns: the same rays' intersection tests alone, and all the rest of
/// rendering, with the recorded answers in place of tests.
struct SharePoint {
    std::string scene;
    double triangles = 0;
    double tests_ms = 0, rest_ms = 0;  ///< medians of interleaved runs

    double rest() const { return rest_ms / (tests_ms + rest_ms); }
    double share() const { return 1.0 - rest(); }
};

/// Rays aimed at the vertices of a closed surface: those that hit nothing slipped through.
struct VertexLeaks {
    std::uint64_t rays = 0;
    std::uint64_t exact = 0;  ///< of them go exactly through their vertex
    std::uint64_t leaks_float = 0, leaks_double = 0;
    std::uint64_t exact_leaks_double = 0;  ///< of those that go exactly through their vertex
    double float_ms = 0, double_ms = 0;    ///< medians of interleaved runs; 0 where not timed
};

/// All of it.
struct Measurements {
    std::vector<SceneCounts> counts;
    VertexLeaks leaks;
    std::vector<GrowthPoint> growth = {};  ///< none, where only counts were asked for
    std::vector<SharePoint> shares = {};
};

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

}  // namespace space::ch01
