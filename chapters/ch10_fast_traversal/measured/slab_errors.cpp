#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
#include "common/accelerator.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

constexpr float u24 = 0x1p-24f;

/// Where near and far planes across one axis are met.
struct Slab {
    float near, far;
};

/// As the kernels compute it: a difference and a product.
Slab slab_of_kernels(const KernelRay& ray, int axis, float near, float far) {
    return {(near - ray.near_origin[axis]) * ray.near_scale[axis],
            std::fma(far - ray.far_origin[axis], ray.far_scale[axis], 0x1p-120f)};
}
/// With one fused instruction a plane, and chapter 2's two reciprocals.
Slab slab_fused(const Ray& ray, int axis, float near, float far) {
    const float r = 1.0f / ray.direction[axis], o = ray.origin[axis];
    const float shorter = r * SlabConservative::shorten, longer = r * SlabConservative::lengthen;
    return {std::fma(near, shorter, -o * shorter), std::fma(far, longer, -o * longer)};
}
/// The same with the margin that it needs.
Slab slab_fused_safely(const Ray& ray, int axis, float near, float far) {
    const float r = 1.0f / ray.direction[axis], o = ray.origin[axis];
    const float shorter = r * (1.0f - 6.0f * u24), longer = r * (1.0f + 6.0f * u24);
    const float first = o * shorter, last = o * longer;
    return {std::fma(near, shorter, -first - 4.0f * u24 * std::abs(first)),
            std::fma(far, longer, 4.0f * u24 * std::abs(last) - last)};
}

/// A ray that begins in a scene of size 1 and a plane that it comes to from there on.
void add_plane(SlabErrorPoint& point, const Ray& ray, float plane) {
    KernelRay prepared;
    if (!prepare_kernel_ray(ray, std::abs(plane), prepared)) return;
    const double o{ray.origin.x}, d{ray.direction.x}, t = (double{plane} - o) / d;
    if (!(t > 0.0)) return;
    const auto is_unsafe = [&](const Slab& slab) {
        return double{slab.near} > t || double{slab.far} < t;
    };
    const Slab ours = slab_of_kernels(prepared, 0, plane, plane);
    ++point.planes;
    point.unsafe += is_unsafe(ours);
    point.unsafe_fused += is_unsafe(slab_fused(ray, 0, plane, plane));
    point.unsafe_fused_safely += is_unsafe(slab_fused_safely(ray, 0, plane, plane));
    const double u{u24};
    point.largest = std::max({point.largest, (double{ours.near} / t - (1.0 - 4.0 * u)) / (4.0 * u),
                              ((1.0 + 6.0 * u) - double{ours.far} / t) / (6.0 * u)});
}

template <class SlabOf>
bool is_met(const Ray& ray, const Aabb& box, const SlabOf& slab_of) {
    float enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const bool backwards = ray.direction[axis] < 0.0f;
        const Slab slab = slab_of(axis, (backwards ? box.max : box.min)[axis],
                                  (backwards ? box.min : box.max)[axis]);
        enter = std::max(enter, slab.near);
        leave = std::min(leave, slab.far);
    }
    return enter <= leave;
}

bool is_flat(const Aabb& box) {
    return box.extent().x == 0.0f || box.extent().y == 0.0f || box.extent().z == 0.0f;
}

/// Rays that leave a wall, and the box of the triangle that they leave.
ReturnPoint returns_in(const char* name, std::size_t count, const Options& options) {
    const std::vector<Triangle> triangles = make_scene(name, options.seed).mesh.triangles();
    ReturnPoint point{.scene = name};
    Pcg32 random(options.seed);
    while (point.rays < count) {
        const auto which = random.below(static_cast<std::uint32_t>(triangles.size()));
        const Triangle& triangle = triangles[which];
        const Aabb box = bounds(triangle);
        if (!is_flat(box)) continue;
        Hit hit;
        hit.u = random.uniform(0.1f, 0.4f);
        hit.v = random.uniform(0.1f, 0.4f);
        const Double3 direction = random_direction(random);
        const Ray towards{.origin = {}, .direction = Vector3(-direction)};
        const Double3 n = normal_towards(triangle, towards);
        const Ray ray{.origin = shadow_origin(triangle, hit_point(triangle, hit), n),
                      .direction = Vector3(direction)};
        KernelRay prepared;
        if (!prepare_kernel_ray(ray, 1.0f, prepared)) continue;
        ++point.rays;
        point.ours += is_met(ray, box, [&](int axis, float near, float far) {
            return slab_of_kernels(prepared, axis, near, far);
        });
        point.fused += is_met(ray, box, [&](int axis, float near, float far) {
            return slab_fused_safely(ray, axis, near, far);
        });
    }
    return point;
}

}  // namespace

std::vector<SlabErrorPoint> measure_slab_errors(const Options& options) {
    const std::size_t count = options.small ? 10'000 : 1'000'000;
    std::vector<SlabErrorPoint> points;
    for (const float away : {0.0f, 1.0f, 1e3f, 1e6f}) {
        SlabErrorPoint point{.away = double{away}};
        Pcg32 random(options.seed);
        for (std::size_t i = 0; i < count; ++i) {
            Ray ray;
            ray.origin = Point3(away) + random_vector(random);
            ray.direction = random_vector(random);
            add_plane(point, ray, away + random.uniform(-1.0f, 1.0f));
        }
        points.push_back(point);
    }
    return points;
}

std::vector<ReturnPoint> measure_returns(const Options& options) {
    const std::size_t count = options.small ? 1'000 : 100'000;
    std::vector<ReturnPoint> points;
    for (const char* const name : {"room", "stadium", "building"})
        points.push_back(returns_in(name, count, options));
    return points;
}

}  // namespace space::ch10
