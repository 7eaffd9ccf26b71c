#include "chapters/ch04_kd_trees/kd_tree.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/suite/accelerator_suite.hpp"

using namespace space;
using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

TEST_CASE("the suite: k-d tree by the surface area heuristic") {
    run_suite<KdTree>("kd-sah");
}
