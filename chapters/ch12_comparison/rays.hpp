/// @file
/// The rays that the lab traces, and the files that rays and hits travel in.
#pragma once

#include "common/accelerator.hpp"
#include "common/camera.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// One record of a hits file: float32 t, u, v and a uint32 triangle, little-endian.
struct HitRecord {
    float t, u, v;
    std::uint32_t triangle;

    static constexpr std::uint32_t no_triangle = 0xFFFFFFFF;  ///< a miss, whose t is infinity
    static constexpr std::uint32_t some_triangle =
        0xFFFFFFFE;  ///< a hit that is not told: the query was `any`

    static HitRecord closest(const std::optional<Hit>& hit) {
        return hit ? HitRecord{hit->t, hit->u, hit->v, hit->triangle}
                   : HitRecord{infinity, 0.0f, 0.0f, no_triangle};
    }
    static HitRecord any(bool hit) {
        return hit ? HitRecord{0.0f, 0.0f, 0.0f, some_triangle} : closest({});
    }

    bool is_hit() const { return triangle != no_triangle; }
    /// The same bits: NaN is NaN.
    bool operator==(const HitRecord& other) const {
        using Words = std::array<std::uint32_t, 4>;
        return std::bit_cast<Words>(*this) == std::bit_cast<Words>(other);
    }
};

/// More rays than this (3 GB with their hits) are refused.
inline constexpr std::size_t max_rays = std::size_t{1} << 26;

/// Reads records of eight little-endian float32: ox oy oz tmin dx dy dz tmax. The numbers are taken
/// as they are: a ray that is not valid (NaN, zero direction, tmin > tmax) hits nothing.
/// @throws Error (bad_input) for a file that is missing, empty, too large or not made of whole
/// records
std::vector<Ray> read_rays(const std::filesystem::path& file);

/// The bytes of a hits file.
std::string hits_bytes(std::span<const HitRecord> hits);

/// `count` rays that leave the surface where the given rays hit it, spread evenly over the hits in
/// their order, each cosine-distributed about the normal on the side that its ray came from. None
/// where there is no hit.
std::vector<Ray> diffuse_rays(std::span<const Triangle> triangles, std::span<const Ray> rays,
                              std::span<const HitRecord> hits, std::size_t count,
                              std::uint64_t seed);

}  // namespace space
