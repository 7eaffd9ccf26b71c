// What is true of all schedules: properties, on random trees that shrink.
#include "tests/catch.hpp"
#include "tests/ch08/schedules.hpp"

#include <rapidcheck.h>

#include <cstdlib>
#include <vector>

namespace space {
namespace {

using Kind = ParallelMethod::Kind;
using Condition = ParallelMethod::Condition;
using Doing = CoreRun::Doing;

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=400", 0);

/// Whole numbers, so that sums of costs are exact.
double some_cost() {
    return double(*rc::gen::inRange(0, 20));
}

/// A leaf of a random tree becomes an inner node, up to 60 times.
TaskGraph some_graph() {
    TaskGraph graph{
        .nodes = {{.cost = some_cost()}}, .boxing = some_cost(), .joining = some_cost()};
    const int cuts = *rc::gen::inRange(0, 60);
    for (int i = 0; i < cuts; ++i) {
        TaskNode& leaf = graph.nodes[*rc::gen::inRange<std::size_t>(0, graph.nodes.size())];
        if (!leaf.is_leaf()) continue;
        leaf.first = static_cast<std::uint32_t>(graph.nodes.size());
        const std::uint32_t depth = leaf.depth + 1;
        for (int child = 0; child < 2; ++child)
            graph.nodes.push_back({.cost = some_cost(), .depth = depth});
    }
    for (std::size_t i = graph.nodes.size(); i-- > 0;) {
        TaskNode& node = graph.nodes[i];
        node.triangles = 1;
        if (!node.is_leaf())
            node.triangles =
                graph.nodes[node.first].triangles + graph.nodes[node.first + 1].triangles;
    }
    return graph;
}

ParallelMethod some_method() {
    return {
        .kind = *rc::gen::element(Kind::asymmetric, Kind::symmetric, Kind::queue, Kind::stealing),
        .condition =
            *rc::gen::element(Condition::threads, Condition::twice_threads,
                              Condition::threads_to_threads, Condition::depth, Condition::combined),
        .deepest = *rc::gen::inRange(0u, 6u),
        .big_scene = *rc::gen::inRange<std::size_t>(0, 60),
        .large = *rc::gen::inRange<std::size_t>(0, 80),
        .chunk = *rc::gen::inRange<std::size_t>(1, 30),
        .grain = *rc::gen::inRange<std::size_t>(0, 20)};
}

/// Quarters and halves: exact, too.
SchedulingCosts some_costs() {
    const double start = some_cost() / 4, lock = some_cost() / 4, steal = some_cost() / 4;
    const double serial = double(*rc::gen::inRange(0, 4)) / 4;
    return {.thread_start = start, .lock = lock, .steal = steal, .serial_share = serial};
}

}  // namespace

TEST_CASE("property: each node is made once, after its parent, and no core does two things") {
    CHECK(rc::check([] {
        const TaskGraph graph = some_graph();
        SchedulingCosts costs = some_costs();
        costs.bandwidth_share = double(*rc::gen::inRange(0, 5)) / 4;
        const auto cores = *rc::gen::inRange(1u, 20u);
        RC_ASSERT(faults_of(simulate(graph, some_method(), cores, costs), graph) == "");
    }));
}

TEST_CASE("property: work is conserved, and no schedule is shorter than its share of it") {
    CHECK(rc::check([] {
        const TaskGraph graph = some_graph();
        const auto cores = *rc::gen::inRange(1u, 20u);
        const Schedule schedule = simulate(graph, some_method(), cores, some_costs());
        double work = 0.0;
        for (const CoreRun& run : schedule.runs)
            if (is_work(run.doing)) work += run.end - run.begin;
        // Chunks bring their cost of stealing with them, and shares of work that are rounded.
        RC_ASSERT(work >= graph.total() * (1.0 - 0x1p-40));
        RC_ASSERT(schedule.makespan * cores >= graph.total() * (1.0 - 0x1p-40));
        RC_ASSERT(schedule.idle() >= -graph.total() * 0x1p-40);
    }));
}

TEST_CASE("property: no schedule is shorter than the critical path, where nodes are not divided") {
    CHECK(rc::check([] {
        TaskGraph graph = some_graph();
        graph.boxing = graph.joining = 0.0;
        ParallelMethod method = some_method();
        method.large = 1'000;
        const auto cores = *rc::gen::inRange(1u, 20u);
        const Schedule schedule = simulate(graph, method, cores, some_costs());
        RC_ASSERT(schedule.makespan >= critical_path(graph));
        double work = 0.0;
        for (const CoreRun& run : schedule.runs)
            work += is_work(run.doing) ? run.end - run.begin : 0;
        RC_ASSERT(work == graph.total());
    }));
}

TEST_CASE("property: one core takes the sum, and cores that nothing delays no longer than that") {
    CHECK(rc::check([] {
        const TaskGraph graph = some_graph();
        const ParallelMethod method = some_method();
        RC_ASSERT(simulate(graph, method, 1).makespan == graph.total());
        const auto cores = *rc::gen::inRange(2u, 20u);
        RC_ASSERT(simulate(graph, method, cores).makespan <= graph.total() * (1.0 + 0x1p-40));
    }));
}

}  // namespace space
