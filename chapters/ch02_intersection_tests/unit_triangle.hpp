/// @file
/// Woop's unit triangle (Woop 2004): an affine map, made once per triangle, takes it to (0,0,0),
/// (1,0,0), (0,1,0); the mapped ray then meets the plane z = 0, and its x and y are u and v.
#pragma once

#include "common/accelerator.hpp"

#include <optional>

namespace space {

/// Maps the ray to where the triangle is the unit one.
struct UnitTriangle {
    /// Rows of the map: u, v and height over the triangle's plane are row . point + offset. 48
    /// bytes.
    struct Prepared {
        Vector3 row[3];
        float offset[3];
    };

    /// Inverts [ab ac n] in double; a triangle without area gives rows that are not numbers, which
    /// no ray hits.
    static Prepared prepare(const Triangle& triangle) {
        const Double3 a{triangle.a}, ab = Double3(triangle.b) - a, ac = Double3(triangle.c) - a;
        const Double3 n = glm::cross(ab, ac);
        const double square = glm::dot(n, n);
        const Double3 rows[3] = {glm::cross(ac, n) / square, glm::cross(n, ab) / square,
                                 n / square};
        Prepared prepared;
        for (int i = 0; i < 3; ++i) {
            prepared.row[i] = Vector3(rows[i]);
            prepared.offset[i] = static_cast<float>(-glm::dot(rows[i], a));
        }
        return prepared;
    }

    // [unit_triangle]
    static std::optional<Hit> intersect(const Ray& ray, const Prepared& map) {
        const float height = glm::dot(map.row[2], ray.origin) + map.offset[2];
        const float t = -height / glm::dot(map.row[2], ray.direction);
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        const float u = glm::dot(map.row[0], ray.origin) + map.offset[0] +
                        t * glm::dot(map.row[0], ray.direction);
        if (!(u >= 0.0f)) return std::nullopt;
        const float v = glm::dot(map.row[1], ray.origin) + map.offset[1] +
                        t * glm::dot(map.row[1], ray.direction);
        if (!(v >= 0.0f && u + v <= 1.0f)) return std::nullopt;
        return Hit{.t = t, .u = u, .v = v};
    }
    // [unit_triangle]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        return intersect(ray, prepare(triangle));
    }
};

}  // namespace space
