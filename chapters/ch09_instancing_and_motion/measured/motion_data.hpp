/// @file
/// What chapter 9 counts and times of trees that follow moving triangles, as plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch09 {

/// What work is, in units of a triangle test; the clock says about the same.
struct MotionUnits {
    static constexpr double node = 2.25;     ///< visited by a ray, as BvhCosts has it
    static constexpr double test = 1.0;      ///< of a triangle
    static constexpr double binned = 3.5;    ///< a reference in a node that is cut
    static constexpr double refitted = 1.5;  ///< a triangle, with its share of the nodes

    static double of_rays(std::uint64_t nodes, std::uint64_t tests) {
        return node * double(nodes) + test * double(tests);
    }
};

/// Ways to follow.
inline constexpr std::string_view built_anew = "built anew", refitted = "refitted",
                                  rotated = "with rotations",
                                  rotated_singly = "with rotations, leaves of one",
                                  two_levels = "two levels", two_levels_local = "two levels, local";

/// A scene's tree, made anew and refitted.
struct RefitPoint {
    std::string scene;
    std::uint64_t n = 0, nodes = 0;
    std::uint64_t binned = 0;  ///< references in nodes that the builder cuts, all of them
    // None where nothing is timed.
    double build_ms = 0.0;            ///< by bins
    double morton_ms = 0.0;           ///< the quickest builder
    double two_passes_ms = 0.0;       ///< chapter 7's refit, which has no copies of triangles
    double fetched_between_ms = 0.0;  ///< one pass, each leaf fetching its triangles
    double refit_ms = 0.0;            ///< fetched first, then one pass
    double rotate_ms = 0.0;           ///< the same with rotations
    double ns_per_unit = 0.0;         ///< of what rays cost

    double work_ratio() const {
        return MotionUnits::binned * double(binned) / (MotionUnits::refitted * double(n));
    }
    double ratio() const { return build_ms / refit_ms; }
    double binned_units() const { return 1e6 * build_ms / double(binned) / ns_per_unit; }
    double refitted_units() const { return 1e6 * refit_ms / double(n) / ns_per_unit; }
};

/// Triangles moved by random vectors of one length (V5).
struct ScatterPoint {
    double length = 0.0, published = 0.0;  ///< nodes per ray, as many times those of a new tree
    double nodes = 0.0, tests = 0.0;       ///< as many times
    std::uint64_t rays = 0, wrong = 0;
};

/// One frame of a motion, followed in one way.
struct FramePoint {
    std::string scene;
    std::string_view motion, way;
    std::size_t frame = 0;
    std::uint64_t n = 0, rays = 0, nodes = 0, tests = 0, depth = 0;
    std::uint64_t rotations = 0;  ///< in this frame
    std::uint64_t wrong = 0;      ///< answers that are not those of the tree that is built anew
    double expected = 0.0;        ///< cost of a ray by surface areas

    double per_ray() const { return MotionUnits::of_rays(nodes, tests) / double(rays); }
    double nodes_per_ray() const { return double(nodes) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
};

/// A policy over all frames of a motion, for so many rays a frame.
struct PolicyPoint {
    std::string scene;
    std::string_view motion;
    std::string policy;
    double rays_per_triangle = 0.0;
    std::uint64_t frames = 0, builds = 0;
    double total = 0.0;  ///< in units of a triangle test
    double best = 0.0;   ///< of the best in hindsight

    double over_best() const { return total / best; }
};

/// Some frames of a walking crowd, followed in one way.
struct CrowdPoint {
    std::string_view way;
    std::uint64_t walkers = 0, n = 0, frames = 0, rays = 0, nodes = 0, tests = 0, wrong = 0;
    std::uint64_t bytes = 0;
    std::uint64_t boxes = 0;                 ///< made anew in a frame: of triangles or of instances
    double update_ms = 0.0, trace_ms = 0.0;  ///< a frame

    double nodes_per_ray() const { return double(nodes) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
};

/// All of it.
struct MotionMeasurements {
    std::vector<RefitPoint> refits;
    std::vector<ScatterPoint> scatters;
    std::vector<FramePoint> frames;
    std::vector<PolicyPoint> policies;
    std::vector<CrowdPoint> crowd;
};

}  // namespace space::ch09
