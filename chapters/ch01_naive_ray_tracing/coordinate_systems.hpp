/// @file
/// The three coordinate systems of a picture and the maps that tie them (Heinonen16, section 2.1).
/// An object is modelled in its own *local* coordinates, placed in the scene's *world* coordinates,
/// and seen in the *camera*'s, whose origin is the eye. All maps are computed in double.
#pragma once

#include "common/camera.hpp"
#include "common/mesh.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <utility>

namespace space {

/// A linear map of homogeneous column vectors: the right factor of a product is applied first.
using Map = glm::dmat4;

/// A point has w = 1: it is translated.
inline Double3 map_point(const Map& map, const Double3& point) {
    return Double3(map * glm::dvec4(point, 1.0));
}
/// A direction has w = 0: it is not.
inline Double3 map_vector(const Map& map, const Double3& vector) {
    return Double3(map * glm::dvec4(vector, 0.0));
}

/// Where an object stands in the world.
struct Placement {
    Double3 translation{0.0};
    Double3 axis{0.0, 1.0, 0.0};  ///< of the rotation; any length but zero
    double angle = 0.0;           ///< in radians, counter-clockwise seen from the axis' tip
    Double3 scale{1.0};
};

// [local_to_world]
/// M = T R S: scaled first, then turned, then moved.
inline Map local_to_world(const Placement& placement) {
    const Map identity(1.0);
    return glm::translate(identity, placement.translation) *
           glm::rotate(identity, placement.angle, placement.axis) *
           glm::scale(identity, placement.scale);
}
// [local_to_world]

/// The mesh with every vertex mapped, rounded to float once. A map that mirrors (negative
/// determinant) would turn the front sides inwards; the faces' vertex order is reversed to keep
/// them.
inline TriangleMesh mapped(const Map& map, TriangleMesh mesh) {
    for (Point3& vertex : mesh.vertices) vertex = Point3(map_point(map, Double3(vertex)));
    if (glm::determinant(map) < 0.0)
        for (auto& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

// [camera_maps]
/// Columns: where the camera's axes and its origin lie in the world.
inline Map camera_to_world(const Camera& camera) {
    const CameraFrame frame(camera);
    return {glm::dvec4(frame.right, 0.0), glm::dvec4(frame.up, 0.0), glm::dvec4(frame.back, 0.0),
            glm::dvec4(Double3(camera.eye), 1.0)};
}

/// The inverse. The camera's axes are orthonormal, so each camera coordinate is a dot product with
/// one of them. The eye is subtracted first: close to a far-away eye nothing cancels later.
inline Double3 world_to_camera(const Camera& camera, const CameraFrame& frame,
                               const Double3& point) {
    const Double3 from_eye = point - Double3(camera.eye);
    return {glm::dot(frame.right, from_eye), glm::dot(frame.up, from_eye),
            glm::dot(frame.back, from_eye)};
}

/// Distance of a camera point from the eye's plane, along the view direction: positive in front of
/// the eye.
inline double depth(const Double3& camera_point) {
    return -camera_point.z;
}

/// The place in the picture, in pixels from its top left corner, where a point in front of the eye
/// is seen: divided by its depth it lies on the image plane at distance 1, which is then stretched
/// to width x height pixels. The inverse of camera_ray (common/camera.hpp): camera_ray(pixel)
/// passes through the point.
inline glm::dvec2 camera_to_pixel(const CameraFrame& frame, const Double3& camera_point, int width,
                                  int height) {
    const double pixels_per_unit = 0.5 * height / frame.tan_half_fov;
    return {0.5 * width + pixels_per_unit * camera_point.x / depth(camera_point),
            0.5 * height - pixels_per_unit * camera_point.y / depth(camera_point)};
}
// [camera_maps]

}  // namespace space
