/// @file
/// How long memory takes to answer: lines of memory in a random circle, each of which tells the
/// next. No access can begin before the one before it has ended, so none hides another.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "common/pcg32.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace space {

/// A cache line of the circle.
struct alignas(64) ChaseLine {
    std::uint32_t next;
};
static_assert(sizeof(ChaseLine) == 64);

/// Lines in a circle. `Allocator` decides how large the pages are.
template <class Allocator = CacheLineAllocator<ChaseLine>>
using ChaseCircle = std::vector<ChaseLine, Allocator>;

// [chase_circle]
/// All lines in one circle, in an order by chance: Sattolo's shuffle (1986), which makes a
/// permutation of a single cycle. A shuffle as usual would fall into several cycles, and the walk
/// stay in a short one.
template <class Allocator = CacheLineAllocator<ChaseLine>>
ChaseCircle<Allocator> make_chase_circle(std::size_t lines, std::uint64_t seed,
                                         const Allocator& allocator = {}) {
    ChaseCircle<Allocator> circle(lines, allocator);
    for (std::uint32_t i = 0; i < lines; ++i) circle[i].next = i;
    Pcg32 random(seed);
    for (auto i = static_cast<std::uint32_t>(lines); i-- > 1;)
        std::swap(circle[i].next, circle[random.below(i)].next);
    return circle;
}
// [chase_circle]

// [chase]
/// Goes from line to line. @return where it comes to
template <class Allocator>
std::uint32_t chase(const ChaseCircle<Allocator>& circle, std::size_t steps,
                    std::uint32_t from = 0) {
    for (std::size_t i = 0; i < steps; ++i) from = circle[from].next;
    return from;
}
// [chase]

/// The same from several lines at once, `Walkers` steps in flight: what a thread can hide of its
/// own waits.
template <std::size_t Walkers, class Allocator>
std::uint32_t chase_together(const ChaseCircle<Allocator>& circle, std::size_t steps) {
    std::uint32_t at[Walkers];
    for (std::size_t w = 0; w < Walkers; ++w)
        at[w] = static_cast<std::uint32_t>(w * circle.size() / Walkers);
    for (std::size_t i = 0; i < steps; ++i)
        for (std::size_t w = 0; w < Walkers; ++w) at[w] = circle[at[w]].next;
    std::uint32_t sum = 0;
    for (const std::uint32_t line : at) sum += line;
    return sum;
}

}  // namespace space
