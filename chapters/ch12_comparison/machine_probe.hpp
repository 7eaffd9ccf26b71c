/// @file
/// How fast is this machine? A tenth of a second of work that is always the same.
#pragma once

#include "chapters/ch12_comparison/advice.hpp"

namespace space {

/// Times of chapter 10's tree over a scene of the book, and of refitting a tree to its triangles.
struct MachineProbe {
    ProbeTimes times;
    double refit_ns_per_triangle;
};

/// The best of some turns: what disturbs a machine only ever takes time.
MachineProbe probe_machine(unsigned threads);

}  // namespace space
