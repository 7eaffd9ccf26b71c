/// @file
/// Counting over many random inputs on several threads, with the same result for any number of
/// them.
#pragma once

#include "common/parallel.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace space::ch02 {

/// Inputs that share one stream of random numbers: the work of one thread at a time.
inline constexpr std::uint64_t chunk_size = 4096;

/// Calls count(random, how many) for the chunks of all `inputs`, each on some thread; returns the
/// parts in order.
template <class Part, class Count>
std::vector<Part> count_by_chunks(std::uint64_t inputs, std::uint64_t seed, unsigned threads,
                                  const Count& count) {
    std::vector<Part> parts((inputs + chunk_size - 1) / chunk_size);
    parallel_for(parts.size(), threads, 1, [&](std::size_t i) {
        Pcg32 random(seed, i);
        parts[i] = count(random, std::min(chunk_size, inputs - i * chunk_size));
    });
    return parts;
}

}  // namespace space::ch02
