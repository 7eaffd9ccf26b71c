// The slab test with fused multiply-add: on the safe side of exact arithmetic at every plane, and
// how much of its margin is used.
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {
namespace {

/// 113 bits: the difference of two floats is exact in them as long as one is not 2^89 times the
/// other, and so is a product of it with a float and a bit.
__extension__ typedef __float128 Wide;

constexpr Wide u = 0x1p-24;

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
struct Case {
    float p, o, d;
};
Case some_case(Pcg32& random) {
    const float o = random.below(8) == 0 ? 0.0f : of_any_size(random, -40, 29);
    const float d = of_any_size(random, -80, 29);
    return {plane_for(random, o), o, d};
}
KernelRay prepared(const Case& c) {
    KernelRay ray{};
    if (!prepare_kernel_ray({.origin = {c.o, 0, 0}, .direction = {c.d, 1, 1}}, 0x1p30f, ray))
        FAIL("a ray that kernels should take");
    return ray;
}

/// Whether t, computed, is at most the exact (p - o) / d, or at least.
bool at_most_exact(float t, const Case& c) {
    const Wide left = Wide{t} * c.d, right = Wide{c.p} - c.o;
    return c.d > 0 ? left <= right : left >= right;
}
bool at_least_exact(float t, const Case& c) {
    const Wide left = Wide{t} * c.d, right = Wide{c.p} - c.o;
    return c.d > 0 ? left >= right : left <= right;
}

}  // namespace

TEST_CASE("a near plane is never met later than exactly, a far one never earlier, fused or not") {
    Pcg32 random(1);
    for (int i = 0; i < sized(400'000, 20'000); ++i) {
        const Case c = some_case(random);
        const KernelRay ray = prepared(c);
        const bool is_ahead = (Wide{c.p} - c.o) * c.d >= 0;
        const float scale = ray.near_scale[0], shift = ray.near_shift[0];
        const float far_scale = ray.far_scale[0], far_shift = ray.far_shift[0];
        const float product = c.p * scale, far_product = c.p * far_scale;
        for (const float near : {std::fma(c.p, scale, shift), product + shift})
            if (!(near <= 0.0f || at_most_exact(near, c))) {
                CAPTURE(i, c.p, c.o, c.d, near);
                FAIL("a near plane is met too late");
            }
        for (const float far : {std::fma(c.p, far_scale, far_shift), far_product + far_shift})
            if (is_ahead && !(far >= 0.0f && at_least_exact(far, c))) {
                CAPTURE(i, c.p, c.o, c.d, far);
                FAIL("a far plane is met too early");
            }
    }
}

TEST_CASE("of the margins of the slab test more than a quarter is used, and no more than all") {
    Pcg32 random(2);
    Wide fused = 0, apart = 0;
    for (int i = 0; i < sized(400'000, 20'000); ++i) {
        const Case c = some_case(random);
        const float r = 1.0f / c.d, or_rounded = c.o * r, product = c.p * r;
        const Wide exact = (Wide{c.p} - c.o) / c.d;
        const auto size = [](Wide x) { return x < 0 ? -x : x; };
        const Wide margin = 6 * u * size(exact) + 4 * u * size(Wide{or_rounded}) + Wide(0x1p-140);
        fused = std::max(fused, size(Wide{std::fma(c.p, r, -or_rounded)} - exact) / margin);
        apart = std::max(apart, size(Wide{product - or_rounded} - exact) / margin);
    }
    fmt::print("  largest error / margin of a plane: fused {:.2f}, not fused {:.2f}\n",
               double(fused), double(apart));
    CHECK(double(fused) > 0.25);
    CHECK(double(apart) > 0.25);
    CHECK(double(fused) < 1.0);
    CHECK(double(apart) < 1.0);
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
        const Wide reach = std::max({1024.0f, std::abs(o), 1.0f});
        const float end = float(2 * reach / (d < 0 ? -Wide{d} : Wide{d}));
        const auto fail = [&](float plane) {
            CAPTURE(i, o, d, plane, end);
            FAIL("a plane that the ray lies in, or is inside of, clips it");
        };
        for (const float below : {o, std::nextafter(o, -infinity), o - 1.0f, -1024.0f}) {
            const float t = below * ray.near_scale[0];
            if (below <= o && !(std::fma(below, ray.near_scale[0], ray.near_shift[0]) <= 0.0f &&
                                t + ray.near_shift[0] <= 0.0f))
                fail(below);
        }
        for (const float above : {o, std::nextafter(o, infinity), o + 1.0f, 1024.0f}) {
            const float t = above * ray.far_scale[0];
            if (above >= o && !(std::fma(above, ray.far_scale[0], ray.far_shift[0]) >= end &&
                                t + ray.far_shift[0] >= end))
                fail(above);
        }
    }
}

}  // namespace space
