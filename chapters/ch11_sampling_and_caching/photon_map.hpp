/// @file
/// The photon map (Jensen 2001, "Realistic Image Synthesis Using Photon Mapping", chapters 6 and
/// 7): photons in chapter 4's k-d tree of points, and the light that they say arrives at a surface.
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch04_kd_trees/kd_points.hpp"
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "chapters/ch11_sampling_and_caching/photon.hpp"
#include "common/geometry.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace space {

/// Photons, and the tree that finds those near a point.
struct PhotonMap {
    KdPoints<3> tree = {};
    std::vector<Photon> photons = {};  ///< in the order of the tree's buckets: near ones together

    /// Of any number of photons, none too. @throws std::invalid_argument, LimitError as KdPoints
    static PhotonMap build(std::span<const Photon> photons) {
        std::vector<Point3> positions;
        positions.reserve(photons.size());
        for (const Photon& photon : photons) positions.push_back(photon.position);
        PhotonMap map{.tree = KdPoints<3>::build(positions)};
        map.photons.reserve(photons.size());
        for (std::uint32_t slot = 0; slot < photons.size(); ++slot) {
            auto& bucket = map.tree.buckets[slot / KdPoints<3>::bucket_size];
            map.photons.push_back(photons[map.tree.index(slot)]);
            bucket.index[slot % KdPoints<3>::bucket_size] = slot;
        }
        return map;
    }
    /// Of those that came by one kind of path.
    static PhotonMap build(std::span<const Photon> photons, PhotonPath path) {
        std::vector<Photon> chosen;
        std::ranges::copy_if(photons, std::back_inserter(chosen),
                             [path](const Photon& photon) { return photon.path == path; });
        return build(chosen);
    }
    std::size_t bytes() const {
        return photons.capacity() * sizeof(Photon) +
               tree.buckets.capacity() * sizeof(KdPoints<3>::Bucket) +
               tree.nodes.capacity() * sizeof(KdPoints<3>::Node);
    }

    // [smallest_radius]
    /// Below this radius a disc is too small for floats. Rounding moves a photon, and the point
    /// that asks, by up to sqrt(3) u24 m each, where u24 = 2^-24 and m is the largest coordinate:
    /// distances are wrong by up to d = 2 sqrt(3) u24 m. A disc of radius r holds the photons of
    /// one whose radius is between r - d and r + d, so with r = 32 d its area, and the estimate,
    /// are wrong by a factor between (1 - 1/32)^2 and (1 + 1/32)^2: 6 percent. Never 0, also where
    /// all photons are at the origin.
    float smallest_radius() const {
        const Point3 largest = glm::max(glm::abs(tree.bounds.min), glm::abs(tree.bounds.max));
        const double m = tree.size == 0 ? 0.0 : std::max({largest.x, largest.y, largest.z});
        return std::max(static_cast<float>(64.0 * std::numbers::sqrt3 * float_roundoff * m),
                        std::numeric_limits<float>::min());
    }
    // [smallest_radius]
};

/// How many photons an estimate takes, and from how far.
struct DensityConfig {
    std::size_t k = 50;               ///< at least 2; fewer: more noise, more: light is blurred
    float largest_radius = infinity;  ///< of the disc, in the scene's units
    bool only_own_surface = true;     ///< leave out photons of walls beside and behind
};

// [plain_density]
/// The irradiance as it is usually written: the power of the k nearest photons within a radius,
/// over the disc that reaches to the farthest found. Wrong where fewer than k are found, infinite
/// where k are at the point itself, and k / (k - 1) times too bright in the mean.
inline Double3 plain_density(const PhotonMap& map, const Point3& point, std::size_t k,
                             float radius) {
    Double3 power{0.0};
    double square = 0.0;
    for (const Neighbour& near : k_nearest<3>(map.tree, point, k)) {
        if (near.squared_distance > double{radius} * double{radius}) break;
        power += map.photons[near.index].power;
        square = near.squared_distance;
    }
    return power / (std::numbers::pi * square);
}
// [plain_density]

/// A disc, and the photons in it, the nearest first.
struct PhotonDisc {
    std::span<const Neighbour> photons;
    double squared_radius;
};

/// Estimates irradiance from a map, point after point. It holds the memory that this takes, so one
/// of these serves one thread.
///
/// Without bias where light is even: take one photon i and call d the distance of the (k - 1)-th
/// nearest of the *others*, cut to between the smallest and the largest radius. Each case of
/// disc_around counts i just when it is nearer than d, and then by the disc of radius d (with i
/// in it, the k-th of all is the (k - 1)-th of the others). Photons are independent (those of one
/// path nearly so): d does not depend on where i is. If i falls with the constant density f around
/// the point, it counts with the chance f pi d^2, and for 1 / (pi d^2) of its power: f times its
/// power in the mean, whatever the others do, on this surface or another one. With k photons in
/// place of k - 1 the mean is k / (k - 1) times too high.
///
/// Uneven light is blurred over the disc, and a disc that reaches beyond the edge of its surface
/// makes that edge darker: a bias that falls with the disc.
class DensityEstimator {
  public:
    /// The map must outlive this. @throws std::invalid_argument for k < 2 or a radius below 0
    explicit DensityEstimator(const PhotonMap& map, const DensityConfig& config = {})
        : map_(map),
          config_(config),
          smallest_(map.smallest_radius()),
          largest_(std::max(config.largest_radius, smallest_)),
          nearest_(map.tree, config.k) {
        if (config.k < 2 || !(config.largest_radius >= 0.0f))
            throw std::invalid_argument("a density needs 2 photons or more, and a radius");
    }

    // [density]
    /// Of k photons the farthest says only how large the disc is; k - 1 lie in it. Where the k-th
    /// is beyond the largest radius, or there is none, the largest disc with all that it holds;
    /// where it is nearer than floats can tell, the smallest. Valid until the next call.
    PhotonDisc disc_around(const Point3& point) {
        const std::span<const Neighbour> nearest = nearest_(point);
        const bool has_k = nearest.size() == config_.k;
        if (has_k && nearest.back().squared_distance < square(smallest_)) {
            within_radius<3>(map_.tree, point, smallest_, in_smallest_);
            return {in_smallest_, square(smallest_)};
        }
        if (has_k && nearest.back().squared_distance <= square(largest_))
            return {nearest.first(nearest.size() - 1), nearest.back().squared_distance};
        const auto end =
            std::ranges::upper_bound(nearest, square(largest_), {}, &Neighbour::squared_distance);
        return {{nearest.begin(), end}, square(largest_)};
    }

    /// Power per area that arrives at a point of a surface, on the side of the normal (of length
    /// 1), RGB; 0 where no photon is found.
    Double3 irradiance(const Double3& position, const Double3& normal) {
        const PhotonDisc disc = disc_around(Point3(position));
        Double3 power{0.0};
        for (const Neighbour& near : disc.photons) {
            const Photon& photon = map_.photons[near.index];
            if (!config_.only_own_surface ||
                is_on_surface(photon, position, normal, disc.squared_radius))
                power += photon.power;
        }
        return power / (std::numbers::pi * disc.squared_radius);
    }
    // [density]

    // [own_surface]
    /// Whether a photon of the disc arrived at the surface of `position`, and not at a wall beside
    /// it, at its other side, or at one that runs parallel: turned by less than 45 degrees, and off
    /// the plane by at most a quarter of the disc's radius, as is all of a sphere of twice that
    /// radius. (Rounding moves it by a thirty-second of the smallest radius.)
    static bool is_on_surface(const Photon& photon, const Double3& position, const Double3& normal,
                              double squared_radius) {
        const double off_plane = glm::dot(Double3(photon.position) - position, normal);
        return glm::dot(Double3(photon.normal), normal) > std::numbers::sqrt2 / 2.0 &&
               16.0 * off_plane * off_plane <= squared_radius;
    }
    // [own_surface]

  private:
    static double square(float radius) { return double{radius} * double{radius}; }

    const PhotonMap& map_;
    DensityConfig config_;
    float smallest_, largest_;
    NearestSearch<3> nearest_;
    std::vector<Neighbour> in_smallest_;
};

}  // namespace space
