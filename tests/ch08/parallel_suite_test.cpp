// The suite over a tree that three threads have made; others' trees are held against it.
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <span>

namespace space {

TEST_CASE("the suite: a tree by threads that steal") {
    using ParallelBvh = Bvh<WorkStealingBuilder, FilteredExact>;
    ParallelBvh::Config config;
    config.threads = 3, config.large = 64, config.chunk = 16, config.grain = 8;
    check_accelerator<ParallelBvh>(
        "bvh-parallel",
        [=](std::span<const Triangle> triangles) { return ParallelBvh::build(triangles, config); },
        SuiteOptions{}.fewer());
}

}  // namespace space
