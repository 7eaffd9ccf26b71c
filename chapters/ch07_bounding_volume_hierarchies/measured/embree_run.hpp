/// @file
/// Embree, measured beside the chapter's trees. Without the package libembree-dev there is nothing
/// beside them.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"

#include <array>
#include <functional>
#include <vector>

namespace space::ch07 {

/// A peer's tree, counted as far as it tells, and what builds and traces it again.
struct PeerRun {
    TreePoint point;
    std::function<void()> build;
    std::array<std::function<void()>, ray_kinds.size()> traces;
};
std::vector<PeerRun> embree_runs(const RayTask& task);

}  // namespace space::ch07
