/// @file
/// Chapter 8's structures: chapter 7's tree over bins, built by several threads (--build-threads).
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/parallel_morton_builder.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {
namespace {

template <TriangleTest Test>
using ParallelBvh = Bvh<WorkStealingBuilder, Test>;
template <TriangleTest Test>
using ParallelMortonBvh = Bvh<ParallelMortonBuilder, Test>;
template <TriangleTest Test>
using AsymmetricBvh = Bvh<AsymmetricBuilder, Test>;
template <TriangleTest Test>
using SymmetricBvh = Bvh<SymmetricBuilder, Test>;
template <TriangleTest Test>
using QueueBvh = Bvh<QueueBuilder, Test>;

}  // namespace

std::vector<Structure> ch08_structures() {
    return {
        offer<ParallelBvh>("bvh-parallel", "bvh-binned, built by threads that steal (chapter 8)"),
        offer<ParallelMortonBvh>("bvh-parallel-morton", "bvh-morton, built by such threads"),
        offer<AsymmetricBvh>("bvh-asymmetric", "bvh-binned; new threads on the larger side only"),
        offer<SymmetricBvh>("bvh-symmetric", "bvh-binned; half of the threads for each side"),
        offer<QueueBvh>("bvh-queue", "bvh-binned; threads take nodes from a queue"),
    };
}

}  // namespace space
