/// @file
/// The rays that the lab traces, and the files that rays and hits travel in.
#pragma once

#include "common/accelerator.hpp"
#include "common/camera.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// The answer to a ray. Triangles of instances are counted in 64 bits.
struct HitRecord {
    float t, u, v;
    std::uint64_t triangle;

    static constexpr std::uint64_t no_triangle = ~std::uint64_t{0};  ///< a miss; t is infinity
    static constexpr std::uint64_t some_triangle =
        no_triangle - 1;  ///< a hit that is not told: the query was `any`

    /// Of a Hit, or of another hit with t, u, v and triangle.
    template <class AnyHit = Hit>
    static HitRecord closest(const std::optional<AnyHit>& hit) {
        return hit ? HitRecord{hit->t, hit->u, hit->v, hit->triangle}
                   : HitRecord{infinity, 0.0f, 0.0f, no_triangle};
    }
    static HitRecord any(bool hit) {
        return hit ? HitRecord{0.0f, 0.0f, 0.0f, some_triangle} : closest({});
    }

    bool is_hit() const { return triangle != no_triangle; }
    /// The same bits: NaN is NaN.
    bool operator==(const HitRecord& other) const {
        using Words = std::array<std::uint32_t, 3>;
        return std::bit_cast<Words>(std::array{t, u, v}) ==
                   std::bit_cast<Words>(std::array{other.t, other.u, other.v}) &&
               triangle == other.triangle;
    }
};

/// More rays than this (4 GB with their hits) are refused.
inline constexpr std::size_t max_rays = std::size_t{1} << 26;

/// Reads records of eight little-endian float32: ox oy oz tmin dx dy dz tmax. The numbers are taken
/// as they are: a ray that is not valid (NaN, zero direction, tmin > tmax) hits nothing.
/// @throws Error (bad_input) for a file that is missing, empty, too large or not made of whole
/// records
std::vector<Ray> read_rays(const std::filesystem::path& file);

/// The bytes of a hits file: for each hit float32 t, u, v and the triangle as a Number, a uint32
/// for a mesh, a uint64 for instances; little-endian.
template <class Number>
std::string hits_bytes(std::span<const HitRecord> hits);

/// `count` rays that leave the surface where the given rays hit it, spread evenly over the hits in
/// their order, each cosine-distributed about the normal on the side that its ray came from. None
/// where there is no hit.
std::vector<Ray> diffuse_rays(const std::function<Triangle(std::uint64_t)>& triangle_at,
                              std::span<const Ray> rays, std::span<const HitRecord> hits,
                              std::size_t count, std::uint64_t seed);

}  // namespace space
