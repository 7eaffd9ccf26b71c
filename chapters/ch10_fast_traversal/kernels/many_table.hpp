/// @file
/// The kernels for several rays by instruction set; and rays as they take them.
#pragma once

#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "common/geometry.hpp"

#include <cstddef>

namespace space {

/// None for InstructionSet::scalar.
const ManyKernels* many_kernels(InstructionSet set);

/// By FilteredExact, for one ray of the packet.
void exact_packet_lane(PacketRays& rays, unsigned ray, const float* block, unsigned lane);

}  // namespace space
