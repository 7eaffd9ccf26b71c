/// @file
/// Exercise 12.2, a near miss: right in all that a picture needs. But crossings are computed in
/// doubles, whose 53 bits do not tell two builds of 2^60 ps apart that differ by one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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

inline double cost_of(const BuildAndRay& structure, double rays) {
    return double(structure.build_ps) + rays * double(structure.ray_ps);
}

/// The cheapest for so many rays, and of equal ones the first.
inline std::size_t cheapest_for(std::span<const BuildAndRay> all, double rays) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (cost_of(all[i], rays) < cost_of(all[best], rays)) best = i;
    return best;
}

/// The first is from 0 rays on, where there is a structure; each names another one than that before
/// it.
inline std::vector<PaysFrom> break_even(std::span<const BuildAndRay> structures) {
    if (structures.empty()) return {};
    std::vector<PaysFrom> parts{{0, cheapest_for(structures, 0.0)}};
    for (;;) {
        const std::size_t best = parts.back().structure;
        std::optional<double> next;
        for (std::size_t i = 0; i < structures.size(); ++i) {
            const BuildAndRay &flat = structures[i], &steep = structures[best];
            if (flat.ray_ps >= steep.ray_ps) continue;
            const double crossing = (double(flat.build_ps) - double(steep.build_ps)) /
                                    (double(steep.ray_ps) - double(flat.ray_ps));
            const double up = std::ceil(crossing);
            const double from = up == crossing && i > best ? up + 1 : up;
            next = std::min(next.value_or(from), from);
        }
        if (!next) return parts;
        const std::size_t after = cheapest_for(structures, *next);
        if (after == best) return parts;  // rounding
        parts.push_back({std::uint64_t(std::max(0.0, *next)), after});
    }
}

}  // namespace space
