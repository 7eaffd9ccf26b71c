/// @file
/// What chapter 11 counts of photon maps and of the radiance cache's leaks, as plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch11 {

/// Densities of evenly spread photons from the k nearest, in units of the true one.
struct DensityPoint {
    std::size_t k = 0;
    std::uint64_t estimates = 0;
    double all_of_k = 0.0;  ///< mean of k over the disc
    double less_one = 0.0;  ///< mean of k - 1 over the disc
    double spread = 0.0;    ///< standard deviation of the second
};

/// Irradiance by photons at one place; photons of all kinds.
struct PhotonLeakPoint {
    std::string_view place;
    double exact = 0.0, plain = 0.0, own_surface = 0.0;
};

/// Photons of a scene.
struct PhotonCountPoint {
    std::string scene;
    std::uint64_t emitted = 0, direct = 0, caustic = 0, indirect = 0;
    std::uint64_t aimed = 0, aimed_stored = 0;
    std::uint64_t lost = 0;  ///< emitted, and neither absorbed nor gone nor stopped: must be none
    double bytes = 0.0;      ///< of a photon in its map
};

/// A cache in the scene of a thin wall, by what keeps records from reaching through it.
struct CacheLeakPoint {
    std::string_view way;
    std::uint64_t records = 0, pixels = 0;  ///< of the dark side
    std::uint64_t lit = 0;                  ///< of these, pixels that are not black
    double leak = 0.0;                      ///< mean of the dark side over the mean of the lit one
};

/// Records of a small picture of the interior.
struct CacheCountPoint {
    double accuracy = 0.0;
    std::uint64_t pixels = 0, constant = 0, gradients = 0;
};

/// All of it.
struct DensityMeasurements {
    std::vector<DensityPoint> densities;
    std::vector<PhotonLeakPoint> photon_leaks;
    std::vector<PhotonCountPoint> photons;
    std::vector<CacheLeakPoint> cache_leaks;
    std::vector<CacheCountPoint> records;
};

}  // namespace space::ch11
