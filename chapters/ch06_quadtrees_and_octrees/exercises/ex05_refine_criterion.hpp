/// @file
/// Exercise 6.5: The refine criterion
/// Difficulty 2 of 3, about 30 minutes.
///
/// A picture, of which some pixels have been traced, is covered by square cells. Say whether a cell
/// must be split. Its evidence are all samples that have been taken from its first pixel to its
/// last corner, both included; the last corner is `edge` pixels to the right of the first pixel and
/// `edge` below it, where the next cell begins, or the picture's last column or row where that lies
/// beyond. A cell of one pixel is never split. A larger one must be if two samples of the evidence
/// show different surfaces, or differ in a channel by more than `threshold` (in double), or if a
/// colour is not finite, be it the only one. Pixels that have not been traced say nothing. Any
/// number may be that of a surface, and colours may be brighter than 1, or negative.
#pragma once

#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace space {

/// What the ray of a pixel has seen.
struct TakenSample {
    Color color;
    std::uint32_t surface;
};

/// A picture of which some pixels have been traced.
struct PartialPicture {
    int width, height;
    std::vector<std::optional<TakenSample>> samples;  ///< row by row from the top left

    const std::optional<TakenSample>& at(int x, int y) const {
        return samples[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
};

/// The pixels x <= column < x + edge, y <= row < y + edge, as far as the picture goes.
struct SquareCell {
    int x, y, edge;
};

inline bool must_be_split(const PartialPicture&, const SquareCell& cell, float /*threshold*/) {
    // TODO: this splits everything, so that all pixels are traced
    return cell.edge > 1;
}

}  // namespace space
