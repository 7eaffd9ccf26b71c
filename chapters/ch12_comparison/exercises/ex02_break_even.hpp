/// @file
/// Exercise 12.2: From how many rays on?
/// Difficulty 2 of 3, about 45 minutes.
///
/// A structure that takes *b* to build and *t* for a ray costs b + *N* t for *N* rays: a straight
/// line over *N*. The cheapest structure for *N* rays is the lowest line there; of several that
/// cost the same, the one that stands first. Tell which structure that is for each *N* from 0 to
/// 2^64 - 1, by the numbers of rays from which on it is another one.
///
/// Times are whole picoseconds, up to 2^63 - 1. So the answer is exact, but 2^63 times 2^64 does
/// not fit into 64 bits, and a double holds 53 of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// What a structure costs.
struct BuildAndRay {
    std::uint64_t build_ps;
    std::uint64_t ray_ps;  ///< for each ray
};

/// From so many rays on a structure is the cheapest, until the next such.
struct PaysFrom {
    std::uint64_t rays;
    std::size_t structure;

    bool operator==(const PaysFrom&) const = default;
};

/// The first is from 0 rays on, where there is a structure; each names another one than that before
/// it.
inline std::vector<PaysFrom> break_even(std::span<const BuildAndRay> structures) {
    if (structures.empty()) return {};
    return {{0, 0}};  // TODO: the cheapest, and what comes after it
}

}  // namespace space
