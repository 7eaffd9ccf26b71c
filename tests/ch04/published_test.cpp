// Lichter23's tree as published, and cured.
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"

#include "tests/suite/accelerator_suite.hpp"

using namespace space;

TEST_CASE("the suite: the published k-d tree with all its cures") {
    run_suite<PublishedKdTree>("kd-published, cured", PublishedKdTreeConfig::cured());
}
