// The filter of a leaf's four lanes: its bounds hold, and are not much larger than errors get.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "common/geometry.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/filter_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace space {
namespace {

/// The largest errors, each divided by what the filter allows.
struct FilterErrors {
    double volumes = 0.0;  ///< of u, v and w, by `bound`
    double late = 0.0;     ///< of t det against the limit, by `late`
    double early = 0.0;    ///< and against tmin, by `early`
};

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
std::int64_t some_whole(Pcg32& random) {
    const auto bits = 1 + random.below(24);
    const auto size = std::int64_t(random.next() >> (32 - bits));
    return random.below(2) == 0 ? size : -size;
}
Whole3 some_vector(Pcg32& random) {
    const std::int64_t x = some_whole(random);
    const std::int64_t y = some_whole(random);
    const std::int64_t z = some_whole(random);
    return {x, y, z};
}
/// The vector, equal to another one in some components: then a difference is short, and the bound,
/// which knows sizes alone, is hardly larger than what there is.
Whole3 near_to(Pcg32& random, const Whole3& other) {
    Whole3 v = some_vector(random);
    const std::uint32_t same = random.below(8);
    if ((same & 1u) != 0) v.x = other.x;
    if ((same & 2u) != 0) v.y = other.y;
    if ((same & 4u) != 0) v.z = other.z;
    return v;
}

long double as_real(Whole volume) {
    return std::ldexp(static_cast<long double>(volume), -60);
}
float as_float(Whole coordinate) {
    return std::ldexp(float(std::int64_t(coordinate)), -20);
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

template <class Numbers>
FilterErrors filter_errors(const Numbers& numbers, int blocks) {
    Pcg32 random(1);
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
        FilterNumbers found;
        numbers(block, ray, found);
        for (int lane = 0; lane < 4; ++lane) {
            const Turned& e = exact[lane];
            const float bound = found[lane].bound;
            if (!(e.det > static_cast<long double>(bound))) continue;  // which sign it has is open
            const long double det = found[lane].size, u = found[lane].u, v = found[lane].v;
            const float w = found[lane].size - (found[lane].u + found[lane].v);
            raise(worst.volumes, std::abs(u - e.u), bound);
            raise(worst.volumes, std::abs(v - e.v), bound);
            raise(worst.volumes, std::abs(w - (e.det - e.u - e.v)), bound);
            const long double t_error = std::abs(found[lane].t - e.t),
                              end_error = ray.limit * std::abs(det - e.det);
            raise(worst.late, t_error + end_error, found[lane].late);
            raise(worst.early, t_error + end_error, found[lane].early);
        }
    }
    return worst;
}

void check(const char* how, const FilterErrors& most) {
    fmt::print("  largest error / bound, {}: volumes {:.2f}, late {:.2f}, early {:.2f}\n", how,
               most.volumes, most.late, most.early);
    for (const double share : {most.volumes, most.late, most.early}) {
        CHECK(share > 0.2);
        CHECK(share < 0.95);  // what is compared is rounded, too
    }
}

}  // namespace

TEST_CASE("of the filter's bounds a fifth is used by some lane, and by none all") {
    const int blocks = sized(200'000, 5'000);
    check("products and sums rounded", filter_errors(plain_filter::filter_numbers, blocks));
    if (std::ranges::count(usable_instruction_sets(), InstructionSet::avx2) > 0)
        check("fused", filter_errors(fused_filter::filter_numbers, blocks));
}

namespace {

/// Triangles at the origin whose plane the ray begins beside, by 2^-27 to 2^-21, and goes along:
/// det is about as large as its error in floats, so that its sign there is often another one; and t
/// det is far larger than its own.
struct Grazing {
    Triangle triangle;
    Ray ray;
};
Grazing some_grazing(Pcg32& random) {
    const Vector3 e1 = random_vector(random);
    const Vector3 e2 = random_vector(random);
    const Vector3 away = random_vector(random);
    const int exponent = -27 + int(random.below(7));
    const float u = random.uniform(0.1f, 0.5f);
    const float v = random.uniform(0.1f, 0.5f);
    const Point3 origin = std::ldexp(1.0f, exponent) * away;
    return {{Point3(0.0f), e1, e2}, {.origin = origin, .direction = u * e1 + v * e2 - origin}};
}

struct GrazingCounts {
    std::size_t hits = 0;
    std::size_t turned = 0;  ///< of these, where floats give det the other sign
    std::size_t lost = 0, invented = 0;
};
template <class Numbers, class Masks>
GrazingCounts grazing_counts(const Numbers& numbers, const Masks& masks, int cases) {
    Pcg32 random(2);
    GrazingCounts counts;
    for (int i = 0; i < cases; ++i) {
        const Grazing c = some_grazing(random);
        TriangleBlock block;
        for (std::size_t lane = 0; lane < 4; ++lane) block.put(lane, c.triangle, 0);
        KernelRay ray{};
        if (!prepare_kernel_ray(c.ray, 1.0f, ray)) continue;
        FilterMasks found{};
        masks(block.corners[0].data(), ray, found);
        const bool is_hit = FilteredExact::intersect(c.ray, c.triangle).has_value();
        counts.invented += !is_hit && found.must_hit != 0;
        if (!is_hit) continue;
        ++counts.hits;
        counts.lost += found.may_hit != 15;
        FilterNumbers of;
        numbers(block.corners[0].data(), ray, of);
        counts.turned += of[0].t < 0.0f;  // as they are turned, a hit has both above 0
    }
    return counts;
}
void check_grazing(const char* how, const GrazingCounts& counts) {
    fmt::print("  along the plane, {}: {} hits, {} of them with the other sign of det\n", how,
               counts.hits, counts.turned);
    CHECK(counts.turned > counts.hits / 100);
    CHECK(counts.lost == 0);
    CHECK(counts.invented == 0);
}

}  // namespace

// Without the second condition on what lies before tmin, a det whose sign is lost turns a hit ahead
// into one behind.
TEST_CASE("a ray along a triangle's plane hits it, though floats give det the other sign") {
    const int cases = sized(50'000, 3'000);
    check_grazing("products and sums rounded",
                  grazing_counts(plain_filter::filter_numbers, plain_filter::filter_masks, cases));
    if (std::ranges::count(usable_instruction_sets(), InstructionSet::avx2) > 0)
        check_grazing("fused", grazing_counts(fused_filter::filter_numbers,
                                              fused_filter::filter_masks, cases));
}

}  // namespace space
