/// @file
/// The palette's colours as pixels of a picture.
#pragma once

#include "common/program/svg.hpp"

#include <cmath>
#include <string>

namespace space::ch02 {

/// Linear.
inline Vector3 pixel(Ink ink) {
    Vector3 linear;
    const std::string hex(svg_color(ink).substr(1));
    for (int channel = 0; channel < 3; ++channel) {
        const double encoded =
            std::stoi(hex.substr(2 * static_cast<std::size_t>(channel), 2), nullptr, 16) / 255.0;
        linear[channel] = static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return linear;
}

}  // namespace space::ch02
