// The kernels' slab test: on the safe side of exact arithmetic at every plane, and how much of its
// margin is used.
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/quadruple.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {
namespace {

constexpr Quadruple u = 0x1p-24;

/// From 2^lowest to 2^highest, of either sign, all sizes alike.
float of_any_size(Pcg32& random, int lowest, int highest) {
    const float mantissa = random.uniform(1.0f, 2.0f);
    const int exponent = lowest + int(random.below(std::uint32_t(highest - lowest)));
    return std::ldexp(random.below(2) == 0 ? mantissa : -mantissa, exponent);
}
/// A plane near the origin, or anywhere.
float plane_for(Pcg32& random, float o) {
    switch (random.below(4)) {
        case 0:
            return o;
        case 1:
            return std::nextafter(o, random.below(2) == 0 ? -infinity : infinity);
        case 2:
            return o + o * of_any_size(random, -24, 1);
        default:
            return of_any_size(random, -40, 29);
    }
}
/// A plane across x, and a ray whose other components are like 1.
struct SlabCase {
    float p, o, d;
};
SlabCase some_case(Pcg32& random) {
    const float o = random.below(8) == 0 ? 0.0f : of_any_size(random, -40, 29);
    const float d = of_any_size(random, -80, 29);
    return {plane_for(random, o), o, d};
}
KernelRay prepared(const SlabCase& c) {
    KernelRay ray{};
    if (!prepare_kernel_ray({.origin = {c.o, 0, 0}, .direction = {c.d, 1, 1}}, 0x1p30f, ray))
        FAIL("a ray that kernels should take");
    return ray;
}

/// Whether t, computed, is at most the exact (p - o) / d, or at least.
bool at_most_exact(float t, const SlabCase& c) {
    const Quadruple left = Quadruple{t} * c.d, right = Quadruple{c.p} - c.o;
    return c.d > 0 ? left <= right : left >= right;
}
bool at_least_exact(float t, const SlabCase& c) {
    const Quadruple left = Quadruple{t} * c.d, right = Quadruple{c.p} - c.o;
    return c.d > 0 ? left >= right : left <= right;
}
/// As the kernels compute it across an axis.
float near_t(const KernelRay& ray, int axis, float p) {
    return (p - ray.near_origin[axis]) * ray.near_scale[axis];
}
float far_t(const KernelRay& ray, int axis, float p, bool is_fused) {
    const float way = p - ray.far_origin[axis], scale = ray.far_scale[axis], tiny = 0x1p-120f;
    const float product = way * scale;
    return is_fused ? std::fma(way, scale, tiny) : product + tiny;
}

}  // namespace

TEST_CASE("a near plane is never met later than exactly, a far one never earlier, fused or not") {
    Pcg32 random(1);
    for (int i = 0; i < sized(400'000, 20'000); ++i) {
        const SlabCase c = some_case(random);
        const KernelRay ray = prepared(c);
        const bool is_ahead = (Quadruple{c.p} - c.o) * c.d >= 0;
        const float near = near_t(ray, 0, c.p);
        // A product that underflows is off by half of the smallest float: far planes have more.
        if (!(near <= 0x1p-126f || at_most_exact(near, c))) {
            CAPTURE(i, c.p, c.o, c.d, near);
            FAIL("a near plane is met too late");
        }
        for (const bool is_fused : {false, true}) {
            const float far = far_t(ray, 0, c.p, is_fused);
            if (is_ahead && !(far >= 0.0f && at_least_exact(far, c))) {
                CAPTURE(i, c.p, c.o, c.d, far, is_fused);
                FAIL("a far plane is met too early");
            }
        }
    }
}

// A flat wall is its box's near plane: what ends at the wall must still enter the box.
TEST_CASE("a near plane is met no later than its t, rounded; a plain one sometimes is") {
    Pcg32 random(4);
    int late = 0;
    for (int i = 0; i < sized(400'000, 20'000); ++i) {
        const SlabCase c = some_case(random);
        const Quadruple exact = (Quadruple{c.p} - c.o) / c.d;
        if (exact < 0) continue;
        const KernelRay ray = prepared(c);
        const float limit = float(exact), near = near_t(ray, 0, c.p);
        if (!(near <= limit)) {
            CAPTURE(i, c.p, c.o, c.d, near, limit);
            FAIL("a wall is lost");
        }
        late += (c.p - c.o) * (1.0f / c.d) > limit;
    }
    fmt::print("  {} plain planes are met too late\n", late);
    CHECK(late > 0);
}

TEST_CASE(
    "of what reciprocals are shortened and lengthened by, most is used, and no more than all") {
    Pcg32 random(2);
    Quadruple near = 0, far = 0;
    for (int i = 0; i < sized(400'000, 20'000); ++i) {
        const SlabCase c = some_case(random);
        const Quadruple exact = (Quadruple{c.p} - c.o) / c.d;
        if (!(exact > Quadruple(0x1p-60))) continue;
        const KernelRay ray = prepared(c);
        // What is left between the computed t and the exact one, beside what was given away.
        near = std::max(near, 1 - (1 - Quadruple{near_t(ray, 0, c.p)} / exact) / (4 * u));
        far = std::max(far, 1 - (Quadruple{far_t(ray, 0, c.p, false)} / exact - 1) / (6 * u));
    }
    fmt::print("  largest share of a plane's margin that roundings take: near {:.2f}, far {:.2f}\n",
               double(near), double(far));
    CHECK(double(near) > 0.6);
    CHECK(double(far) > 0.4);
    CHECK(double(near) <= 1.0);
    CHECK(double(far) <= 1.0);
}

TEST_CASE("a ray along planes: those that it lies in are met before it begins and after its end") {
    Pcg32 random(3);
    for (int i = 0; i < sized(40'000, 5'000); ++i) {
        const float o = random.below(8) == 0 ? 0.0f : of_any_size(random, -100, 29);
        const float zero = random.below(2) == 0 ? 0.0f : -0.0f;
        const float d = of_any_size(random, -20, 20);
        KernelRay ray{};
        const bool is_for_kernels =
            prepare_kernel_ray({.origin = {o, 1, 1}, .direction = {zero, d, 0}}, 1024.0f, ray);
        REQUIRE(is_for_kernels);
        // Where it leaves the box around all at the latest.
        const Quadruple reach = std::max({1024.0f, std::abs(o), 1.0f});
        const float end = float(2 * reach / (d < 0 ? -Quadruple{d} : Quadruple{d}));
        const auto fail = [&](float plane) {
            CAPTURE(i, o, d, plane, end);
            FAIL("a plane that the ray lies in, or is inside of, clips it");
        };
        for (const float below : {o, std::nextafter(o, -infinity), o - 1.0f, -1024.0f})
            if (below <= o && !(near_t(ray, 0, below) <= 0.0f)) fail(below);
        for (const float above : {o, std::nextafter(o, infinity), o + 1.0f, 1024.0f})
            if (above >= o &&
                !(far_t(ray, 0, above, false) >= end && far_t(ray, 0, above, true) >= end))
                fail(above);
    }
}

}  // namespace space
