/// @file
/// The solids that the scenes are put together from. Computed in double and rounded once, so that
/// they have the same bytes with every compiler; counter-clockwise seen from outside; no vertex
/// twice in one solid.
#pragma once

#include "common/scene.hpp"

#include <glm/mat3x3.hpp>

#include <span>

namespace space {

/// The sphere of radius 1, as an icosahedron with each edge cut into `frequency` pieces and pushed
/// outwards: 20 f^2 triangles, 10 f^2 + 2 vertices, closed.
TriangleMesh icosphere(std::uint32_t frequency);
/// The same, of any radius and place.
TriangleMesh ball(const Double3& centre, double radius, std::uint32_t frequency);

/// 12 triangles, closed.
TriangleMesh box(const Double3& min, const Double3& max);
/// u x v points to the front; 2 triangles.
TriangleMesh parallelogram(const Double3& corner, const Double3& u, const Double3& v);

/// A profile (distance from the axis, height) turned about the y axis in `segments` steps, from
/// below outwards to above; closed where the profile begins and ends on the axis, where it makes
/// one vertex.
TriangleMesh lathe(std::span<const glm::dvec2> profile, std::uint32_t segments);

/// Rings of `sides` vertices about the points of a path; ends with caps if `capped`. At least two
/// points.
struct TubePoint {
    Double3 centre;
    double radius;
};
TriangleMesh tube(std::span<const TubePoint> path, std::uint32_t sides, bool capped = true);
/// The tube from a to b: a cylinder, or a cone cut off.
TriangleMesh tube(const TubePoint& a, const TubePoint& b, std::uint32_t sides, bool capped = true);

/// A teapot of our own: body and lid turned, handle and spout bent tubes; about 0.3 wide, standing
/// on y = 0. With the detail n: 84 n^2 + 52 n triangles.
TriangleMesh teapot(std::uint32_t detail);

/// Smooth curve through the points (Catmull & Rom 1974), `steps` pieces between neighbours.
std::vector<glm::dvec2> smooth_curve(std::span<const glm::dvec2> points, std::uint32_t steps);

TriangleMesh moved(TriangleMesh mesh, const Double3& by);
/// matrix * v + by.
TriangleMesh transformed(TriangleMesh mesh, const glm::dmat3& matrix,
                         const Double3& by = Double3{0.0});
/// Rotation by an angle in degrees about an axis of length 1 (Rodrigues' formula).
glm::dmat3 rotation(const Double3& axis, double degrees);
/// The other side becomes the front: a box seen from inside is a room.
TriangleMesh turned_inside_out(TriangleMesh mesh);

/// Adds the mesh to the scene, all its triangles of one colour.
void add(Scene& scene, const TriangleMesh& mesh, const Color& color);

/// A light at `position` that makes a white surface at `lit`, facing it, as bright as `brightness`.
void add_light(Scene& scene, const Double3& position, const Double3& lit, const Color& brightness);

/// A light at the camera's eye, for its target: it throws no shadow that is seen, and leaves no
/// other one black.
void add_eye_light(Scene& scene, const Color& brightness);

/// The linear colour of an sRGB triple such as 0xC8553D.
Color srgb(std::uint32_t rgb);

}  // namespace space
