/// @file
/// What the tests of this chapter are measured on: rays with triangles, boxes and spheres, aimed
/// where tests fail. The same inputs for all tests; all from PCG32, so that everybody measures the
/// same.
#pragma once

#include "common/mesh.hpp"
#include "common/random.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace space::ch02 {

// --- triangles ---

/// Where a ray is aimed at its triangle.
enum class Aim {
    around,   ///< at a point of the triangle's plane, one time in eight inside
    edge,     ///< at a point of an edge
    vertex,   ///< at a vertex
    grazing,  ///< at a point inside, at an angle of less than a tenth of a degree to the plane
    near,     ///< at a point inside, from a thousandth of the triangle's size away
    distant,  ///< at a point inside, from ten thousand times its size away
    uneven,   ///< at a point of an edge; each corner's size is drawn from 10^-8 to 10^8
};

/// How rays with a triangle each are made: coordinates of size 1 from `aim`, then scaled by
/// 10^scale, then moved by 10^shift (1, 1/2, -1/4) (no shift where it is 0), rounded to floats
/// last.
struct TriangleInput {
    std::string name;
    Aim aim = Aim::around;
    int scale = 0, shift = 0;
};
/// The classes of the chapter's tables.
const std::vector<TriangleInput>& triangle_inputs();

/// An input of the triangle tests.
struct RayAndTriangle {
    Ray ray;
    Triangle triangle;
};
RayAndTriangle make_pair(const TriangleInput& input, Pcg32& random);

/// A closed mesh around the origin, of about radius 1 and with bumps: an octahedron whose faces are
/// cut `levels` times into four. Star-shaped: any ray from the middle leaves it.
TriangleMesh bumpy_ball(int levels);

// --- boxes ---

/// An input of the box tests.
struct RayAndBox {
    Ray ray;
    Aabb box;
};
/// The 7000 rays with origin in {-1, 0, 1, 2, 3}^3 and direction in {-1, -0, +0, 1}^3 without zero,
/// and the box [0, 2]^3.
std::vector<RayAndBox> lattice_boxes();
/// A ray at a corner, an edge, a face's point or the inside of a box, one box in four flat, one ray
/// in four parallel to a face.
RayAndBox make_box_pair(Pcg32& random);

}  // namespace space::ch02
