/// @file
/// Exercise 11.3, a near miss: k - 1 wherever there are k, also where the disc is `smallest`, and
/// holds them all whoever is the k-th.
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
    return per_area(k - 1, smallest * smallest);
}

}  // namespace space
