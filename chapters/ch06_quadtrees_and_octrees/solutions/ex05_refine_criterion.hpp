/// @file
/// Exercise 6.5, our answer.
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

inline bool must_be_split(const PartialPicture& picture, const SquareCell& cell, float threshold) {
    if (cell.edge == 1) return false;
    const int right = std::min(cell.x + cell.edge, picture.width - 1);
    const int below = std::min(cell.y + cell.edge, picture.height - 1);
    Color least(infinity), largest(-infinity);
    std::optional<std::uint32_t> surface;
    for (int y = cell.y; y <= below; ++y)
        for (int x = cell.x; x <= right; ++x) {
            const std::optional<TakenSample>& sample = picture.at(x, y);
            if (!sample) continue;
            if (!is_finite<3>(sample->color)) return true;
            if (surface.value_or(sample->surface) != sample->surface) return true;
            surface = sample->surface;
            least = glm::min(least, sample->color);
            largest = glm::max(largest, sample->color);
        }
    for (int channel = 0; channel < 3; ++channel)
        if (double{largest[channel]} - double{least[channel]} > double{threshold}) return true;
    return false;
}

}  // namespace space
