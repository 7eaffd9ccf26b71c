/// @file
/// Chapter 8's structures: chapter 7's tree over bins, built by several threads (--build-threads).
#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/parallel_morton_builder.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "chapters/ch12_comparison/structures/offer_bvh.hpp"

namespace space {

std::vector<Structure> ch08_structures() {
    return {
        offer_bvh<WorkStealingBuilder>("bvh-parallel",
                                       "bvh-binned, built by threads that steal (chapter 8)"),
        offer_bvh<ParallelMortonBuilder>("bvh-parallel-morton",
                                         "bvh-morton, built by such threads"),
        offer_bvh<AsymmetricBuilder>("bvh-asymmetric",
                                     "bvh-binned; new threads on the larger side only"),
        offer_bvh<SymmetricBuilder>("bvh-symmetric",
                                    "bvh-binned; half of the threads for each side"),
        offer_bvh<QueueBuilder>("bvh-queue", "bvh-binned; threads take nodes from a queue"),
    };
}

}  // namespace space
