/// @file
/// What a photon map stores (Jensen 2001, "Realistic Image Synthesis Using Photon Mapping", chapter
/// 4): a packet of light that arrived at a diffuse surface. Where it came from is not kept: a
/// Lambert surface reflects the same, whatever the direction.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>

namespace space {

/// What a photon met on its way from the light. In the letters of Heckbert 1990 ("Adaptive
/// Radiosity Textures for Bidirectional Ray Tracing", L: light, S: mirror, D: diffuse) the paths
/// are LD, LS+D, and all with a diffuse surface between.
enum class PhotonPath : std::uint8_t { direct, caustic, indirect };

/// Floats are enough for where: an estimate adds up a hundred, each random. Power grows with the
/// square of a scene's size, beyond floats for one of 10^20 units.
struct Photon {
    Point3 position{0.0f};
    Vector3 normal{0.0f};  ///< of the side that it arrived at, of length 1
    Double3 power{0.0};    ///< watts, RGB
    PhotonPath path = PhotonPath::direct;

    bool operator==(const Photon&) const = default;
};

}  // namespace space
