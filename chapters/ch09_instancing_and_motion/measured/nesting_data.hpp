/// @file
/// What is counted and timed of scenes that grow by nesting, as plain values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch09 {

/// The ways to trace a scene.
namespace nesting_way {
inline constexpr std::string_view exact = "exact instances", usual = "usual instances",
                                  flattened = "flattened", embree = "Embree's instances",
                                  embree_flattened = "Embree, flattened";
}  // namespace nesting_way

/// What one way took, and how its answers differ from the exact ones.
struct NestingTrace {
    std::string_view way;
    std::size_t bytes = 0;
    double ray_ns = 0.0;  ///< 0 where nothing is timed
    /// Rays with a hit for a miss, or a miss for a hit; with another triangle; with the same, in
    /// other bits.
    std::uint64_t other_hit = 0, other_triangle = 0, other_bits = 0;

    std::uint64_t other_answer() const { return other_hit + other_triangle; }
    std::uint64_t differing() const { return other_hit + other_triangle + other_bits; }
};

/// A scene of one size, and a picture's rays through it.
struct NestingPoint {
    std::string scene;
    std::uint64_t triangles = 0;
    std::size_t objects = 0, instances = 0;
    std::uint64_t places = 0;  ///< of meshes, when all groups are taken apart
    std::uint64_t rays = 0, hits = 0;
    double visits = 0.0, tests = 0.0;  ///< per ray, in the exact way
    /// The first is the exact way. Flattened where that is small enough, Embree where it is
    /// installed and all places are few enough.
    std::vector<NestingTrace> traces = {};

    const NestingTrace* by(std::string_view way) const {
        const auto found = std::ranges::find(traces, way, &NestingTrace::way);
        return found == traces.end() ? nullptr : &*found;
    }
};

/// A scene level by level, and scenes of more than 10^9 triangles.
struct NestingMeasurements {
    std::vector<NestingPoint> levels, large;
};

}  // namespace space::ch09
