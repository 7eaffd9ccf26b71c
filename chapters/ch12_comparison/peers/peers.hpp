/// @file
/// Other people's structures, as the lab sees them. They stand in a program of their own: CGAL's
/// AABB tree is under the GPL, and neither is needed to read the book.
///
/// Peers answer in their own way, with a test of their own: --check counts what they get wrong, and
/// their counts of nodes and tests are unknown.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"

namespace space::ch12 {

/// Intel's Embree by its plain interface, one ray at a time, as any program would use it:
/// embree, embree-high (build quality high: spatial splits), embree-robust (the flag that promises
/// watertight edges). tmin below 0 is outside of its contract, and taken for 0.
Home embree();

/// CGAL's AABB_tree over doubles, with first_intersection and do_intersect. A ray has no interval
/// there: it is made to start at tmin, and a nearest hit behind tmax is a miss; any hit is asked
/// of a segment. Where a ray runs in a triangle's plane CGAL reports a hit, and the book none.
Home cgal();

}  // namespace space::ch12
