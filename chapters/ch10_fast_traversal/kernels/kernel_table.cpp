#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace space {

namespace portable {
extern const KernelTable table4, table8;
}
#ifdef __x86_64__
namespace sse2 {
extern const KernelTable table4, table8;
}
namespace avx2 {
extern const KernelTable table4, table8;
}
namespace avx512 {
extern const KernelTable table4, table8;
}
#endif

template <int N>
const KernelTable* kernel_table(InstructionSet set) {
    switch (set) {
        case InstructionSet::scalar:
            return nullptr;
        case InstructionSet::portable:
            return N == 4 ? &portable::table4 : &portable::table8;
#ifdef __x86_64__
        case InstructionSet::sse2:
            return N == 4 ? &sse2::table4 : &sse2::table8;
        case InstructionSet::avx2:
            return N == 4 ? &avx2::table4 : &avx2::table8;
        case InstructionSet::avx512:
            return N == 4 ? &avx512::table4 : &avx512::table8;
#endif
        default:
            return nullptr;
    }
}
template const KernelTable* kernel_table<4>(InstructionSet);
template const KernelTable* kernel_table<8>(InstructionSet);

// [prepare_kernel_ray]
/// As chapter 2's SlabConservative, which proves it: with u = 2^-24 a t carries four roundings, of
/// a difference, a reciprocal, its shortening (or lengthening) and a product, and (1 + u)^4 (1 - 4
/// u) < 1 < (1 - u)^4 (1 + 6 u). A product below 2^-126 is off by 2^-150; far planes get 2^-120
/// more. Nothing overflows: 2^-90 <= |d| <= 2^30, and coordinates are at most 2^30.
///
/// A fused multiply-add, p (1 / d) - o (1 / d), would be quicker by a subtraction, but o / d is
/// rounded: that moves planes by as much as o's last bit, as a margin would have to. Half of the
/// rays that leave a wall would then enter the wall's own boxes again.
///
/// A ray that is parallel to the planes (d = 0) takes 2^90 for 1 / d and moves the planes outwards
/// by a shift, which is at least four roundings of o, and so that 2^90 times it is more than any t
/// at which the ray is still near the tree; and never below 2^-126, since it must not underflow:
/// where the tree is small beside the speed, that is a t of 2^-36, which is more than enough.
/// Inside the slab near planes then come before 0 and far ones after all that can be hit.
bool prepare_kernel_ray(const Ray& ray, float largest, KernelRay& prepared) {
    constexpr float u = 0x1p-24f, slowest = 0x1p-90f, fastest = 0x1p30f;
    if (!(ray.tmin >= 0.0f && ray.tmin <= ray.tmax && largest <= largest_kernel_float))
        return false;
    float length = 0.0f, speed = 0.0f, reach = largest;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis], d = ray.direction[axis], size = std::abs(d);
        if (!(std::abs(o) <= largest_kernel_float && size <= fastest)) return false;
        if (!(size >= slowest || d == 0.0f)) return false;
        reach = std::max(reach, std::abs(o));
        speed = std::max(speed, size);
        length += size;
    }
    if (!(speed > 0.0f)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis], d = ray.direction[axis];
        const float r = 1.0f / d;
        const bool backwards = d < 0.0f;
        prepared.origin[axis] = o;
        prepared.direction[axis] = d;
        prepared.near_origin[axis] = prepared.far_origin[axis] = o;
        prepared.near_scale[axis] = r * (1.0f - 4.0f * u);
        prepared.far_scale[axis] = r * (1.0f + 6.0f * u);
        prepared.near_row[axis] = std::uint32_t(axis + (backwards ? 3 : 0));
        prepared.far_row[axis] = std::uint32_t(axis + (backwards ? 0 : 3));
        if (d == 0.0f) {  // on the fastest axis all lies before t = 2 reach / speed
            const float shift =
                std::max({4.0f * u * std::abs(o), 8.0f * reach / speed * slowest, 0x1p-126f});
            prepared.near_origin[axis] = o + shift;
            prepared.far_origin[axis] = o - shift;
            prepared.near_scale[axis] = prepared.far_scale[axis] = 1.0f / slowest;
        }
    }
    prepared.tmin = ray.tmin + 0.0f;  // not -0
    prepared.tmax = ray.tmax;
    // A product with a float below 2^-126 would take the processor a hundred cycles.
    prepared.before = ray.tmin > 0x1p-100f ? std::nextafter(ray.tmin, -infinity) : -0x1p-110f;
    prepared.limit = std::nextafter(ray.tmax, infinity);
    prepared.direction_length = length;
    return true;
}
// [prepare_kernel_ray]

bool prepare_kernel_floats(const float* ray, float largest, KernelRay& prepared) {
    Ray all;
    static_assert(sizeof all == 8 * sizeof(float));
    std::memcpy(static_cast<void*>(&all), ray, sizeof all);
    return prepare_kernel_ray(all, largest, prepared);
}

// [exact_lane]
void exact_lane(const KernelRay& ray, const float* block, unsigned lane, KernelHit& best) {
    const auto corner = [&](unsigned c) {
        const float* const x = block + 3 * c * TriangleBlock::size + lane;
        return Point3(x[0], x[TriangleBlock::size], x[2 * TriangleBlock::size]);
    };
    const Triangle triangle{corner(0), corner(1), corner(2)};
    const Ray exact{{ray.origin[0], ray.origin[1], ray.origin[2]},
                    {ray.direction[0], ray.direction[1], ray.direction[2]},
                    ray.tmin,
                    ray.tmax};
    if (auto hit = FilteredExact::intersect(exact, triangle)) {
        std::memcpy(&hit->triangle, block + 9 * TriangleBlock::size + lane, sizeof hit->triangle);
        if (nearer(*hit, {.t = best.t, .triangle = best.triangle}))
            best = {hit->t, hit->u, hit->v, hit->triangle};
    }
}
// [exact_lane]

}  // namespace space
