/// @file
/// Inputs that long climbs bred for large errors of the filter for sides, and how near to their
/// bounds these errors come.
#pragma once

#include "common/geometry.hpp"

#include <array>

namespace space::ch03 {

/// A plane's three points and a point: the height over the plane.
inline constexpr std::array<float, 12> worst_height{
    0x1.d33842p-3f,  0x1.77fc6ap-5f,  -0x1.ff48dp+3f, 0x1.21afeap-6f,
    -0x1.1b4facp-6f, 0x1.78c088p-3f,  0x1.d33842p-3f, 0x1.fc6d28p+5f,
    -0x1.ff48d2p+3f, -0x1.ff48f8p+5f, 0x1.29b9ecp-4f, -0x1.ff40d2p+3f};
/// A plane's three points and a vector: the slope along the plane's normal.
inline constexpr std::array<float, 12> worst_slope{
    0x1.e6ddd8p-2f,  -0x1.ece846p-2f, 0x1.407dd4p+3f,  0x1.dc22eep+4f,
    -0x1.d84ee8p-2f, 0x1.407fd2p+3f,  -0x1.1d987p-3f,  -0x1.d84ee8p-2f,
    -0x1.f9208p+5f,  -0x1.783c1cp-4f, -0x1.f92082p+5f, -0x1.b0645cp-6f};

/// The larger of their two errors, as a part of its bound.
double worst_known_share();

}  // namespace space::ch03
