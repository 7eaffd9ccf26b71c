/// @file
/// A machine's topology by others, to hold ours against: the kernel's files, and the library hwloc,
/// which also knows architectures without cpuid.
#pragma once

#include "chapters/ch08_parallel_builds/topology.hpp"

#include <filesystem>

namespace space {

/// What the kernel says below /sys/devices/system/cpu, of processors that are switched on. Empty
/// where there are no such files: other systems, some containers.
MachineView view_by_kernel(const std::filesystem::path& folder = "/sys/devices/system/cpu");

/// What hwloc says of the processors that are switched on and open to this process. Empty where
/// hwloc fails, or was not there when this was compiled.
MachineView view_by_hwloc();

}  // namespace space
