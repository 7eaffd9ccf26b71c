/// @file
/// Exercise 3.2, a near miss: a corner on the plane counts as in front, so that the edge from it
/// to the back is cut too, at that very corner: the front piece gets it twice.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>
#include <vector>

namespace space {

struct Pieces {
    std::vector<Point3> front, back;
};

inline Pieces split(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    Pieces pieces;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Double3 p(polygon[i]), q(polygon[(i + 1) % polygon.size()]);
        const double at_p = plane.distance(p), at_q = plane.distance(q);
        (at_p >= 0.0 ? pieces.front : pieces.back).push_back(polygon[i]);
        if ((at_p >= 0.0) != (at_q >= 0.0)) {
            const Point3 cut(p + at_p / (at_p - at_q) * (q - p));
            pieces.front.push_back(cut);
            pieces.back.push_back(cut);
        }
    }
    return pieces;
}

}  // namespace space
