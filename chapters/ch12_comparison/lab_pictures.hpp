/// @file
/// Two pictures of a structure at work: what each pixel's ray costs, and what it sees.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"
#include "common/program/image.hpp"
#include "common/scene.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// What --heatmap shows of each pixel's ray.
enum class HeatOf { nodes, tests };
constexpr std::string_view heat_name(HeatOf of) {
    return of == HeatOf::nodes ? "nodes visited" : "triangle tests";
}

/// What the structure does for each ray of the batch, and its answers in batch.hits.
std::vector<TraversalCounts> counts_by_ray(const BuiltStructure& built, const Batch& batch);

/// One number of each.
std::vector<std::uint64_t> heat_values(std::span<const TraversalCounts> counts, HeatOf of);

/// What the colours of a heat map stand for: from 0 to `end` and beyond, with a number beside every
/// `step`.
struct HeatScale {
    std::uint64_t end, step;
    bool operator==(const HeatScale&) const = default;
};
/// In two to six steps (one to 1) of 1, 2 or 5 times a power of ten.
HeatScale heat_scale_to(std::uint64_t end);
/// One that ends at the first step beyond 99 of 100 values: a few pixels that cost much more leave
/// the others their colours.
HeatScale heat_scale_of(std::span<const std::uint64_t> values);

/// The values as a picture of width x height pixels, enlarged where it would be small, above the
/// scale with its numbers and a line about all values; `title` stands above that.
Image heat_map(std::span<const std::uint64_t> values, int width, int height, const HeatScale& scale,
               const std::string& title, HeatOf of);

/// Where the surfaces are that are seen, and their colours.
struct Surfaces {
    std::function<Triangle(std::uint64_t)> triangle;
    std::function<Color(std::uint64_t)> color;
};

/// The scene through the structure, by chapter 1's shading: Lambert's law, and a shadow ray to each
/// of the scene's lights. What it costs in time is not told, since each ray is a batch of its own.
Image shaded_picture(const BuiltStructure& built, const PixelGrid& pixels, const Scene& scene,
                     const Surfaces& surfaces, unsigned threads);

}  // namespace space
