// The suite over the lazy tree, by every rule.
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"

#include "tests/suite/accelerator_suite.hpp"

#include <span>
#include <string_view>

namespace space {
namespace {

using Rule = LazyKdTreeConfig::Rule;

void check_suite(std::string_view name, const LazyKdTreeConfig& config) {
    check_accelerator<LazyKdTree<>>(
        name, [=](std::span<const Triangle> t) { return LazyKdTree<>::build(t, config); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("the suite: lazy k-d tree") {
    run_suite<LazyKdTree>("kd-lazy");
}

TEST_CASE("the suite: lazy k-d trees by middle and median, and with straddlers by their boxes") {
    check_suite("kd-lazy, middle", {.rule = Rule::middle});
    check_suite("kd-lazy, median", {.rule = Rule::median});
    check_suite("kd-lazy, unclipped", {.clips = false});
    check_suite("kd-lazy, no mailboxes", {.mailboxes = false});
}

}  // namespace space
