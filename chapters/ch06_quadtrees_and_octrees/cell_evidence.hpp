/// @file
/// What a cell of an adaptively sampled picture is judged by: the samples in it.
#pragma once

#include "common/geometry.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace space {

/// What a pixel's ray sees. `surface` is a number of the caller's: surfaces of two numbers have an
/// edge between them, whatever their colours. A triangle's number will do, or an object's.
struct PictureSample {
    Color color{0.0f};
    std::uint32_t surface = 0;

    static constexpr std::uint32_t background = 0xFFFFFFFFu;
    bool operator==(const PictureSample&) const = default;
};

/// What the caller chooses about a picture that is sampled adaptively.
struct AdaptiveConfig {
    /// By which samples a cell is judged: its corners, which is cheap and misses more; or all that
    /// have been taken in it and on its border, whoever has asked for them, so that an edge which
    /// one cell has found is followed through its neighbours.
    enum class Evidence { corners, all_samples };

    int threshold = 8;  ///< samples of an even cell differ by at most so many of the screen's 255
                        ///< steps in each channel
    bool compare_surfaces = true;  ///< and show one surface
    Evidence evidence = Evidence::all_samples;
    int first_cell = 16;   ///< edge in pixels of the cells that it begins with, a power of two
    unsigned threads = 1;  ///< the picture has the same bytes for any number
};

/// What the samples that a cell is judged by have in common.
struct SampleRange {
    std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};  ///< as the screen shows them
    std::optional<std::uint32_t> surface = {};
    bool one_surface = true, all_finite = true;

    void add(const PictureSample& sample, const std::array<std::uint8_t, 3>& shown) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            low[channel] = std::min(low[channel], int{shown[channel]});
            high[channel] = std::max(high[channel], int{shown[channel]});
        }
        all_finite = all_finite && is_finite<3>(sample.color);
        one_surface = one_surface && (!surface || *surface == sample.surface);
        surface = sample.surface;
    }
    // [is_even]
    /// A colour that is not finite differs from every other, and from itself.
    bool is_even(const AdaptiveConfig& config) const {
        if (!all_finite || (config.compare_surfaces && !one_surface)) return false;
        for (std::size_t channel = 0; channel < 3; ++channel)
            if (high[channel] - low[channel] > config.threshold) return false;
        return true;
    }
    // [is_even]
};

}  // namespace space
