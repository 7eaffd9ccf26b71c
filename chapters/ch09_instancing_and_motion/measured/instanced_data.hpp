/// @file
/// What is counted and timed of rays through instances, as plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch09 {

inline constexpr std::string_view in_flattened = "flattened mesh", in_world = "world triangles",
                                  in_local = "local triangles",
                                  without_margins = "world triangles, no margins";

/// A way and a triangle test, and its answers beside those of the flattened mesh by the exact test.
struct AccuracyPoint {
    double away = 0.0;  ///< of the objects from the origin; they are about as large as 1
    std::string_view test, way;
    std::uint64_t rays = 0;
    std::uint64_t lost = 0;             ///< a miss where there is a hit
    std::uint64_t invented = 0;         ///< a hit where there is none
    std::uint64_t other_triangles = 0;  ///< both hit, but different triangles
    std::uint64_t other_bits = 0;       ///< the same triangle, but t, u or v are not the same
    double ns = 0.0;                    ///< of a ray; 0 where nothing is timed

    std::uint64_t differ() const { return lost + invented + other_triangles; }
    double share() const { return double(differ()) / double(rays); }
};

/// What rays of one kind cost in the flattened mesh's tree and in two levels.
struct LevelsCost {
    std::uint64_t rays = 0;
    std::uint64_t flat_nodes = 0, flat_tests = 0, nodes = 0, tests = 0;
    std::uint64_t differ = 0;  ///< answers by world triangles, in any bit
    double flat_ns = 0.0, local_ns = 0.0, world_ns = 0.0;  ///< of a ray

    double local() const { return local_ns / flat_ns; }
    double world() const { return world_ns / flat_ns; }
    double world_over_local() const { return world_ns / local_ns; }
};

/// An object many times, and the same as one mesh.
struct LevelsPoint {
    std::string object;
    double spacing = 0.0;  ///< of the instances, in diagonals of the object's box
    std::uint64_t instances = 0, triangles = 0;
    std::uint64_t flat_bytes = 0, bytes = 0;  ///< of the trees with their triangles
    LevelsCost from_around, diffuse;
};

/// All of it.
struct InstancedMeasurements {
    std::vector<AccuracyPoint> accuracy;
    std::vector<LevelsPoint> levels;
};

}  // namespace space::ch09
