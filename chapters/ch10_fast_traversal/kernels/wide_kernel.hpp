/// @file
/// The walk of one ray through a wide tree: the text of all kernels, compiled once for each
/// instruction set.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/exact_lanes.hpp"
#include "chapters/ch10_fast_traversal/kernels/leaf_filter.hpp"

namespace space::SPACE_ISA {
namespace {

constexpr uint32_t leaf_bit = UINT32_C(1) << 31;
constexpr size_t block_bytes = 160;

/// What nodes need of a ray: by axis, where near and far rows begin in a node, in bytes.
template <int N>
struct NodeRay {
    Floats<N> near_origin[3], near_scale[3], far_origin[3], far_scale[3], tmin;
    size_t near_row[3], far_row[3];
};
template <int N>
SPACE_INLINE NodeRay<N> node_ray_of(const KernelRay& ray) {
    NodeRay<N> r;
    for (int axis = 0; axis < 3; ++axis) {
        r.near_scale[axis] = all<N>(ray.near_scale[axis]);
        r.near_origin[axis] = all<N>(ray.near_origin[axis]);
        r.far_scale[axis] = all<N>(ray.far_scale[axis]);
        r.far_origin[axis] = all<N>(ray.far_origin[axis]);
        r.near_row[axis] = ray.near_row[axis] * (4 * N);
        r.far_row[axis] = ray.far_row[axis] * (4 * N);
    }
    r.tmin = all<N>(ray.tmin);
    return r;
}

/// The float after t, which is not negative.
SPACE_INLINE float float_after(float t) {
    return __builtin_bit_cast(float, __builtin_bit_cast(uint32_t, t + 0.0f) + 1);
}
/// The float before t, which is positive.
SPACE_INLINE float float_before(float t) {
    return __builtin_bit_cast(float, __builtin_bit_cast(uint32_t, t) - 1);
}

// [prepared]
/// As prepare_kernel_ray, all axes at once; that one is asked about what is rare: rays that are
/// parallel to an axis, and those that kernels refuse.
SPACE_INLINE bool prepared(const KernelTree& tree, const float* ray, KernelRay& result) {
    constexpr float u = 0x1p-24f;
    const Float4 o = load_any(ray), d = load_any(ray + 3), speed = size_of(d);  // and a float more
    const float tmin = ray[6], tmax = ray[7];
    const unsigned is_usual = at_most(size_of(o), all<4>(0x1p30f)) &
                              at_most(speed, all<4>(0x1p30f)) & at_most(all<4>(0x1p-90f), speed) &
                              7;
    if (!(is_usual == 7 && tmin >= 0.0f && tmin <= tmax && tree.largest <= 0x1p30f))
        return tree.prepare(ray, tree.largest, result);
    const Float4 r = 1.0f / d;
    store(result.origin, o);
    store(result.direction, d);
    store(result.near_origin, o);
    store(result.near_scale, r * (1.0f - 4.0f * u));
    store(result.far_origin, o);
    store(result.far_scale, r * (1.0f + 6.0f * u));
    const unsigned backwards = below_zero(d);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned turned = (backwards >> axis & 1u) * 3;
        result.near_row[axis] = axis + turned;
        result.far_row[axis] = axis + 3 - turned;
    }
    result.tmin = tmin + 0.0f;
    result.tmax = tmax;
    result.before = tmin > 0x1p-100f ? float_before(tmin) : -0x1p-110f;
    result.limit = tmax < __builtin_inff() ? float_after(tmax) : tmax;
    result.direction_length = speed[0] + speed[1] + speed[2];
    return true;
}
// [prepared]

// [wide_slab]
/// Which children the ray meets up to the limit, and where it enters each. (The last operand of
/// `larger` is what it gives for two zeros: tmin, which is not -0.)
template <int N>
SPACE_INLINE unsigned met_children(const char* node, const NodeRay<N>& ray, Floats<N> limit,
                                   Floats<N>& enter) {
    const Floats<N> tiny = all<N>(0x1p-120f);
    Floats<N> near[3], far[3];
    for (int axis = 0; axis < 3; ++axis) {
        near[axis] =
            (load<N>(node + ray.near_row[axis]) - ray.near_origin[axis]) * ray.near_scale[axis];
        far[axis] = fused(load<N>(node + ray.far_row[axis]) - ray.far_origin[axis],
                          ray.far_scale[axis], tiny);
    }
    enter = larger(larger(near[0], near[1]), larger(near[2], ray.tmin));
    return at_most(enter, smaller(smaller(far[0], far[1]), smaller(far[2], limit)));
}
// [wide_slab]

/// A child that waits, and where the ray enters it: one number, in whose order they are taken. (The
/// bits of floats that are not negative grow with them.)
SPACE_INLINE uint64_t waiting(float enter, uint32_t child) {
    return uint64_t(__builtin_bit_cast(uint32_t, enter)) << 32 | child;
}

// [branch_to_child]
/// children[place] by a branch to one of eight places in the program instead of an address that is
/// computed. The processor guesses where a branch goes: it then tests the next node while this
/// one's distances are still being compared. (An empty line of assembler for each keeps the
/// compiler from making one load of all.)
template <int N>
SPACE_INLINE uint32_t taken(const uint32_t* children, unsigned place) {
#define SPACE_TAKE(i)                       \
    case i: {                               \
        uint32_t child = children[(i) % N]; \
        asm("# child " #i : "+r"(child));   \
        return child;                       \
    }
    switch (place) {
        SPACE_TAKE(0)
        SPACE_TAKE(1)
        SPACE_TAKE(2)
        SPACE_TAKE(3)
        SPACE_TAKE(4)
        SPACE_TAKE(5)
        SPACE_TAKE(6)
        SPACE_TAKE(7)
        default:
            __builtin_unreachable();
    }
#undef SPACE_TAKE
}
// [branch_to_child]

/// Does nothing for a child that will wait.
struct NothingWaits {
    SPACE_INLINE void operator()(uint32_t) const {}
};
/// Asks for its cache lines.
template <class Layout>
struct FetchWaiting {
    const KernelTree& tree;

    SPACE_INLINE void operator()(uint32_t child) const {
        // By tables of two: whether it is a leaf, nobody could guess.
        const char* const begins[2]{tree.nodes, tree.blocks};
        const uint32_t is_leaf = child >> 31;
        const char* const place =
            begins[is_leaf] + size_t(child & Layout::index_mask) * Layout::strides[is_leaf];
        for (unsigned line = 0; line < Layout::lines; ++line) __builtin_prefetch(place + 64 * line);
    }
};

// [wide_order]
/// The nearest of the met children; the others go onto the stack, the nearest on top.
template <int N, class Waits = NothingWaits>
SPACE_INLINE uint32_t nearest_of(const uint32_t* children, unsigned met, Floats<N> enter,
                                 uint64_t*& top, Waits waits = {}) {
    const unsigned first = unsigned(__builtin_ctz(met));
    met &= met - 1;
    if (met == 0) return taken<N>(children, first);
    const unsigned second = unsigned(__builtin_ctz(met));
    met &= met - 1;
    alignas(32) float enters[N];
    *reinterpret_cast<Floats<N>*>(enters) = enter;
    uint64_t a = waiting(enters[first], children[first]),
             b = waiting(enters[second], children[second]);
    if (met == 0) {
        const bool swap = b < a;
        *top++ = swap ? a : b;
        waits(uint32_t(top[-1]));
        return taken<N>(children, swap ? second : first);
    }
    waits(uint32_t(a));
    waits(uint32_t(b));
    if (b < a) {
        const uint64_t c = a;
        a = b;
        b = c;
    }
    uint64_t* const bottom = top;
    *top++ = b;
    *top++ = a;
    while (met != 0) {
        const unsigned next = unsigned(__builtin_ctz(met));
        met &= met - 1;
        const uint64_t c = waiting(enters[next], children[next]);
        waits(uint32_t(c));
        uint64_t* place = top++;
        for (; place != bottom && place[-1] < c; --place) *place = place[-1];
        *place = c;
    }
    return uint32_t(*--top);
}
// [wide_order]

// [leaf_closest]
/// Puts the lanes that the filter has left to the exact test, and keeps the nearest hit; of equal t
/// that of the smaller index. @return the t beyond which nothing matters any more: a hit half a
/// place farther may round to the same t.
[[gnu::noinline]] float take_hits(const KernelTree& tree, const KernelRay& ray, const char* block,
                                  unsigned lanes, KernelHit& best) {
    const ExactLanes exact = exact_lanes(block, ray);
    for (unsigned hit = lanes & exact.hit; hit != 0; hit &= hit - 1) {
        const int lane = __builtin_ctz(hit);
        const uint32_t index = reinterpret_cast<const uint32_t*>(block + 144)[lane];
        const float t = exact.t[lane];
        if (t < best.t || (t == best.t && index < best.triangle))
            best = {t, exact.u[lane], exact.v[lane], index};
    }
    for (unsigned rare = lanes & exact.undecided; rare != 0; rare &= rare - 1)
        tree.exact(ray, reinterpret_cast<const float*>(block), unsigned(__builtin_ctz(rare)), best);
    const float after = float_after(best.t);
    return best.triangle != no_kernel_hit && after < ray.limit ? after : ray.limit;
}
// [leaf_closest]

// [leaf_any]
[[gnu::noinline]] bool is_any_hit(const KernelTree& tree, const KernelRay& ray, const char* block,
                                  unsigned lanes) {
    const ExactLanes exact = exact_lanes(block, ray);
    if ((lanes & exact.hit) != 0) return true;
    for (unsigned rare = lanes & exact.undecided; rare != 0; rare &= rare - 1) {
        KernelHit hit = nothing_yet;
        tree.exact(ray, reinterpret_cast<const float*>(block), unsigned(__builtin_ctz(rare)), hit);
        if (hit.triangle != no_kernel_hit) return true;
    }
    return false;
}
// [leaf_any]

// [wide_layout]
/// Where nodes and leaves of a WideTree<N> stand: what a walk asks of any layout.
template <int N>
struct WideLayout {
    static constexpr int width = N;
    static constexpr uint32_t index_mask = 0x0fffffff;
    static constexpr uint32_t strides[2]{N * 32, block_bytes};  ///< of a node and of a block
    static constexpr unsigned lines = N / 2;

    /// The children that the ray meets, and their words.
    SPACE_INLINE static unsigned met(const KernelTree& tree, uint32_t child, const NodeRay<N>& ray,
                                     Floats<N> limit, Floats<N>& enter, const uint32_t*& children) {
        const char* const node = tree.nodes + child * (size_t(N) * 32);
        children = reinterpret_cast<const uint32_t*>(node + 24 * N);
        return met_children<N>(node, ray, limit, enter);
    }
    /// A leaf's blocks, one after the other.
    struct Leaf {
        const char* block;
        unsigned count;

        SPACE_INLINE Leaf(const KernelTree& tree, uint32_t child)
            : block(tree.blocks + (child & 0x0fffffff) * block_bytes),
              count((child >> 28 & 7) + 1) {}
        SPACE_INLINE bool has_block() const { return count > 0; }
        SPACE_INLINE void take_next() {
            block += block_bytes;
            --count;
        }
    };
};
// [wide_layout]

// [wide_walk]
template <class Layout>
SPACE_INLINE KernelAnswer closest_hit(const KernelTree& tree, const float* floats,
                                      KernelHit& best) {
    constexpr int N = Layout::width;
    KernelRay ray;
    if (!prepared(tree, floats, ray)) return kernel_refuses;
    const NodeRay<N> node_ray = node_ray_of<N>(ray);
    const FetchWaiting<Layout> waits{tree};
    float ends = ray.limit;
    Floats<N> limit = all<N>(ray.limit);
    uint64_t* const bottom =
        static_cast<uint64_t*>(__builtin_alloca(tree.stack_size * sizeof(uint64_t)));
    uint64_t* top = bottom;
    uint32_t child = tree.root;
    for (;;) {
        bool is_over = false;
        while ((child & leaf_bit) == 0) {
            const uint32_t* children;
            Floats<N> enter;
            const unsigned met = Layout::met(tree, child, node_ray, limit, enter, children);
            if (met == 0) {
                is_over = true;
                break;
            }
            child = nearest_of<N>(children, met, enter, top, waits);
        }
        if (!is_over) {
            for (typename Layout::Leaf leaf(tree, child); leaf.has_block(); leaf.take_next()) {
                const unsigned lanes = filter_leaf<false>(leaf.block, ray, ends).may_hit;
                if (lanes == 0) continue;
                ends = take_hits(tree, ray, leaf.block, lanes, best);
                limit = all<N>(ends);
            }
        }
        const uint32_t limit_bits = __builtin_bit_cast(uint32_t, limit[0]);
        do {
            if (top == bottom) return best.triangle != no_kernel_hit ? kernel_hit : kernel_miss;
            --top;
        } while (uint32_t(*top >> 32) > limit_bits);
        child = uint32_t(*top);
    }
}
// [wide_walk]

// [wide_any]
/// Any hit ends it, so the order matters less: the first child that is met is taken by a branch,
/// the others wait.
template <class Layout>
SPACE_INLINE KernelAnswer any_hit(const KernelTree& tree, const float* floats) {
    constexpr int N = Layout::width;
    KernelRay ray;
    if (!prepared(tree, floats, ray)) return kernel_refuses;
    const NodeRay<N> node_ray = node_ray_of<N>(ray);
    const FetchWaiting<Layout> waits{tree};
    const Floats<N> limit = all<N>(ray.limit);
    uint32_t* const bottom =
        static_cast<uint32_t*>(__builtin_alloca(tree.stack_size * sizeof(uint32_t)));
    uint32_t* top = bottom;
    uint32_t child = tree.root;
    for (;;) {
        bool is_over = false;
        while ((child & leaf_bit) == 0) {
            const uint32_t* children;
            Floats<N> enter;
            const unsigned met = Layout::met(tree, child, node_ray, limit, enter, children);
            if (met == 0) {
                is_over = true;
                break;
            }
            for (unsigned others = met & (met - 1); others != 0; others &= others - 1) {
                *top++ = children[__builtin_ctz(others)];
                waits(top[-1]);
            }
            child = taken<N>(children, unsigned(__builtin_ctz(met)));
        }
        if (!is_over) {
            for (typename Layout::Leaf leaf(tree, child); leaf.has_block(); leaf.take_next()) {
                const LeafLanes lanes = filter_leaf<true>(leaf.block, ray, ray.limit);
                if (lanes.must_hit != 0) return kernel_hit;
                if (lanes.may_hit != 0 && is_any_hit(tree, ray, leaf.block, lanes.may_hit))
                    return kernel_hit;
            }
        }
        if (top == bottom) return kernel_miss;
        child = *--top;
    }
}
// [wide_any]

KernelAnswer closest4(const KernelTree& tree, const float* ray, KernelHit& best) {
    return closest_hit<WideLayout<4>>(tree, ray, best);
}
KernelAnswer closest8(const KernelTree& tree, const float* ray, KernelHit& best) {
    return closest_hit<WideLayout<8>>(tree, ray, best);
}
KernelAnswer any4(const KernelTree& tree, const float* ray) {
    return any_hit<WideLayout<4>>(tree, ray);
}
KernelAnswer any8(const KernelTree& tree, const float* ray) {
    return any_hit<WideLayout<8>>(tree, ray);
}

}  // namespace

extern const KernelTable table4, table8;
const KernelTable table4{closest4, any4}, table8{closest8, any8};

}  // namespace space::SPACE_ISA
