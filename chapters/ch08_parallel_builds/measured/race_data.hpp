/// @file
/// What two threads lose that share a scratch, as plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

/// One scene, and schedules of one kind.
struct RacePoint {
    std::string scene;
    std::string_view schedule;
    bool is_cured = false;  ///< each thread has a scratch of its own
    std::uint64_t n = 0;    ///< triangles
    std::uint64_t schedules = 0;
    std::uint64_t losing =
        0;  ///< of them, those in which triangles lie outside of boxes above them
    std::uint64_t least = 0, median = 0, most = 0;  ///< such triangles, over all schedules
};

}  // namespace space::ch08
