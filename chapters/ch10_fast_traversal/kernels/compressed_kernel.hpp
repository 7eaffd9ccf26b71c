/// @file
/// Walks through compressed trees: the text of wide_kernel.hpp with another layout.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

/// Eight bytes as floats.
SPACE_INLINE Float8 floats_of_bytes(const char* bytes) {
#if defined SPACE_X86 && defined __AVX2__
    return _mm256_cvtepi32_ps(
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes))));
#else
    typedef uint8_t Bytes8 __attribute__((vector_size(8), may_alias));
    const Bytes8 all = *reinterpret_cast<const Bytes8*>(bytes);
    return __builtin_convertvector(__builtin_convertvector(all, Int8), Float8);
#endif
}

// [compressed_slab]
/// As met_children, of planes as CompressedNode::plane computes them: bit for bit, fused or not.
SPACE_INLINE unsigned met_compressed(const char* node, const NodeRay<8>& ray, Float8 limit,
                                     Float8& enter) {
    const float* const origin = reinterpret_cast<const float*>(node);
    const uint8_t* const exponents = reinterpret_cast<const uint8_t*>(node + 12);
    const Float8 tiny = all<8>(0x1p-120f);
    Float8 near[3], far[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Float8 corner = all<8>(origin[axis]),
                     step = all<8>(__builtin_bit_cast(float, uint32_t(exponents[axis]) << 23));
        // Rows of floats have 32 bytes, rows of bytes have 8.
        const Float8 first = floats_of_bytes(node + 16 + ray.near_row[axis] / 4),
                     last = floats_of_bytes(node + 16 + ray.far_row[axis] / 4);
        near[axis] = (fused(first, step, corner) - ray.near_origin[axis]) * ray.near_scale[axis];
        far[axis] =
            fused(fused(last, step, corner) - ray.far_origin[axis], ray.far_scale[axis], tiny);
    }
    enter = larger(larger(near[0], near[1]), larger(near[2], ray.tmin));
    const unsigned used = (1u << exponents[3]) - 1;
    return used & at_most(enter, smaller(smaller(far[0], far[1]), smaller(far[2], limit)));
}
// [compressed_slab]

/// In a place without a triangle: no number, so the filter leaves it out.
constexpr float no_corner[4] = {__builtin_nanf(""), __builtin_nanf(""), __builtin_nanf(""),
                                __builtin_nanf("")};

/// A CompressedTree.
struct CompressedLayout {
    static constexpr int width = 8;
    static constexpr uint32_t index_mask = ~leaf_bit;
    static constexpr uint32_t strides[2]{96, 16};  ///< of a node and of a triangle
    static constexpr unsigned lines = 2;

    SPACE_INLINE static unsigned met(const KernelTree& tree, uint32_t child, const NodeRay<8>& ray,
                                     Float8 limit, Float8& enter, const uint32_t*& children) {
        const char* const node = tree.nodes + size_t(child) * 96;
        children = reinterpret_cast<const uint32_t*>(node + 64);
        return met_compressed(node, ray, limit, enter);
    }

    // [gathered_block]
    /// A leaf's triangles, gathered corner by corner into a block as wide trees have them.
    struct Leaf {
        alignas(32) float rows[10][4] = {};  // what is in an empty lane is reckoned with, too
        const char* block;
        const char* triangles;  ///< that are left; none after the last
        const float* corners;
        bool is_left = true;

        SPACE_INLINE Leaf(const KernelTree& tree, uint32_t child)
            : block(reinterpret_cast<const char*>(rows)),
              triangles(tree.blocks + size_t(child & ~leaf_bit) * 16),
              corners(tree.corners) {
            gather();
        }
        SPACE_INLINE bool has_block() const { return is_left; }
        SPACE_INLINE void take_next() {
            is_left = triangles != nullptr;
            if (is_left) gather();
        }

      private:
        SPACE_INLINE void gather() {
            const float* at[3][4];
            for (unsigned lane = 0; lane < 4; ++lane) {
                if (triangles == nullptr) {
                    for (auto& corner : at) corner[lane] = no_corner;
                    continue;
                }
                const uint32_t* const words = reinterpret_cast<const uint32_t*>(triangles);
                for (unsigned corner = 0; corner < 3; ++corner)
                    at[corner][lane] = corners + 3 * size_t(words[corner]);
                reinterpret_cast<uint32_t*>(rows[9])[lane] = words[3] & ~leaf_bit;
                triangles = (words[3] & leaf_bit) != 0 ? nullptr : triangles + 16;
            }
            for (unsigned corner = 0; corner < 3; ++corner) turn(at[corner], rows + 3 * corner);
        }
        /// Four corners, of which each is read with the float behind it: their x, their y, their z.
        SPACE_INLINE static void turn(const float* const (&at)[4], float (*to)[4]) {
            const Float4 a = load_any(at[0]), b = load_any(at[1]), c = load_any(at[2]),
                         d = load_any(at[3]);
            const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                         cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
            store(to[0], __builtin_shufflevector(ab, cd, 0, 1, 4, 5));
            store(to[1], __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
            store(to[2],
                  __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 3, 7),
                                          __builtin_shufflevector(c, d, 2, 6, 3, 7), 0, 1, 4, 5));
        }
    };
    // [gathered_block]
};

KernelAnswer closest_compressed(const KernelTree& tree, const float* ray, KernelHit& best) {
    return closest_hit<CompressedLayout>(tree, ray, best);
}
KernelAnswer any_compressed(const KernelTree& tree, const float* ray) {
    return any_hit<CompressedLayout>(tree, ray);
}

}  // namespace
}  // namespace space::SPACE_ISA
