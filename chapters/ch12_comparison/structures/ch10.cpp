/// @file
/// Chapter 10's structures: the fastest for one ray at a time, and its parts.
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"
#include "chapters/ch12_comparison/structures/packets.hpp"

namespace space {
namespace {

template <TriangleTest Test>
using FastFourBvh = WideBvh<4, QuickBuilder, Test>;

/// With the walk for packets over the exact test.
Structure with_packets(Structure structure) {
    structure.variants.front().build_from_triangles = [](std::span<const Triangle> triangles,
                                                         const BuildOptions&) {
        return erased_with_packets(FastBvh<>::build(triangles));
    };
    return structure;
}

}  // namespace

std::vector<Structure> ch10_structures() {
    return {
        with_packets(offer<FastBvh>("fast", "eight children a node, SIMD, exact (chapter 10)")),
        offer<FastBvh>(
            "fast-scalar", "the same in plain C++",
            [](auto& config, const Limits&) { config.instructions = InstructionSet::scalar; }),
        offer<FastFourBvh>("fast-4", "four children a node"),
        offer<FastBvh>("fast-8", "eight, as fast"),
        offer<CompressedBvh>("fast-compressed", "eight, in 8-bit planes: half of the memory"),
        offer<FastHighBvh>("fast-hq", "fast over spatial splits and reinsertion: a slow build"),
    };
}

}  // namespace space
