/// @file
/// What is counted and timed of adaptive sampling, as plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch06 {

/// One picture by one rule, beside the full one.
struct AdaptivePoint {
    std::string scene;
    std::string_view rule;
    int threshold = 0, first_cell = 0;
    std::uint64_t pixels = 0, rays = 0, cells = 0;
    std::uint64_t other = 0;  ///< pixels that the screen shows otherwise than the full picture's
    std::uint64_t wrong = 0;  ///< by more than `visible_steps`
    int largest = 0;          ///< of all differences, in steps
    std::uint64_t different =
        0;  ///< traced pixels without the full picture's colour: there are none
    double full_ms = 0.0, ms = 0.0;

    double ray_share() const { return double(rays) / double(pixels); }
    double wrong_share() const { return double(wrong) / double(pixels); }
    double time_share() const { return ms / full_ms; }

    /// Of the screen's 255, in one channel.
    static constexpr int visible_steps = 8;
    static constexpr int usual_threshold = 8, usual_first_cell = 16;
    bool is_usual() const { return threshold == usual_threshold && first_cell == usual_first_cell; }
};

/// What cells are judged by: colours, and surfaces besides; at their corners, or by all samples.
inline constexpr std::string_view by_colors = "corners: colours",
                                  by_objects = "corners: colours, objects",
                                  by_all_samples = "all samples: colours, objects",
                                  by_triangles = "all samples: colours, triangles";

}  // namespace space::ch06
