// The suite over every rule and every way with straddlers.
#include "chapters/ch04_kd_trees/kd_tree.hpp"

#include "tests/suite/accelerator_suite.hpp"

#include <algorithm>
#include <string>

namespace space {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

void check_suite(std::string_view name, const KdTreeConfig& config, SuiteOptions options = {}) {
    check_accelerator<KdTree<>>(
        name, [=](std::span<const Triangle> t) { return KdTree<>::build(t, config); },
        options.fewer());
}

}  // namespace

TEST_CASE("the suite: k-d tree by the surface area heuristic, straddlers clipped") {
    run_suite<KdTree>("kd-sah");
}

TEST_CASE("the suite: k-d trees by middle and median, by every way with straddlers") {
    for (const auto& [rule, rule_name] :
         {std::pair{Rule::middle, "kd-middle"}, std::pair{Rule::median, "kd-median"}})
        for (const auto& [straddlers, name] :
             {std::pair{Straddlers::clip, "clipped"},
              std::pair{Straddlers::duplicate, "duplicated"}, std::pair{Straddlers::keep, "kept"}})
            check_suite(fmt::format("{}, {}", rule_name, name),
                        {.rule = rule, .straddlers = straddlers});
}

TEST_CASE("the suite: k-d trees by area, straddlers duplicated or kept") {
    check_suite("kd-sah, duplicated", {.straddlers = Straddlers::duplicate});
    check_suite("kd-sah, kept", {.straddlers = Straddlers::keep});
}

TEST_CASE("the suite: k-d tree without mailboxes, and with leaves as small as can be") {
    check_suite("kd-sah, no mailboxes", {.mailboxes = false});
    check_suite("kd-sah, tests are dear", {.costs = {.traversal = 0.01, .intersection = 10.0}});
}

}  // namespace space
