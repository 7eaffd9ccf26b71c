/// @file
/// The watertight test of Woop, Benthin & Wald 2013 (JCGT 2:1): a shear, made once per ray, turns
/// the ray into the z axis; what is left are three edge functions in the plane, equal and opposite
/// for the two triangles at an edge.
#pragma once

#include "common/accelerator.hpp"

#include <cmath>
#include <optional>

namespace space {

/// Shears the ray to the z axis and decides in the plane.
struct Watertight {
    /// The ray with its shear, for many triangles.
    struct Prepared {
        Point3 origin;
        int kx, ky, kz;  ///< the ray's longest axis is kz
        float sx, sy, sz;
        float tmin, tmax;
    };

    static Prepared prepare(const Ray& ray) {
        const Vector3 size = glm::abs(ray.direction);
        int kz = 0;
        if (size.y > size[kz]) kz = 1;
        if (size.z > size[kz]) kz = 2;
        // The paper exchanges kx and ky where d[kz] < 0, so that the signs below tell front from
        // back. Here both are hit, and the exchange would turn all signs and nothing else.
        const int kx = (kz + 1) % 3, ky = (kx + 1) % 3;
        const Vector3& d = ray.direction;
        return {ray.origin,    kx,           ky,       kz,      d[kx] / d[kz],
                d[ky] / d[kz], 1.0f / d[kz], ray.tmin, ray.tmax};
    }

    // [watertight]
    static std::optional<Hit> intersect(const Prepared& ray, const Triangle& triangle) {
        const Vector3 a = triangle.a - ray.origin, b = triangle.b - ray.origin,
                      c = triangle.c - ray.origin;
        const float ax = a[ray.kx] - ray.sx * a[ray.kz], ay = a[ray.ky] - ray.sy * a[ray.kz];
        const float bx = b[ray.kx] - ray.sx * b[ray.kz], by = b[ray.ky] - ray.sy * b[ray.kz];
        const float cx = c[ray.kx] - ray.sx * c[ray.kz], cy = c[ray.ky] - ray.sy * c[ray.kz];
        float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        if (u == 0.0f || v == 0.0f ||
            w == 0.0f) {  // a product of two floats is exact in double: so is this sign
            u = edge_in_double(cx, by, cy, bx);
            v = edge_in_double(ax, cy, ay, cx);
            w = edge_in_double(bx, ay, by, ax);
        }
        if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f))
            return std::nullopt;
        const float determinant = u + v + w;
        if (determinant == 0.0f) return std::nullopt;
        const float t =
            (u * (ray.sz * a[ray.kz]) + v * (ray.sz * b[ray.kz]) + w * (ray.sz * c[ray.kz])) /
            determinant;
        if (!(t >= ray.tmin && t <= ray.tmax) || std::isinf(t)) return std::nullopt;
        return Hit{.t = t, .u = v / determinant, .v = w / determinant};
    }
    // [watertight]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        return intersect(prepare(ray), triangle);
    }

  private:
    static float edge_in_double(float x1, float y2, float y1, float x2) {
        return static_cast<float>(double{x1} * y2 - double{y1} * x2);
    }
};

}  // namespace space
