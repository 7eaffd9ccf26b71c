/// @file
/// Rays side by side: a node is fetched once for a packet of up to 64 rays, and a triangle is
/// tested against as many as a register holds.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

// As many floats, or half as many doubles, as a register of this instruction set holds.
#if defined SPACE_X86 && defined __AVX512F__
constexpr unsigned ray_lanes = 16;
#elif defined SPACE_X86 && defined __AVX2__
constexpr unsigned ray_lanes = 8;
#else
constexpr unsigned ray_lanes = 4;
#endif
constexpr unsigned half_lanes = ray_lanes / 2;
typedef float RayFloats __attribute__((vector_size(4 * ray_lanes), may_alias));
typedef float HalfFloats __attribute__((vector_size(4 * half_lanes), may_alias));
typedef double RayDoubles __attribute__((vector_size(4 * ray_lanes), may_alias));

#if defined SPACE_X86 && defined __AVX512F__
SPACE_INLINE RayFloats larger(RayFloats a, RayFloats b) {
    return _mm512_max_ps(a, b);
}
SPACE_INLINE RayFloats smaller(RayFloats a, RayFloats b) {
    return _mm512_min_ps(a, b);
}
SPACE_INLINE RayFloats fused(RayFloats a, RayFloats b, RayFloats c) {
    return _mm512_fmadd_ps(a, b, c);
}
SPACE_INLINE unsigned at_most(RayFloats a, RayFloats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
SPACE_INLINE unsigned above(RayDoubles a, RayDoubles b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
}
SPACE_INLINE RayDoubles size_of(RayDoubles a) {
    return _mm512_abs_pd(a);
}
#elif !defined __AVX2__
SPACE_INLINE unsigned above(RayDoubles a, RayDoubles b) {
    return unsigned(a[0] > b[0]) | unsigned(a[1] > b[1]) << 1;
}
SPACE_INLINE RayDoubles size_of(RayDoubles a) {
    return a < 0.0 ? -a : a;
}
#endif
SPACE_INLINE double size_of(double a) {
    return __builtin_fabs(a);
}
#if defined SPACE_X86 && defined __AVX512F__
SPACE_INLINE void store_some(float* place, unsigned some, HalfFloats x) {
    _mm256_mask_storeu_ps(place, __mmask8(some), x);
}
#else
SPACE_INLINE void store_some(float* place, unsigned some, HalfFloats x) {
    for (unsigned i = 0; i < half_lanes; ++i)
        if ((some >> i & 1) != 0) place[i] = x[i];
}
#endif
#ifndef __AVX2__
SPACE_INLINE unsigned at_most(HalfFloats a, HalfFloats b) {
    return unsigned(a[0] <= b[0]) | unsigned(a[1] <= b[1]) << 1;
}
#endif
SPACE_INLINE HalfFloats half_at(const float* all) {
    return *reinterpret_cast<const HalfFloats*>(all);
}
SPACE_INLINE RayFloats rays_at(const float* all) {
    return *reinterpret_cast<const RayFloats*>(all);
}

/// A child that waits for some of the rays, none of which enters it before `enter`.
struct WaitingChild {
    uint64_t rays;
    float enter;
    uint32_t child;
};

/// What nodes need of all rays together.
struct PacketSpan {
    Float8 near_origin[3], far_origin[3], near_low[3], near_high[3], far_low[3], far_high[3], tmin;
    size_t near_row[3], far_row[3];
};
SPACE_INLINE PacketSpan span_of(const PacketRays& rays) {
    PacketSpan span;
    for (int axis = 0; axis < 3; ++axis) {
        span.near_origin[axis] = all<8>(rays.near_origin[axis]);
        span.far_origin[axis] = all<8>(rays.far_origin[axis]);
        span.near_low[axis] = all<8>(rays.near_low[axis]);
        span.near_high[axis] = all<8>(rays.near_high[axis]);
        span.far_low[axis] = all<8>(rays.far_low[axis]);
        span.far_high[axis] = all<8>(rays.far_high[axis]);
        span.near_row[axis] = rays.near_row[axis] * 32;
        span.far_row[axis] = rays.far_row[axis] * 32;
    }
    span.tmin = all<8>(rays.least_tmin);
    return span;
}

// [packet_span]
/// Which of a node's eight children any ray of the packet may meet: interval arithmetic. A near
/// plane is met no sooner than with the origin that is nearest to it and the reciprocal that gives
/// least. Rounding keeps the order of numbers, so what is computed from the ends of the ranges is
/// no more than what chapter 2's slab test computes for each ray, and that is conservative.
SPACE_INLINE unsigned children_met_by_any(const char* node, const PacketSpan& rays, Float8 limit,
                                          Float8& enter) {
    Float8 near[3], far[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Float8 first = load<8>(node + rays.near_row[axis]) - rays.near_origin[axis],
                     last = load<8>(node + rays.far_row[axis]) - rays.far_origin[axis];
        near[axis] = smaller(first * rays.near_low[axis], first * rays.near_high[axis]);
        far[axis] = larger(last * rays.far_low[axis], last * rays.far_high[axis]);
    }
    enter = larger(larger(near[0], near[1]), larger(near[2], rays.tmin));
    const Float8 leave = smaller(smaller(far[0], far[1]), far[2]) + 0x1p-140f;
    return at_most(enter, smaller(leave, limit));
}
// [packet_span]

// [packet_slab]
/// Which of these rays meet one child, whose planes all rays share: chapter 2's conservative test.
template <bool has_one_origin>
SPACE_INLINE uint64_t rays_that_meet(const char* node, unsigned child, const PacketRays& rays,
                                     const PacketSpan& span, uint64_t some) {
    uint64_t met = 0;
    for (unsigned first = 0; first < rays.count; first += ray_lanes) {
        if ((some >> first & ((UINT64_C(1) << ray_lanes) - 1)) == 0) continue;
        RayFloats near[3], far[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float near_plane =
                            reinterpret_cast<const float*>(node + span.near_row[axis])[child],
                        far_plane =
                            reinterpret_cast<const float*>(node + span.far_row[axis])[child];
            const RayFloats shorter = rays_at(rays.near_inverse[axis] + first),
                            longer = rays_at(rays.far_inverse[axis] + first);
            if (has_one_origin) {
                near[axis] = (near_plane - rays.near_origin[axis]) * shorter;
                far[axis] = (far_plane - rays.near_origin[axis]) * longer;
            } else {
                const RayFloats origin = rays_at(rays.origin[axis] + first);
                near[axis] = (near_plane - origin) * shorter;
                far[axis] = (far_plane - origin) * longer;
            }
        }
        const RayFloats enter =
            larger(larger(near[0], near[1]), larger(near[2], rays_at(rays.tmin + first)));
        const RayFloats leave = smaller(smaller(far[0], far[1]), far[2]) + 0x1p-140f;
        met |= uint64_t(at_most(enter, smaller(leave, rays_at(rays.limit + first)))) << first;
    }
    return met & some;
}
// [packet_slab]

/// A triangle as chapter 2's filter sees it.
struct PacketTriangle {
    double a[3], e1[3], e2[3], size1, size2;
    uint32_t index;
};
template <class Number>
SPACE_INLINE Number size_of_three(const Number* v) {
    return size_of(v[0]) + size_of(v[1]) + size_of(v[2]);
}
SPACE_INLINE PacketTriangle packet_triangle(const float* block, unsigned lane) {
    PacketTriangle triangle;
    for (unsigned axis = 0; axis < 3; ++axis) {
        triangle.a[axis] = double(block[4 * axis + lane]);
        triangle.e1[axis] = double(block[4 * (axis + 3) + lane]) - triangle.a[axis];
        triangle.e2[axis] = double(block[4 * (axis + 6) + lane]) - triangle.a[axis];
    }
    triangle.size1 = size_of_three(triangle.e1);
    triangle.size2 = size_of_three(triangle.e2);
    triangle.index = reinterpret_cast<const uint32_t*>(block)[36 + lane];
    return triangle;
}

// [packet_origin]
/// What hangs on the origin, and not on the direction: once for all rays where they have one origin
/// (Number is double), else for each (RayDoubles).
template <class Number>
struct PacketOrigin {
    Number s[3], q[3], size, volume, bound;
};
template <class Number>
SPACE_INLINE PacketOrigin<Number> packet_origin(const PacketTriangle& triangle,
                                                const Number (&origin)[3]) {
    const double(&e1)[3] = triangle.e1, (&e2)[3] = triangle.e2;
    PacketOrigin<Number> o;
    for (int axis = 0; axis < 3; ++axis) o.s[axis] = origin[axis] - triangle.a[axis];
    const Number(&s)[3] = o.s;
    o.q[0] = s[1] * e1[2] - e1[1] * s[2];
    o.q[1] = s[2] * e1[0] - e1[2] * s[0];
    o.q[2] = s[0] * e1[1] - e1[0] * s[1];
    o.size = size_of_three(o.s);
    o.volume = o.q[0] * e2[0] + o.q[1] * e2[1] + o.q[2] * e2[2];
    o.bound = triangle.size1 * triangle.size2 + (triangle.size1 + triangle.size2) * o.size;
    return o;
}
// [packet_origin]

/// How far x lies outside of the interval between 0 and `end`.
SPACE_INLINE RayDoubles outside_of(RayDoubles x, RayDoubles end) {
    const RayDoubles half = end * 0.5;
    return size_of(x - half) - size_of(half);
}

/// What chapter 2's filter says of some rays and one triangle.
struct PacketVerdict {
    unsigned hit, undecided;  ///< bits of the rays; others miss
    HalfFloats t, u, v;
};

// [packet_filter]
/// Operation by operation FilteredExact::intersect, so each bit is the same.
template <class Number>
SPACE_INLINE PacketVerdict packet_filter(const PacketTriangle& triangle,
                                         const PacketOrigin<Number>& o, const RayDoubles (&d)[3],
                                         RayDoubles length, unsigned some) {
    const double(&e1)[3] = triangle.e1, (&e2)[3] = triangle.e2;
    const RayDoubles bound = 10.0 * 0x1p-53 * length * o.bound;
    const RayDoubles p[3] = {d[1] * e2[2] - e2[1] * d[2], d[2] * e2[0] - e2[2] * d[0],
                             d[0] * e2[1] - e2[0] * d[1]};
    const RayDoubles det = p[0] * e1[0] + p[1] * e1[1] + p[2] * e1[2],
                     u = p[0] * o.s[0] + p[1] * o.s[1] + p[2] * o.s[2],
                     u_outside = outside_of(u, det);
    const RayDoubles v = o.q[0] * d[0] + o.q[1] * d[1] + o.q[2] * d[2],
                     v_outside = outside_of(v, det - u);
    PacketVerdict verdict;
    verdict.hit = 0;
    verdict.undecided = some & ~(above(u_outside, bound) | above(v_outside, bound));
    if (verdict.undecided == 0) return verdict;
    const unsigned inside = above(-bound, u_outside) & above(-bound, v_outside);
    const RayDoubles inverse = 1.0 / det, t = o.volume * inverse;
    const RayDoubles slack = 14.0 * 0x1p-53 * triangle.size1 * triangle.size2 *
                             (o.size + size_of(t) * length) * size_of(inverse);
    verdict.t = __builtin_convertvector(t - slack, HalfFloats);
    verdict.u = __builtin_convertvector(u * inverse, HalfFloats);
    verdict.v = __builtin_convertvector(v * inverse, HalfFloats);
    const HalfFloats latest = __builtin_convertvector(t + slack, HalfFloats);
    const unsigned common = at_most(verdict.t, latest) & at_most(latest, verdict.t);
    verdict.hit = verdict.undecided & inside & common;
    verdict.undecided &= ~verdict.hit;
    return verdict;
}
// [packet_filter]

/// The limit of boxes for a t; an infinite one has no float after it.
SPACE_INLINE float limit_after(float t) {
    return t < __builtin_inff() ? box_limit(float_after(t)) : t;
}
SPACE_INLINE void set_limit(PacketRays& rays, unsigned ray) {
    rays.limit[ray] = rays.is_any_asked ? -1.0f : limit_after(rays.t[ray]);
}

/// Hits that the filter is sure of, in the order of chapter 1's `nearer`. @return whether one
/// counts
SPACE_INLINE bool take_hits(PacketRays& rays, unsigned first, const PacketVerdict& verdict,
                            uint32_t index) {
    const HalfFloats t = verdict.t, before = half_at(rays.t + first);
    const unsigned in_time = verdict.hit & at_most(half_at(rays.tmin + first), t) &
                             at_most(t, half_at(rays.tmax + first)) & at_most(t, before);
    if (in_time == 0) return false;
    unsigned nearer = in_time;
    for (unsigned equal = in_time & at_most(before, t); equal != 0; equal &= equal - 1) {
        const unsigned i = unsigned(__builtin_ctz(equal));
        if (rays.triangle[first + i] <= index) nearer &= ~(1u << i);
    }
    store_some(rays.t + first, nearer, t);
    store_some(rays.u + first, nearer, verdict.u);
    store_some(rays.v + first, nearer, verdict.v);
    for (unsigned left = nearer; left != 0; left &= left - 1) {
        const unsigned ray = first + unsigned(__builtin_ctz(left));
        rays.triangle[ray] = index;
        set_limit(rays, ray);
    }
    return nearer != 0;
}

/// Rays that the filter leaves to the exact stages.
[[gnu::noinline]] bool ask_exactly(const float* block, unsigned lane, PacketRays& rays,
                                   unsigned first, unsigned some, ExactPacketLane exact) {
    bool is_changed = false;
    for (; some != 0; some &= some - 1) {
        const unsigned ray = first + unsigned(__builtin_ctz(some));
        const uint32_t before = rays.triangle[ray];
        exact(rays, ray, block, lane);
        if (rays.triangle[ray] == before) continue;
        set_limit(rays, ray);
        is_changed = true;
    }
    return is_changed;
}

/// One triangle against all these rays, half a register's at a time. @return whether any ray's
/// limit has changed
template <bool has_one_origin>
SPACE_INLINE bool test_triangle(const float* block, unsigned lane, PacketRays& rays, uint64_t some,
                                ExactPacketLane exact) {
    const PacketTriangle triangle = packet_triangle(block, lane);
    PacketOrigin<double> shared;
    if (has_one_origin)
        shared = packet_origin<double>(
            triangle,
            {double(rays.origin[0][0]), double(rays.origin[1][0]), double(rays.origin[2][0])});
    bool is_changed = false;
    for (unsigned first = 0; first < rays.count; first += half_lanes) {
        const unsigned here = unsigned(some >> first) & ((1u << half_lanes) - 1);
        if (here == 0) continue;
        RayDoubles d[3];
        for (int axis = 0; axis < 3; ++axis)
            d[axis] = __builtin_convertvector(half_at(rays.direction[axis] + first), RayDoubles);
        const RayDoubles length = size_of_three(d);
        PacketVerdict verdict;
        if (has_one_origin) {
            verdict = packet_filter(triangle, shared, d, length, here);
        } else {
            RayDoubles origin[3];
            for (int axis = 0; axis < 3; ++axis)
                origin[axis] =
                    __builtin_convertvector(half_at(rays.origin[axis] + first), RayDoubles);
            verdict = packet_filter(triangle, packet_origin<RayDoubles>(triangle, origin), d,
                                    length, here);
        }
        if (verdict.hit != 0) is_changed |= take_hits(rays, first, verdict, triangle.index);
        if (verdict.undecided != 0)
            is_changed |= ask_exactly(block, lane, rays, first, verdict.undecided, exact);
    }
    return is_changed;
}

// [packet_cull]
/// Which of a block's triangles any ray of the packet may hit, by its origin, which all share, and
/// the range of the directions. The volumes u, v and w = det - u - v are linear in the direction:
/// d . n, so each lies between the sums of the least and of the largest n d along each axis. A hit
/// has all three of one sign. Where one is below 0 for all rays, and another, or a third, above 0,
/// there is none. `bound` is leaf_filter.hpp's: of w's terms, too, none has ten roundings.
SPACE_INLINE unsigned triangles_met_by_any(const float* block, const PacketRays& rays) {
    Float4 a[3], e1[3], e2[3], s[3], n[3][3];
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = load<4>(block + 4 * axis);
        e1[axis] = load<4>(block + 4 * (axis + 3)) - a[axis];
        e2[axis] = load<4>(block + 4 * (axis + 6)) - a[axis];
        s[axis] = rays.near_origin[axis] - a[axis];
    }
    cross(e2, s, n[0]);
    cross(s, e1, n[1]);
    cross(e2, e1, n[2]);
    const Float4 n1 = one_norm(e1), n2 = one_norm(e2), ns = one_norm(s);
    const Float4 bound = 10.0f * 0x1p-24f * rays.longest * (n1 * n2 + (n1 + n2) * ns) + 0x1p-110f;
    for (int axis = 0; axis < 3; ++axis) n[2][axis] = n[2][axis] - n[0][axis] - n[1][axis];
    unsigned never_positive = 0, never_negative = 0;
    for (int volume = 0; volume < 3; ++volume) {
        Float4 least = all<4>(0.0f), most = least;
        for (int axis = 0; axis < 3; ++axis) {
            const Float4 low = n[volume][axis] * rays.direction_low[axis],
                         high = n[volume][axis] * rays.direction_high[axis];
            least = least + smaller(low, high);
            most = most + larger(low, high);
        }
        never_positive |= above(-bound, most);
        never_negative |= above(least, bound);
    }
    return 15u & ~(never_positive & never_negative);
}
// [packet_cull]

/// Those of some rays that are not over before `enter`.
SPACE_INLINE uint64_t rays_not_over(const PacketRays& rays, uint64_t some, float enter) {
    uint64_t left = 0;
    for (unsigned first = 0; first < rays.count; first += ray_lanes)
        left |= uint64_t(at_most(RayFloats{} + enter, rays_at(rays.limit + first))) << first;
    return left & some;
}
SPACE_INLINE float most_limit(const PacketRays& rays) {
    RayFloats most = rays_at(rays.limit);
    for (unsigned first = ray_lanes; first < rays.count; first += ray_lanes)
        most = larger(most, rays_at(rays.limit + first));
    float limit = most[0];
    for (unsigned i = 1; i < ray_lanes; ++i) limit = most[i] > limit ? most[i] : limit;
    return limit;
}

/// Up to so many rays a leaf's four triangles are tested for one ray after the other: a packet
/// whose rays have parted would test one triangle after the other, for lanes that are mostly empty.
constexpr unsigned few_rays = 3;

/// The same by the walk of single rays.
SPACE_INLINE bool test_leaf_singly(const KernelTree& tree, const char* block, PacketRays& rays,
                                   uint64_t some) {
    bool is_changed = false;
    for (; some != 0; some &= some - 1) {
        const unsigned i = unsigned(__builtin_ctzll(some));
        KernelRay& ray = rays.singles[i];
        if ((rays.prepared_singles >> i & 1) == 0) {
            prepared(tree, rays.rays + 8 * i, ray);
            rays.prepared_singles |= UINT64_C(1) << i;
        }
        KernelHit best{rays.t[i], rays.u[i], rays.v[i], rays.triangle[i]};
        const float after = float_after(best.t);
        const float ends = best.triangle != no_kernel_hit && after < ray.limit ? after : ray.limit;
        const unsigned lanes = filter_leaf<false>(block, ray, ends).may_hit;
        if (lanes == 0) continue;
        take_hits(tree, ray, block, lanes, best);
        if (best.triangle == rays.triangle[i]) continue;
        rays.t[i] = best.t;
        rays.u[i] = best.u;
        rays.v[i] = best.v;
        rays.triangle[i] = best.triangle;
        set_limit(rays, i);
        is_changed = true;
    }
    return is_changed;
}

/// A leaf's triangles, each against all rays that come to it.
template <bool has_one_origin>
SPACE_INLINE bool test_leaf(const KernelTree& tree, uint32_t child, PacketRays& rays, uint64_t some,
                            ExactPacketLane exact, PacketCounts& counts) {
    bool is_changed = false;
    const bool is_few = __builtin_popcountll(some) <= int(few_rays);
    const char* place = tree.blocks + (child & 0x0fffffff) * block_bytes;
    for (unsigned count = (child >> 28 & 7) + 1; count > 0; --count, place += block_bytes) {
        ++counts.blocks;
        if (is_few) {
            is_changed |= test_leaf_singly(tree, place, rays, some);
            continue;
        }
        const unsigned left =
            has_one_origin ? triangles_met_by_any(reinterpret_cast<const float*>(place), rays) : 15;
        for (unsigned lane = 0; lane < 4; ++lane) {
            if (reinterpret_cast<const uint32_t*>(place)[36 + lane] == ~UINT32_C(0)) break;
            if ((left >> lane & 1) == 0) continue;
            is_changed |= test_triangle<has_one_origin>(reinterpret_cast<const float*>(place), lane,
                                                        rays, some, exact);
        }
    }
    return is_changed;
}

/// The children of a node that rays meet, onto the stack, the one that is entered first on top.
template <bool has_one_origin>
SPACE_INLINE WaitingChild* push_children(const KernelTree& tree, uint32_t index,
                                         const PacketRays& rays, const PacketSpan& span,
                                         uint64_t some, float most, WaitingChild* top) {
    const FetchWaiting<WideLayout<8>> fetch{tree};
    const char* const node = tree.nodes + size_t(index) * 256;
    Float8 enter;
    unsigned met = children_met_by_any(node, span, all<8>(most), enter);
    if (met == 0) return top;
    alignas(32) float enters[8];
    *reinterpret_cast<Float8*>(enters) = enter;
    const uint32_t* const children = reinterpret_cast<const uint32_t*>(node + 192);
    WaitingChild* const bottom = top;
    for (; met != 0; met &= met - 1) {
        const unsigned child = unsigned(__builtin_ctz(met));
        const uint64_t meeting = rays_that_meet<has_one_origin>(node, child, rays, span, some);
        if (meeting == 0) continue;
        fetch(children[child]);
        WaitingChild* place = top++;
        for (; place != bottom && place[-1].enter < enters[child]; --place) *place = place[-1];
        *place = {meeting, enters[child], children[child]};
    }
    return top;
}

// [packets]
/// One walk for all rays of the packet: a node is for those that meet it.
template <bool has_one_origin>
[[gnu::noinline]] void walk_packet(const KernelTree& tree, PacketRays& rays, ExactPacketLane exact,
                                   PacketCounts& counts) {
    const PacketSpan span = span_of(rays);
    WaitingChild* const bottom =
        static_cast<WaitingChild*>(__builtin_alloca(tree.stack_size * sizeof(WaitingChild)));
    WaitingChild* top = bottom;
    *top++ = {~UINT64_C(0) >> (64 - rays.count), 0.0f, tree.root};
    float most = most_limit(rays);
    while (top != bottom) {
        const WaitingChild waiting = *--top;
        if (!(waiting.enter <= most)) continue;
        const uint64_t some = rays_not_over(rays, waiting.rays, waiting.enter);
        if (some == 0) continue;
        if ((waiting.child & leaf_bit) == 0) {
            ++counts.nodes;
            top = push_children<has_one_origin>(tree, waiting.child, rays, span, some, most, top);
        } else if (test_leaf<has_one_origin>(tree, waiting.child, rays, some, exact, counts)) {
            most = most_limit(rays);
        }
    }
}
// [packets]

/// The least and the largest of some floats.
struct Range {
    float low, high;
};
SPACE_INLINE Range range_of(const float* numbers, unsigned count) {
    Float4 low = load<4>(numbers), high = low;
    for (unsigned first = 4; first < count; first += 4) {
        low = smaller(low, load<4>(numbers + first));
        high = larger(high, load<4>(numbers + first));
    }
    Range range{low[0], high[0]};
    for (int i = 1; i < 4; ++i) {
        range.low = low[i] < range.low ? low[i] : range.low;
        range.high = high[i] > range.high ? high[i] : range.high;
    }
    return range;
}

/// Rays as they come, eight floats each, side by side. Places behind the last hold it again.
SPACE_INLINE void lay_side_by_side(PacketRays& rays, unsigned places) {
    for (unsigned i = 0; i < places; ++i) {
        const float* const ray = rays.rays + 8 * (i < rays.count ? i : rays.count - 1);
        for (int axis = 0; axis < 3; ++axis) {
            rays.origin[axis][i] = ray[axis];
            rays.direction[axis][i] = ray[axis + 3];
        }
        rays.tmin[i] = ray[6] + 0.0f;  // not -0
        rays.tmax[i] = ray[7];
    }
}

// [fill_packet]
/// What prepare_kernel_ray asks of a ray, of all, along one axis: floats in range, and one sign.
SPACE_INLINE bool prepare_axis(PacketRays& rays, int axis, unsigned places, float largest) {
    constexpr float u = 0x1p-24f, shorter = 1.0f - 4.0f * u, longer = 1.0f + 6.0f * u;
    const RayFloats most = RayFloats{} + largest, least = RayFloats{} + 0x1p-90f;
    const bool backwards = rays.direction[axis][0] < 0.0f;
    const RayFloats sign = RayFloats{} + (backwards ? -1.0f : 1.0f);
    constexpr unsigned everyone = (1u << ray_lanes) - 1;
    unsigned fit = everyone;
    for (unsigned first = 0; first < places; first += ray_lanes) {
        const RayFloats o = rays_at(rays.origin[axis] + first),
                        d = rays_at(rays.direction[axis] + first), speed = d * sign;
        // What is not a number fails each comparison.
        fit &= at_most(-most, o) & at_most(o, most) & at_most(least, speed) & at_most(speed, most);
        const RayFloats inverse = 1.0f / d;
        *reinterpret_cast<RayFloats*>(rays.near_inverse[axis] + first) = inverse * shorter;
        *reinterpret_cast<RayFloats*>(rays.far_inverse[axis] + first) = inverse * longer;
    }
    const Range origin = range_of(rays.origin[axis], places),
                direction = range_of(rays.direction[axis], places);
    rays.direction_low[axis] = direction.low;
    rays.direction_high[axis] = direction.high;
    rays.near_origin[axis] = backwards ? origin.low : origin.high;
    rays.far_origin[axis] = backwards ? origin.high : origin.low;
    // 1 / d falls as d grows, and rounding keeps the order: these are the inverses' ranges.
    const float low = 1.0f / direction.high, high = 1.0f / direction.low;
    rays.near_low[axis] = low * shorter;
    rays.near_high[axis] = high * shorter;
    rays.far_low[axis] = low * longer;
    rays.far_high[axis] = high * longer;
    rays.near_row[axis] = unsigned(axis) + (backwards ? 3 : 0);
    rays.far_row[axis] = unsigned(axis) + (backwards ? 0 : 3);
    rays.has_one_origin = rays.has_one_origin && origin.low == origin.high;
    rays.longest += backwards ? -direction.low : direction.high;
    return fit == everyone;
}
// [fill_packet]

/// The rest.
SPACE_INLINE bool prepare_packet(PacketRays& rays, float largest) {
    const unsigned places = (rays.count + ray_lanes - 1) / ray_lanes * ray_lanes;
    lay_side_by_side(rays, places);
    rays.longest = 0.0f;
    rays.prepared_singles = 0;
    rays.has_one_origin = true;
    bool is_fit = true;
    for (int axis = 0; axis < 3; ++axis) is_fit &= prepare_axis(rays, axis, places, largest);
    rays.least_tmin = range_of(rays.tmin, places).low;
    for (unsigned i = 0; i < places; ++i) {
        is_fit &= rays.tmin[i] >= 0.0f && rays.tmin[i] <= rays.tmax[i];
        rays.limit[i] = i < rays.count ? limit_after(rays.tmax[i]) : -1.0f;
        rays.t[i] = __builtin_inff();
        rays.triangle[i] = no_kernel_hit;
    }
    return is_fit;
}

bool trace_packet(const KernelTree& tree, PacketRays& rays, float largest, ExactPacketLane exact,
                  PacketCounts& counts) {
    if (!prepare_packet(rays, largest)) return false;
    if (rays.has_one_origin)
        walk_packet<true>(tree, rays, exact, counts);
    else
        walk_packet<false>(tree, rays, exact, counts);
    return true;
}

}  // namespace
}  // namespace space::SPACE_ISA
