/// @file
/// What the drawings of chapter 1 have in common: three dimensions on paper, and numbers in labels.
#pragma once

#include "common/geometry.hpp"

#include <string>
#include <vector>

namespace space::ch01 {

/// How a drawing shows three dimensions: without perspective, from the side `yaw` and from above
/// `pitch`, angles given by a Pythagorean triple, so that no cosine differs between libraries.
struct ParallelView {
    glm::dvec2 origin;  ///< where (0, 0, 0) is drawn
    double scale;       ///< drawing units per unit
    double yaw_cos, yaw_sin, pitch_cos, pitch_sin;

    Point2 operator()(const Double3& p) const {
        const double across = yaw_cos * p.x - yaw_sin * p.z, along = yaw_sin * p.x + yaw_cos * p.z;
        return Point2(origin + scale * glm::dvec2(across, pitch_sin * along - pitch_cos * p.y));
    }
    /// Whether the drawing shows the side that the normal points to.
    bool faces(const Double3& n) const {
        return pitch_cos * (yaw_sin * n.x + yaw_cos * n.z) + pitch_sin * n.y > 0.0;
    }
    std::vector<Point2> outline(const std::vector<Double3>& points) const {
        std::vector<Point2> drawn;
        for (const Double3& p : points) drawn.push_back((*this)(p));
        return drawn;
    }
};

/// A number in a label: a true minus sign, no negative zero.
std::string shown(double value, int decimals);

}  // namespace space::ch01
