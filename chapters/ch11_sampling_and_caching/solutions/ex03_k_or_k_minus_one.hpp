/// @file
/// Exercise 11.3, our answer: k - 1 where the disc ends at the k-th, all where its radius was given
/// before any photon was looked at. With N and n photons within `largest` and `smallest`, and for 1
/// photon per area, the three cases add to the mean P(N <= k - 2), P(N >= k - 1) - P(n >= k - 1)
/// and P(n >= k - 1): 1.
#pragma once

#include <cstddef>
#include <numbers>
#include <span>

namespace space {

/// `squares`: the squared distances of all photons within `largest`, ascending. 2 <= k, 0 <
/// smallest < largest.
inline double photons_per_area(std::span<const double> squares, std::size_t k, double smallest,
                               double largest) {
    const auto per_area = [](std::size_t photons, double square) {
        return static_cast<double>(photons) / (std::numbers::pi * square);
    };
    if (squares.size() < k) return per_area(squares.size(), largest * largest);
    if (squares[k - 1] > smallest * smallest) return per_area(k - 1, squares[k - 1]);
    std::size_t within = k;
    while (within < squares.size() && squares[within] <= smallest * smallest) ++within;
    return per_area(within, smallest * smallest);
}

}  // namespace space
