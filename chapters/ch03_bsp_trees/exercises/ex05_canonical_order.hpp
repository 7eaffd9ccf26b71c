/// @file
/// Exercise 3.5: Canonical order closes the crack
/// Difficulty 2 of 3, about 20 minutes.
///
/// Two neighbours share the edge from *p* to *q*, and each walks around itself: one sees *p* ->
/// *q*, the other *q* -> *p*. Both are cut by the plane *normal* · *x* = *offset*, and each
/// computes the cut for itself. The stub gives them points that differ in the last bits, and light
/// shines through the crack. Mend it: `cut(p, q, ...)` and `cut(q, p, ...)` must be the same point,
/// bit for bit, for every edge whose ends lie on different sides. It must still be the cut. The
/// checks count the cracks of 100,000 edges, and the points that are farther from the plane or from
/// the edge than roundings of floats explain. To compute in double makes cracks rare and does not
/// close them, nor does it to snap the point to a grid: the checks know where.
#pragma once

#include "common/geometry.hpp"

namespace space {

inline Point3 cut(const Point3& p, const Point3& q, const Vector3& normal, float offset) {
    // TODO: p + s (q - p) rounds differently from q + (1 - s) (p - q)
    const float at_p = glm::dot(normal, p) - offset, at_q = glm::dot(normal, q) - offset;
    return p + at_p / (at_p - at_q) * (q - p);
}

}  // namespace space
