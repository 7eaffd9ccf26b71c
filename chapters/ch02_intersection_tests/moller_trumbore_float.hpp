/// @file
/// Chapter 1's test of Möller & Trumbore in the precision that it is usually written in: what the
/// others are timed against.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"

namespace space {

/// Its determinant is compared with zero only: an absolute epsilon misses small triangles, see
/// LichterFirst.
using MollerTrumboreFloat = BasicMollerTrumbore<float>;

}  // namespace space
