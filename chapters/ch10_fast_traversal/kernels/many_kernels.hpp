/// @file
/// The kernels for several rays and for compressed nodes, as one table: included by a file for each
/// instruction set.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/compressed_kernel.hpp"
#include "chapters/ch10_fast_traversal/kernels/interleaved_kernel.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_kernel.hpp"
#include "chapters/ch10_fast_traversal/kernels/probe_kernel.hpp"

namespace space::SPACE_ISA {

extern const ManyKernels many_kernels;
const ManyKernels many_kernels{trace_packet,
                               walk_interleaved,
                               {closest_compressed, any_compressed},
                               probe_nodes,
                               probe_blocks};

}  // namespace space::SPACE_ISA
