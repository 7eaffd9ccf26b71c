/// @file
/// Exercise 12.2, a solution: lines are compared by where they cross, in whole numbers.
#pragma once

#include <algorithm>
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

/// The first number of rays at which `flat`, with the smaller time for each ray, is to be taken.
inline std::uint64_t taken_from(std::span<const BuildAndRay> all, std::size_t steep,
                                std::size_t flat) {
    if (all[flat].build_ps < all[steep].build_ps) return 0;
    const std::uint64_t dearer = all[flat].build_ps - all[steep].build_ps,
                        gained = all[steep].ray_ps - all[flat].ray_ps;
    const bool is_taken_at_a_tie = dearer % gained == 0 && flat < steep;
    return dearer / gained + (is_taken_at_a_tie ? 0 : 1);
}

/// The cheapest for so many rays, and of equal ones the first.
inline std::size_t cheapest_for(std::span<const BuildAndRay> all, std::uint64_t rays) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
        const bool is_better = all[i].ray_ps == all[best].ray_ps
                                   ? all[i].build_ps < all[best].build_ps
                               : all[i].ray_ps < all[best].ray_ps ? rays >= taken_from(all, best, i)
                                                                  : rays < taken_from(all, i, best);
        if (is_better) best = i;
    }
    return best;
}

/// The first is from 0 rays on, where there is a structure; each names another one than that before
/// it.
inline std::vector<PaysFrom> break_even(std::span<const BuildAndRay> structures) {
    if (structures.empty()) return {};
    std::vector<PaysFrom> parts{{0, cheapest_for(structures, 0)}};
    for (;;) {
        const std::size_t best = parts.back().structure;
        std::optional<std::uint64_t> next;
        for (std::size_t i = 0; i < structures.size(); ++i) {
            if (structures[i].ray_ps >= structures[best].ray_ps) continue;
            const std::uint64_t from = taken_from(structures, best, i);
            next = std::min(next.value_or(from), from);
        }
        if (!next) return parts;
        parts.push_back({*next, cheapest_for(structures, *next)});
    }
}

}  // namespace space
