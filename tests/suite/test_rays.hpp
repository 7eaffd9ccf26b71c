/// @file
/// Rays on which structures fail, aimed at a given scene.
#pragma once

#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace space {

struct TestRay {
    std::string_view kind;
    Ray ray;
};

/// Aims rays at a scene from in and around its box; everything finite that it makes has t within
/// float's range.
class RayMaker {
  public:
    RayMaker(std::span<const Triangle> triangles, std::uint64_t seed)
        : triangles_(triangles), random_(seed, 54) {
        for (const Triangle& triangle : triangles) box_.extend(bounds(triangle));
        if (box_.is_empty()) box_ = {Point3{0.0f}, Point3{1.0f}};
        const Vector3 extent = box_.extent();
        reach_ = std::max({extent.x, extent.y, extent.z});
        if (reach_ == 0.0f) reach_ = 1.0f;
    }

    TestRay random() { return {"random", towards(outside(), inside())}; }

    /// A direction along an axis, the others' zeros of either sign; the origin often exactly on
    /// planes of vertices.
    TestRay axis_parallel() {
        Ray ray{.origin = outside(), .direction = Vector3{0.0f}};
        const int along = below(3);
        for (int axis = 0; axis < 3; ++axis) {
            ray.direction[axis] = axis == along ? sign() : 0.0f * sign();
            if (axis != along)
                ray.origin[axis] = random_.below(2) ? vertex()[axis] : inside()[axis];
        }
        return {"axis-parallel", ray};
    }

    /// One component of the direction is zero.
    TestRay within_a_slab() {
        Ray ray = random().ray;
        const int axis = below(3);
        ray.direction[axis] = 0.0f * sign();
        ray.origin[axis] = random_.below(2) ? vertex()[axis] : inside()[axis];
        if (ray.direction == Vector3{0.0f}) ray.direction[(axis + 1) % 3] = 1.0f;
        return {"within a slab", ray};
    }

    TestRay from_vertex() { return {"from a vertex", towards(vertex(), inside())}; }
    TestRay from_face() { return {"from a face", towards(point_on_face(), inside())}; }
    TestRay at_vertex() { return {"at a vertex", towards(outside(), vertex())}; }
    TestRay at_edge() { return {"at an edge", towards(outside(), point_on_edge())}; }

    /// The ray with its direction made longer or shorter by a power of two.
    TestRay scaled(const Ray& ray) {
        const float scale = std::ldexp(1.0f, below(41) - 20);
        return {"scaled direction",
                {ray.origin, ray.direction * scale, ray.tmin / scale, ray.tmax / scale}};
    }

    /// Rays that hit nothing, whatever the scene: not a number, endless, no direction, no interval.
    std::vector<TestRay> invalid() {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        const Ray good = random().ray;
        std::vector<TestRay> rays;
        for (int axis = 0; axis < 3; ++axis)
            for (const float bad : {nan, infinity, -infinity}) {
                rays.push_back({"invalid", good});
                rays.back().ray.origin[axis] = bad;
                rays.push_back({"invalid", good});
                rays.back().ray.direction[axis] = bad;
            }
        rays.push_back({"invalid", {good.origin, Vector3{0.0f}}});
        rays.push_back({"invalid", {good.origin, Vector3{-0.0f}}});
        rays.push_back({"invalid", {good.origin, good.direction, nan, infinity}});
        rays.push_back({"invalid", {good.origin, good.direction, 0.0f, nan}});
        rays.push_back({"invalid", {good.origin, good.direction, 1.0f, 0.0f}});
        rays.push_back({"invalid", {good.origin, good.direction, infinity, -infinity}});
        return rays;
    }

    /// A ray with its interval cut at and beside a t where it hits something.
    static std::vector<TestRay> cut_at(const Ray& ray, float t) {
        const float before = std::nextafter(t, -infinity), after = std::nextafter(t, infinity);
        const auto with = [&](float tmin, float tmax) {
            return TestRay{"cut interval", {ray.origin, ray.direction, tmin, tmax}};
        };
        return {with(t, t),          with(0.0f, t),
                with(t, infinity),   with(after, infinity),
                with(0.0f, before),  with(-infinity, before),
                with(before, after), with(-infinity, infinity),
                with(t, before)};
    }

    /// From off the triangle towards its middle, along the normal.
    Ray probe(const Triangle& triangle) const {
        const Double3 middle =
            (Double3(triangle.a) + Double3(triangle.b) + Double3(triangle.c)) / 3.0;
        const Double3 across = normal(triangle);
        const double length = glm::length(across);
        if (length == 0.0)
            return {.origin = Point3(middle),
                    .direction = {0.0f, 0.0f, 1.0f},
                    .tmin = -1.0f,
                    .tmax = 1.0f};
        const Point3 origin(middle + across / length * double{reach_});
        return {.origin = origin, .direction = Vector3(middle - Double3(origin))};
    }

  private:
    int below(int bound) {
        return static_cast<int>(random_.below(static_cast<std::uint32_t>(bound)));
    }
    float sign() { return random_.below(2) ? 1.0f : -1.0f; }
    const Triangle& triangle() {
        return triangles_[random_.below(static_cast<std::uint32_t>(triangles_.size()))];
    }
    Point3 vertex() {
        if (triangles_.empty()) return inside();
        const Triangle& t = triangle();
        const int corner = below(3);
        return corner == 0 ? t.a : corner == 1 ? t.b : t.c;
    }
    Point3 point_on_edge() {
        if (triangles_.empty()) return inside();
        const Triangle& t = triangle();
        const int edge = below(3);
        const Point3 from = edge == 0   ? t.a
                            : edge == 1 ? t.b
                                        : t.c,
                     to = edge == 0   ? t.b
                          : edge == 1 ? t.c
                                      : t.a;
        return from + random_.uniform() * (to - from);
    }
    Point3 point_on_face() {
        if (triangles_.empty()) return inside();
        const Triangle& t = triangle();
        float u = random_.uniform(), v = random_.uniform();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        return t.a + u * (t.b - t.a) + v * (t.c - t.a);
    }
    Point3 inside() { return box_point(0.0f); }
    Point3 outside() { return box_point(1.0f); }
    /// In the box, made larger by `margin` of its longest edge on each side.
    Point3 box_point(float margin) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] =
                random_.uniform(box_.min[axis] - margin * reach_, box_.max[axis] + margin * reach_);
        return p;
    }
    Ray towards(const Point3& origin, const Point3& target) {
        const Vector3 direction = target - origin;
        return {.origin = origin,
                .direction = direction == Vector3{0.0f} ? Vector3{0.0f, 0.0f, 1.0f} : direction};
    }

    std::span<const Triangle> triangles_;
    Pcg32 random_;
    Aabb box_;
    float reach_;
};

}  // namespace space
