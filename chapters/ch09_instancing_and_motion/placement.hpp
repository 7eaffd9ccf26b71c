/// @file
/// Where an object stands: scaled, turned and moved (Optim25, section 3); the way back; and what
/// becomes of normals and of the front side.
#pragma once

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstddef>

namespace space {

// [placement]
/// Scaled along the object's own axes first, then turned, then moved: M = T R S.
template <class Real>
struct BasicPlacement {
    using Vec = glm::vec<3, Real>;

    Vec translation{0};
    glm::mat<3, 3, Real> rotation{1};  ///< columns: where the axes go; its transpose is its inverse
    Vec scale{1};                      ///< not 0; each negative one is a mirror

    Vec to_world(const Vec& p) const { return rotation * (scale * p) + translation; }
    /// S^-1 R^T T^-1. The difference comes first: far from the origin it is what is exact.
    Vec to_local(const Vec& q) const { return direction_to_local(q - translation); }
    /// Not normalised: so t is the same in both spaces.
    Vec direction_to_local(const Vec& d) const { return glm::transpose(rotation) * d / scale; }
    /// Mirrors turn the winding of triangles; two of them turn it back.
    bool is_mirrored() const { return (scale.x < 0) != ((scale.y < 0) != (scale.z < 0)); }
};
using ObjectPlacement = BasicPlacement<double>;
// [placement]

// [placement_matrices]
/// T R S, for column vectors (x, y, z, 1).
template <class Real>
glm::mat<4, 4, Real> matrix(const BasicPlacement<Real>& placement) {
    glm::mat<4, 4, Real> m(1);
    for (int i = 0; i < 3; ++i)
        m[i] = glm::vec<4, Real>(placement.rotation[i] * placement.scale[i], 0);
    m[3] = glm::vec<4, Real>(placement.translation, 1);
    return m;
}

/// S^-1 R^T T^-1, multiplied out: no determinant, no cofactors.
template <class Real>
glm::mat<4, 4, Real> inverse_matrix(const BasicPlacement<Real>& placement) {
    glm::mat<3, 3, Real> linear = glm::transpose(placement.rotation);
    for (int i = 0; i < 3; ++i) linear[i] /= placement.scale;
    glm::mat<4, 4, Real> m(linear);
    m[3] = glm::vec<4, Real>(-(linear * placement.translation), 1);
    return m;
}
// [placement_matrices]

inline Affine affine(const ObjectPlacement& placement) {
    const glm::dmat4 m = matrix(placement);
    Affine map;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) map.rows[i][j] = m[int(j)][int(i)];
    return map;
}

/// Counter-clockwise by `angle` as seen from the tip of the axis, whose length is 1 (Rodrigues
/// 1840).
template <class Real>
glm::mat<3, 3, Real> rotation_about(const glm::vec<3, Real>& axis, Real angle) {
    const Real cosine = std::cos(angle), sine = std::sin(angle);
    glm::mat<3, 3, Real> rotation;
    for (int i = 0; i < 3; ++i) {
        glm::vec<3, Real> unit(0);
        unit[i] = 1;
        rotation[i] = cosine * unit + sine * glm::cross(axis, unit) + (1 - cosine) * axis[i] * axis;
    }
    return rotation;
}

// [orthonormal]
/// The rotation that a product of many was meant to be: columns made orthogonal to those before
/// them and of length 1 again (Gram & Schmidt).
template <class Real>
glm::mat<3, 3, Real> orthonormal(const glm::mat<3, 3, Real>& drifted) {
    const auto x = glm::normalize(drifted[0]);
    const auto y = glm::normalize(drifted[1] - glm::dot(x, drifted[1]) * x);
    return {x, y, glm::cross(x, y)};
}
// [orthonormal]

// [world_normal]
/// det(M) M^-T, the matrix of cofactors, without a division. It takes the cross product of two
/// edges to that of the transformed edges.
inline glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// Points to the same side of the surface as before, whether M mirrors or not. Not of length 1.
inline Double3 world_normal(const glm::dmat3& linear, const Double3& normal) {
    const Double3 of_edges = cofactors(linear) * normal;
    return glm::determinant(linear) < 0.0 ? -of_edges : of_edges;
}
// [world_normal]

}  // namespace space
