/// @file
/// A landscape of any size that is computed where it is asked for: hills upon hills of noise, all
/// in whole numbers, so that nothing is rounded and the bounds of a patch are simply true.
#pragma once

#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace space {

/// How large a landscape is, and how wild. Lengths are in cells, and powers of two.
struct HeightfieldConfig {
    std::uint32_t cells = 4'096;         ///< along each side
    std::uint32_t patch_cells = 32;      ///< along each side of a patch
    std::uint32_t longest_wave = 1'024;  ///< at least patch_cells
    std::uint32_t shortest_wave = 8;
    std::uint64_t seed = 1;
};

/// Heights over a square of cells, x and z; y is up. Each cell is two triangles. A source for
/// LazyGeometry: its patches are squares of cells.
class Heightfield {
  public:
    using Config = HeightfieldConfig;

    explicit Heightfield(const Config& config = {}) : config_(config) {}

    std::uint32_t patches() const { return row() * row(); }
    std::uint32_t first_triangle(std::uint32_t patch) const { return patch * patch_triangles(); }
    std::uint32_t patch_triangles() const { return 2 * config_.patch_cells * config_.patch_cells; }
    const Config& config() const { return config_; }

    /// A corner of cells; exact.
    Point3 point(std::uint32_t x, std::uint32_t z) const {
        return {float(x), float(height(x, z)) / unit, float(z)};
    }

    // [height]
    /// The sum of all waves at a corner of cells, in parts of a cell: 1 / unit.
    std::int64_t height(std::uint32_t x, std::uint32_t z) const {
        std::int64_t sum = 0;
        for (std::uint32_t wave = config_.longest_wave; wave >= config_.shortest_wave; wave /= 2)
            sum += height_of(wave, x, z);
        return sum;
    }
    // [height]

    // [bounds]
    /// Holds the patch's triangles. Within a patch a long wave goes from corner to corner: its
    /// greatest and its least height are among those of the four corners. A short one is somewhere
    /// between 0 and its greatest.
    Aabb bounds(std::uint32_t patch) const {
        const auto [x, z] = corner(patch);
        const std::uint32_t far_x = x + config_.patch_cells, far_z = z + config_.patch_cells;
        std::int64_t low = 0, high = 0;
        for (std::uint32_t wave = config_.longest_wave; wave >= config_.shortest_wave; wave /= 2) {
            if (wave < config_.patch_cells) {
                high += greatest(wave);
                continue;
            }
            const std::array corners{height_of(wave, x, z), height_of(wave, far_x, z),
                                     height_of(wave, x, far_z), height_of(wave, far_x, far_z)};
            low += std::ranges::min(corners);
            high += std::ranges::max(corners);
        }
        return {{float(x), float(low) / unit, float(z)},
                {float(far_x), float(high) / unit, float(far_z)}};
    }
    // [bounds]

    /// Row by row, two a cell, their front sides up.
    std::vector<Triangle> triangles(std::uint32_t patch) const {
        const auto [x, z] = corner(patch);
        const std::uint32_t n = config_.patch_cells;
        std::vector<Point3> points;
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i) points.push_back(point(x + i, z + j));
        std::vector<Triangle> triangles;
        triangles.reserve(patch_triangles());
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const Point3* const near = &points[j * (n + 1) + i];
                const Point3* const far = near + n + 1;
                triangles.push_back({near[0], far[0], near[1]});
                triangles.push_back({far[0], far[1], near[1]});
            }
        return triangles;
    }

    /// Parts of a cell in which heights are counted: a power of two, so that they fit into floats.
    static constexpr float unit = 64.0f;

  private:
    std::uint32_t row() const { return config_.cells / config_.patch_cells; }
    std::array<std::uint32_t, 2> corner(std::uint32_t patch) const {
        return {patch % row() * config_.patch_cells, patch / row() * config_.patch_cells};
    }

    /// A quarter of the wave's length.
    static std::int64_t greatest(std::uint32_t wave) {
        return std::int64_t{wave} / 4 * std::int64_t(unit);
    }
    /// A random height where the waves begin, from 0 to the greatest.
    std::int64_t height_at_node(std::uint32_t wave, std::uint32_t i, std::uint32_t j) const {
        Pcg32 random(config_.seed + (std::uint64_t{j} << 16 | i), wave);
        return random.below(std::uint32_t(greatest(wave)) + 1);
    }

    // [height_of]
    /// Between the four nodes around a place: a mean with weights, rounded down. The weights are
    /// whole numbers from 0 to the wave's length, which they reach smoothly: 3 s^2 - 2 s^3.
    std::int64_t height_of(std::uint32_t wave, std::uint32_t x, std::uint32_t z) const {
        const std::int64_t p = wave;
        const auto weight = [p](std::int64_t a) { return a * a * (3 * p - 2 * a) / (p * p); };
        const std::int64_t right = weight(x % wave), down = weight(z % wave);
        const std::uint32_t i = x / wave, j = z / wave;
        const std::int64_t near =
            height_at_node(wave, i, j) * (p - right) + height_at_node(wave, i + 1, j) * right;
        const std::int64_t far = height_at_node(wave, i, j + 1) * (p - right) +
                                 height_at_node(wave, i + 1, j + 1) * right;
        return (near * (p - down) + far * down) / (p * p);
    }
    // [height_of]

    Config config_;
};

}  // namespace space
