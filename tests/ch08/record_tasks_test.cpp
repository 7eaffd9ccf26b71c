// Recorded builds: the graph is the tree.
#include "chapters/ch08_parallel_builds/record_tasks.hpp"

#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <string>
#include <vector>

namespace space {
namespace {

constexpr NodeCost per_triangle{.node = 0.0, .triangle = 1.0, .bin = 0.0};

/// The same shape, node after node in the order of the walk.
void check_same_tree(const TaskGraph& graph, const BvhNodes<3>& tree) {
    REQUIRE(graph.nodes.size() == tree.size());
    std::vector<std::uint32_t> waiting;
    if (!graph.nodes.empty()) waiting.push_back(0);
    tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const TaskNode& task = graph.nodes[waiting.back()];
        waiting.pop_back();
        REQUIRE(task.is_leaf() == tree.nodes[index].is_leaf());
        REQUIRE(task.depth == depth);
        if (task.is_leaf()) {
            REQUIRE(task.triangles == tree.nodes[index].count);
        } else {
            const TaskNode &first = graph.nodes[task.first], &second = graph.nodes[task.first + 1];
            REQUIRE(task.triangles == first.triangles + second.triangles);
            waiting.push_back(task.first + 1);
            waiting.push_back(task.first);
        }
    });
}

}  // namespace

TEST_CASE("the graph of a build has the tree's nodes, each after its parent") {
    for (const std::string name : {"stadium", "soup:2000", "icosphere:4", "slivers"}) {
        CAPTURE(name);
        const auto triangles = make_scene(name, 1, true).mesh.triangles();
        const TaskGraph graph = counted_tasks<3>(triangles, per_triangle);
        check_same_tree(graph, BinnedBuilder::build<3>(triangles));
        for (std::uint32_t i = 0; i < graph.nodes.size(); ++i)
            REQUIRE((graph.nodes[i].is_leaf() || graph.nodes[i].first > i));
    }
}

TEST_CASE("a build of nothing has no tasks, one of a triangle has one") {
    CHECK(counted_tasks<3>({}, per_triangle).nodes.empty());
    CHECK(timed_tasks({}, 2).nodes.empty());
    const std::vector<Triangle> one{{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)}};
    const TaskGraph graph = counted_tasks<3>(one, {.node = 5.0, .triangle = 2.0, .bin = 100.0});
    REQUIRE(graph.nodes.size() == 1);
    CHECK(graph.nodes[0].cost == 5.0 + 2.0);  // a leaf compares no bins
}

TEST_CASE("the timed graph is the same tree, and no cost is negative") {
    const auto triangles = make_scene("stadium", 1, true).mesh.triangles();
    const TaskGraph graph = timed_tasks(triangles, 3);
    check_same_tree(graph, BinnedBuilder::build<3>(triangles));
    for (const TaskNode& node : graph.nodes) REQUIRE(node.cost >= 0.0);
    CHECK(graph.boxing > 0.0);
}

TEST_CASE("a formula's costs are fitted by that formula") {
    const auto triangles = make_scene("soup:3000").mesh.triangles();
    const NodeCost cost{.node = 100.0, .triangle = 20.0, .bin = 7.0};
    const CostFormula fit = fitted_cost(counted_tasks<3>(triangles, cost));
    CHECK(fit.cost.node == Approx(cost.node).epsilon(1e-6));
    CHECK(fit.cost.triangle == Approx(cost.triangle).epsilon(1e-6));
    CHECK(fit.cost.bin == Approx(cost.bin).epsilon(1e-6));
    CHECK(fit.largest_error < 1e-9);
}

TEST_CASE("costs of subtrees and the critical path add up what stands below") {
    // Costs 1, 2 3, and 4 5 below the second.
    const TaskGraph graph{.nodes = {{.cost = 1.0, .first = 1},
                                    {.cost = 2.0},
                                    {.cost = 3.0, .first = 3},
                                    {.cost = 4.0},
                                    {.cost = 5.0}},
                          .boxing = 10.0,
                          .joining = 20.0};
    CHECK(subtree_costs(graph) == std::vector<double>{15.0, 2.0, 12.0, 4.0, 5.0});
    CHECK(critical_path(graph) == 10.0 + (1.0 + 3.0 + 5.0) + 20.0);
    CHECK(graph.total() == 45.0);
}

}  // namespace space
