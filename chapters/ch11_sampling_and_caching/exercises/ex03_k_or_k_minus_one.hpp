/// @file
/// Exercise 11.3: k or k - 1?
/// Difficulty 2 of 3, about 40 minutes.
///
/// Photons lie on a plane. How many are there per area near a point? Take a disc around the point
/// that reaches as far as the *k*-th nearest photon, and divide the number of photons by the disc's
/// area. But a disc that ends at a photon is no disc by chance: is it *k* photons, or *k* - 1?
///
/// The disc never is smaller than `smallest`, because photons may lie on the point itself, nor
/// larger than `largest`, within which there may be fewer than *k*; on its edge a photon is within.
/// How many count in these cases? Wherever photons lie by chance, everywhere as dense, your answers
/// have to be right on average: for any density, *k* and radii. The check has some by hand, and
/// the averages of thousands.
#pragma once

#include <cstddef>
#include <numbers>
#include <span>

namespace space {

/// `squares`: the squared distances of all photons within `largest`, ascending. 2 <= k, 0 <
/// smallest < largest.
inline double photons_per_area(std::span<const double> squares, std::size_t /*k*/,
                               double /*smallest*/, double largest) {
    // TODO: right on average, but noisy, and blurred where the light changes
    return static_cast<double>(squares.size()) / (std::numbers::pi * largest * largest);
}

}  // namespace space
