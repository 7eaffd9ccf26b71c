/// @file
/// Do the ray tracer and the rasteriser see the same triangle in every pixel? Where not, how far
/// from an edge?
#pragma once

#include "chapters/ch01_naive_ray_tracing/rasteriser.hpp"
#include "common/parallel.hpp"

#include <algorithm>
#include <cstdint>

namespace space {

/// What the ray through each pixel's centre hits: a depth buffer made by the ray tracer.
template <Accelerator A>
DepthBuffer trace_depth(const PixelGrid& grid, const A& accelerator, unsigned threads) {
    DepthBuffer buffer(grid.width, grid.height);
    parallel_for(static_cast<std::size_t>(grid.height), threads, 1, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < grid.width; ++x)
            if (const auto hit = closest_hit(accelerator, grid.ray(x, y))) buffer.at(x, y) = *hit;
    });
    return buffer;
}

/// Distance of a point from the nearest side of a polygon; infinity for an empty one.
inline double distance_to_outline(const glm::dvec2& point, const std::vector<glm::dvec2>& outline) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 from = outline[i], side = outline[(i + 1) % outline.size()] - from;
        const double length2 = glm::dot(side, side);
        const double along =
            length2 > 0.0 ? std::clamp(glm::dot(point - from, side) / length2, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, glm::distance(point, from + along * side));
    }
    return nearest;
}

/// Where the two renderers see the same triangle, in numbers.
struct Coverage {
    std::uint64_t pixels = 0;
    std::uint64_t covered = 0;   ///< by any triangle, says the ray tracer
    std::uint64_t disagree = 0;  ///< the renderers see different triangles, or only one sees any
    /// Of these: the pixel's centre lies within coverage_distance() of a side of a triangle in
    /// question.
    std::uint64_t near_edge = 0;
    double farthest = 0.0;  ///< of them, in pixels
    /// Or it lies inside both triangles, which meet or overlap there: the depths are the same but
    /// for rounding.
    std::uint64_t same_depth = 0;
    std::uint64_t unexplained = 0;  ///< must be 0

    bool operator==(const Coverage&) const = default;
};

/// Two depths that differ by less than this part are the same: a few roundings to float.
inline constexpr double same_depth_tolerance = 8 * float_roundoff;

inline Coverage compare_coverage(const Scene& scene, const DepthBuffer& traced,
                                 const DepthBuffer& rasterised) {
    const PixelGrid grid(scene.camera, traced.width, traced.height);
    const Rasteriser projector(grid);
    const double limit = coverage_distance(grid);
    Coverage coverage;
    for (int y = 0; y < traced.height; ++y)
        for (int x = 0; x < traced.width; ++x) {
            const Hit &one = traced.at(x, y), &other = rasterised.at(x, y);
            ++coverage.pixels;
            coverage.covered += one.t < infinity;
            if (one.t == infinity && other.t == infinity) continue;
            if (one.t < infinity && other.t < infinity && one.triangle == other.triangle) continue;
            ++coverage.disagree;

            double distance = std::numeric_limits<double>::infinity();
            for (const Hit& hit : {one, other})
                if (hit.t < infinity)
                    distance = std::min(
                        distance,
                        distance_to_outline({x + 0.5, y + 0.5},
                                            projector.outline(scene.mesh.triangle(hit.triangle))));
            if (distance <= limit) {
                ++coverage.near_edge;
                coverage.farthest = std::max(coverage.farthest, distance);
            } else if (std::abs(double{one.t} - other.t) <=
                       same_depth_tolerance * std::min(one.t, other.t)) {
                ++coverage.same_depth;
            } else {
                ++coverage.unexplained;
            }
        }
    return coverage;
}

}  // namespace space
