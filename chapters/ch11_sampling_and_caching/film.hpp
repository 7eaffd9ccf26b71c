/// @file
/// What a picture is while it is made: for each pixel the sum of the light of its samples.
#pragma once

#include "common/geometry.hpp"
#include "common/program/image.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// Sums of radiance, RGB, row by row from the top left. Each pixel has as many samples as the
/// others.
struct Film {
    int width = 0, height = 0;
    std::uint32_t samples = 0;  ///< that every pixel has
    std::vector<Double3> sums;

    Film() = default;
    Film(int w, int h)
        : width(w), height(h), sums(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    /// The mean of the pixel's samples; black before the first.
    Double3 radiance(int x, int y) const {
        return samples ? sums[pixel(x, y)] / double(samples) : Double3(0.0);
    }
    /// The radiance times `exposure`, linear.
    Image image(double exposure = 1.0) const {
        Image picture(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) picture.at(x, y) = glm::vec3(exposure * radiance(x, y));
        return picture;
    }
    bool operator==(const Film&) const = default;
};

}  // namespace space
