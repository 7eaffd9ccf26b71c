/// @file
/// A machine drawn: its packages, their cores, the threads in these, and each thread's APIC id with
/// its fields.
#pragma once

#include "chapters/ch08_parallel_builds/topology.hpp"
#include "common/program/svg.hpp"

namespace space::ch08 {

Svg topology_drawing(const MachineView& view);

}  // namespace space::ch08
