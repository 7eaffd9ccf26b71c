/// @file
/// The text of filter_errors, compiled once with fused multiply-add and once without. The including
/// file defines SPACE_ISA.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/leaf_filter.hpp"
#include "common/pcg32.hpp"
#include "tests/ch10/filter_errors.hpp"

#include <cmath>
#include <cstdint>

namespace space {

namespace SPACE_ISA {
namespace {

__extension__ typedef __int128 Whole;

/// Three whole numbers: coordinates in units of 2^-20, so that all volumes are whole in units of
/// 2^-60.
struct Whole3 {
    Whole x, y, z;
};
Whole3 operator-(const Whole3& a, const Whole3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Whole3 cross(const Whole3& a, const Whole3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Whole dot(const Whole3& a, const Whole3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// As many as a float holds exactly, of any size.
int64_t some_whole(Pcg32& random) {
    const auto bits = 1 + random.below(24);
    const auto size = int64_t(random.next() >> (32 - bits));
    return random.below(2) == 0 ? size : -size;
}
Whole3 some_vector(Pcg32& random) {
    const int64_t x = some_whole(random);
    const int64_t y = some_whole(random);
    const int64_t z = some_whole(random);
    return {x, y, z};
}
/// The vector, equal to another one in some components: then a difference is short, and the bound,
/// which knows sizes alone, is hardly larger than what there is.
Whole3 near_to(Pcg32& random, const Whole3& other) {
    Whole3 v = some_vector(random);
    const uint32_t same = random.below(8);
    if ((same & 1u) != 0) v.x = other.x;
    if ((same & 2u) != 0) v.y = other.y;
    if ((same & 4u) != 0) v.z = other.z;
    return v;
}

long double as_real(Whole volume) {
    return std::ldexp(static_cast<long double>(volume), -60);
}
float as_float(Whole coordinate) {
    return std::ldexp(float(int64_t(coordinate)), -20);
}
void put(float* rows, unsigned lane, const Whole3& p) {
    rows[lane] = as_float(p.x);
    rows[4 + lane] = as_float(p.y);
    rows[8 + lane] = as_float(p.z);
}
void raise(double& most, long double error, float bound) {
    if (error > most * static_cast<long double>(bound)) most = double(error / bound);
}

/// The exact volumes of one lane, turned as the filter turns its own.
struct Turned {
    long double det, u, v, t;
};
Turned exact_volumes(const Whole3& o, const Whole3& d, const Whole3& a, const Whole3& b,
                     const Whole3& c) {
    const Whole3 e1 = b - a, e2 = c - a, s = o - a, p = cross(d, e2), q = cross(s, e1);
    const Whole det = dot(p, e1), sign = det < 0 ? -1 : 1;
    return {as_real(sign * det), as_real(sign * dot(p, s)), as_real(sign * dot(q, d)),
            as_real(sign * dot(q, e2))};
}

FilterErrors filter_errors(uint64_t seed, int blocks) {
    Pcg32 random(seed);
    FilterErrors worst;
    for (int i = 0; i < blocks; ++i) {
        const Whole3 o = some_vector(random), d = some_vector(random);
        alignas(32) float block[40] = {};
        Turned exact[4];
        for (unsigned lane = 0; lane < 4; ++lane) {
            const Whole3 a = near_to(random, o);
            const Whole3 b = near_to(random, a);
            const Whole3 c = near_to(random, a);
            put(block, lane, a);
            put(block + 12, lane, b);
            put(block + 24, lane, c);
            exact[lane] = exact_volumes(o, d, a, b, c);
        }
        KernelRay ray{};
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = as_float(axis == 0 ? o.x : axis == 1 ? o.y : o.z);
            ray.direction[axis] = as_float(axis == 0 ? d.x : axis == 1 ? d.y : d.z);
            ray.direction_length += std::abs(ray.direction[axis]);
        }
        // Ends next to the hit of one lane.
        const float t = float(exact[i % 4].t / exact[i % 4].det);
        ray.limit = t > 0.0f && t < 0x1p100f ? t : 1.0f;
        ray.tmin = ray.limit;
        const LeafVolumes found = volumes_of(reinterpret_cast<const char*>(block), ray, ray.limit);
        for (int lane = 0; lane < 4; ++lane) {
            const Turned& e = exact[lane];
            const float bound = found.bound[lane];
            if (!(e.det > static_cast<long double>(bound))) continue;  // which sign it has is open
            const long double det = found.size[lane], u = found.u[lane], v = found.v[lane];
            const float w = found.size[lane] - (found.u[lane] + found.v[lane]);
            raise(worst.volumes, std::abs(u - e.u), bound);
            raise(worst.volumes, std::abs(v - e.v), bound);
            raise(worst.volumes, std::abs(w - (e.det - e.u - e.v)), bound);
            const long double t_error = std::abs(found.t[lane] - e.t),
                              end_error = ray.limit * std::abs(det - e.det);
            raise(worst.late, t_error + end_error, found.late[lane]);
            raise(worst.early, t_error + end_error, found.early[lane]);
        }
    }
    return worst;
}

}  // namespace
}  // namespace SPACE_ISA
}  // namespace space
