/// @file
/// Charts over what chapter 10 measures.
#pragma once

#include "chapters/ch10_fast_traversal/measured/data.hpp"
#include "common/program/chart.hpp"

#include <vector>

namespace space::ch10 {

/// Diffuse rays per second after each rung; a level line for the bound.
Chart ladder_chart(const std::vector<RungPoint>& ladder);
/// Wrong answers after each rung, and of Embree's modes.
Chart ladder_exactness_chart(const std::vector<RungPoint>& ladder);
/// A load that waits, and one of many at once, against the working set.
Chart latency_chart(const std::vector<MemoryPoint>& memory);
/// Time of a diffuse ray against triangles, by structure.
Chart size_chart(const std::vector<SizePoint>& sizes);
/// Speed against accuracy, by tracer; a dot for each scene.
Chart aimed_chart(const std::vector<AimedPoint>& aimed);
/// Rays per second beside single rays, by mode and scene.
Chart modes_chart(const std::vector<ModePoint>& modes, RayKind kind);
/// Rays per second beside Embree's default, by scene.
Chart fast_peers_chart(const std::vector<PeerPoint>& peers, RayKind kind);

}  // namespace space::ch10
