#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace space::ch10 {
namespace {

constexpr double u24 = 0x1p-24;

/// A ray that begins in a scene of size 1, so far from the origin, and planes across x that it
/// comes to from there on.
class PlaneErrors {
  public:
    PlaneErrors(double away, bool fused) : fused_(fused) {
        point_.away = away;
        point_.instructions = fused ? "fused" : "product and sum";
    }
    const SlabErrorPoint& point() const { return point_; }

    void add(const Ray& ray, float plane) {
        KernelRay prepared;
        if (!prepare_kernel_ray(ray, std::abs(plane), prepared)) return;
        const double o = ray.origin.x, d = ray.direction.x, t = (double{plane} - o) / d;
        if (!(t >= 0.0)) return;
        const double near = at(plane, prepared.near_scale[0], prepared.near_shift[0]),
                     far = at(plane, prepared.far_scale[0], prepared.far_shift[0]),
                     margin = 6.0 * u24 * t + 4.0 * u24 * std::abs(o / d);
        ++point_.planes;
        point_.unsafe += near > t || far < t;
        point_.largest = std::max(
            {point_.largest, (near - (t - margin)) / margin, ((t + margin) - far) / margin});
        // Chapter 7's two factors alone, with one instruction a plane.
        const float r = 1.0f / ray.direction.x, shorter = r * SlabConservative::shorten,
                    longer = r * SlabConservative::lengthen;
        point_.unsafe_without += at(plane, shorter, -ray.origin.x * shorter) > t ||
                                 at(plane, longer, -ray.origin.x * longer) < t;
    }

  private:
    double at(float plane, float scale, float shift) const {
        return double{fused_ ? std::fma(plane, scale, shift) : plane * scale + shift};
    }
    bool fused_;
    SlabErrorPoint point_;
};

}  // namespace

std::vector<SlabErrorPoint> measure_slab_errors(const Options& options) {
    const std::size_t count = options.small ? 10'000 : 1'000'000;
    std::vector<SlabErrorPoint> points;
    for (const float away : {0.0f, 1.0f, 1e3f, 1e6f})
        for (const bool fused : {false, true}) {
            PlaneErrors errors(double{away}, fused);
            Pcg32 random(options.seed);
            for (std::size_t i = 0; i < count; ++i) {
                Ray ray;
                ray.origin = Point3(away) + random_vector(random);
                ray.direction = random_vector(random);
                errors.add(ray, away + random.uniform(-1.0f, 1.0f));
            }
            points.push_back(errors.point());
        }
    return points;
}

}  // namespace space::ch10
