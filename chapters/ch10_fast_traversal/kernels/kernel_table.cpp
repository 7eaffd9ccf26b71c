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
/// Let u = 2^-24. A plane at p across an axis is met at T = (p - o) / d. The kernels compute
/// t = p r - o r, where r = (1 / d) (1 + a), |a| <= u, with a fused multiply-add, or with a product
/// and a sum.
///
/// With c, the product o r rounded, and a margin m that both are given: fused, t = (p r - o r (1 +
/// b) -+ m) (1 + e), |b|, |e| <= u. So b costs at most u |o r|, whatever p is. Not fused, p r has a
/// rounding of its own: u |p r| <= u |T| (1 + u) + u |o r|, which is a u more of T and of o r. The
/// shift, c and m in one float, is rounded, too: u (|o r| + m). So m = 4 u |o r| covers all of that
/// and the rounding of itself, and of T there are three factors of 1 +- u in each t: of r, of p r
/// and of the sum. They shorten or lengthen t as chapter 2's reciprocals: (1 + u)^4 (1 - 6 u) < 1 <
/// (1 - u)^4 (1 + 6 u), the fourth being that of the scale itself. A t that is to be at most the
/// limit, a float, may be larger than it by u: 1 - 6 u serves for that, too.
///
/// In space, m moves a plane by 4 u |o|: as much as the origin's own last bits. Near an axis, where
/// r is large, that is still as little.
///
/// Products that underflow are off by 2^-149 at most: m is larger by 2^-140. Nothing overflows:
/// |d| >= 2^-90, so |r| <= 2^90 and |p r| <= 2^120.
///
/// A ray that is parallel to the planes (d = 0) takes r = 2^90, with which products are exact, and
/// for m a t beyond which it has left the box around all: inside the slab near planes then come
/// before 0 and far ones after all that can be hit, outside of it by the smallest difference that
/// floats have there, times 2^90, one does not.
bool prepare_kernel_ray(const Ray& ray, float largest, KernelRay& prepared) {
    constexpr float u = 0x1p-24f, slowest = 0x1p-90f, fastest = 0x1p30f;
    if (!(ray.tmin >= 0.0f && ray.tmin <= ray.tmax && largest <= largest_kernel_float))
        return false;
    float length = 0.0f, speed = 0.0f, reach = largest;
    bool is_parallel = false;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis], d = ray.direction[axis], size = std::abs(d);
        if (!(std::abs(o) <= largest_kernel_float && size <= fastest)) return false;
        if (!(size >= slowest)) {
            if (d != 0.0f) return false;
            is_parallel = true;
        }
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
        prepared.near_scale[axis] = r * (1.0f - 6.0f * u);
        prepared.far_scale[axis] = r * (1.0f + 6.0f * u);
        const float near = o * prepared.near_scale[axis], far = o * prepared.far_scale[axis];
        prepared.near_shift[axis] = -near - (4.0f * u * std::abs(near) + 0x1p-140f);
        prepared.far_shift[axis] = (4.0f * u * std::abs(far) + 0x1p-140f) - far;
        prepared.near_row[axis] = std::uint32_t(axis + (backwards ? 3 : 0));
        prepared.far_row[axis] = std::uint32_t(axis + (backwards ? 0 : 3));
        if (is_parallel && d == 0.0f) {
            const float beyond = std::max(8.0f * reach / speed, 4.0f * u * std::abs(o) / slowest);
            prepared.near_scale[axis] = prepared.far_scale[axis] = 1.0f / slowest;
            prepared.near_shift[axis] = -o / slowest - beyond;
            prepared.far_shift[axis] = -o / slowest + beyond;
        }
    }
    prepared.tmin = ray.tmin + 0.0f;  // not -0
    prepared.tmax = ray.tmax;
    prepared.limit = std::nextafter(ray.tmax, infinity);
    prepared.direction_length = length;
    return true;
}
// [prepare_kernel_ray]

// [exact_lane]
float exact_lane(const KernelRay& ray, const float* block, unsigned lane, KernelHit& best) {
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
        if (best.triangle == no_kernel_hit ||
            nearer(*hit, {.t = best.t, .triangle = best.triangle}))
            best = {hit->t, hit->u, hit->v, hit->triangle};
    }
    // A hit half a place farther may round to the same t and have the smaller index.
    return best.triangle == no_kernel_hit ? ray.limit
                                          : std::min(ray.limit, std::nextafter(best.t, infinity));
}
// [exact_lane]

}  // namespace space
