/// @file
/// What is counted and timed of trees in turned objects, as plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch09 {

inline constexpr std::string_view inverse_ray = "inverse ray",
                                  inverse_ray_exact = "the same, world triangles",
                                  boxes_boxed = "turned boxes boxed", boxes_refitted = "refitted",
                                  tree_anew = "built anew";

/// A scene that stands there turned, by random rotations, and rays from around it; all rotations
/// together.
struct TurnedTree {
    std::string scene;
    std::string_view way;
    std::uint64_t triangles = 0, rays = 0;
    std::uint64_t nodes = 0, tests = 0;  ///< visited, tested
    std::uint64_t others = 0;            ///< answers that are not those in a tree anew, in any bit
    std::uint64_t other_triangles = 0;   ///< of these, another triangle, or a hit or miss
    double volume = 0.0;                 ///< of all boxes, of that of the local tree's
    double surface = 0.0;                ///< the same
    double root_volume = 0.0;            ///< of the root alone
    double ns = 0.0;                     ///< of a ray; 0 where nothing is timed

    double nodes_per_ray() const { return double(nodes) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
};

/// All of it, the ways of a scene one after the other.
struct BoxingMeasurements {
    std::vector<TurnedTree> trees;
};

}  // namespace space::ch09
