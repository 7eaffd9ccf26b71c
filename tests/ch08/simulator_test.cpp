// Simulated builds: schedules that can be made by hand.
#include "chapters/ch08_parallel_builds/simulator.hpp"

#include "chapters/ch08_parallel_builds/amdahl.hpp"
#include "common/geometry.hpp"
#include "tests/catch.hpp"
#include "tests/ch08/schedules.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

namespace space {
namespace {

using Kind = ParallelMethod::Kind;
using Condition = ParallelMethod::Condition;
using Doing = CoreRun::Doing;

constexpr ParallelMethod asymmetric{.kind = Kind::asymmetric}, symmetric{.kind = Kind::symmetric},
    stealing{.kind = Kind::stealing, .grain = 0};
constexpr ParallelMethod queued(Condition condition) {
    return {.kind = Kind::queue, .condition = condition};
}
const std::vector<ParallelMethod> all_methods{asymmetric,
                                              symmetric,
                                              queued(Condition::threads),
                                              queued(Condition::twice_threads),
                                              queued(Condition::threads_to_threads),
                                              queued(Condition::depth),
                                              queued(Condition::combined),
                                              stealing};

double makespan(const TaskGraph& graph, const ParallelMethod& method, unsigned cores,
                const SchedulingCosts& costs = {}) {
    const Schedule schedule = simulate(graph, method, cores, costs);
    CHECK(faults_of(schedule, graph) == "");
    return schedule.makespan;
}

}  // namespace

TEST_CASE("one core takes the sum, by every method") {
    TaskGraph graph = balanced_tree(5, 16.0);
    graph.boxing = 3.0;
    graph.joining = 2.0;
    for (const ParallelMethod& method : all_methods)
        CHECK(makespan(graph, method, 1) == 5 * 16.0 + 3.0 + 2.0);
}

TEST_CASE("no method gains on a chain") {
    const TaskGraph graph = chain(6);
    for (const ParallelMethod& method : all_methods)
        for (const unsigned cores : {2u, 4u, 64u}) CHECK(makespan(graph, method, cores) == 6.0);
}

TEST_CASE("boxing is serial, but for work stealing; joining is divided") {
    const TaskGraph graph{.nodes = {{.cost = 1.0, .triangles = 1}}, .boxing = 8.0, .joining = 4.0};
    for (const ParallelMethod& method : all_methods)
        CHECK(makespan(graph, method, 4) ==
              (method.kind == Kind::stealing ? 8.0 / 4 : 8.0) + 1.0 + 4.0 / 4);
}

TEST_CASE("nothing to build takes no time") {
    for (const ParallelMethod& method : all_methods) CHECK(makespan({}, method, 4) == 0.0);
}

TEST_CASE("seven balanced nodes: the asymmetric method leaves one core half of them") {
    const TaskGraph graph = balanced_tree(3, 4.0);  // nodes cost 4, 2 2, 1 1 1 1
    CHECK(makespan(graph, symmetric, 4) == 4.0 + 2.0 + 1.0);
    CHECK(makespan(graph, asymmetric, 4) == 4.0 + (2.0 + 1.0 + 1.0));
    CHECK(makespan(graph, queued(Condition::depth), 4) == 4.0 + 2.0 + 1.0);
    CHECK(makespan(graph, stealing, 4) == 4.0 + 2.0 + 1.0);
    for (const ParallelMethod& method : all_methods)
        CHECK(makespan(graph, method, 2) == 4.0 + (2.0 + 1.0 + 1.0));
}

TEST_CASE("figure 16: each thread method wins on the kind of scene that suits it") {
    // Most of each node is on its right; on the left are leaves.
    TaskGraph lopsided;
    lopsided.nodes = {{.cost = 1.0, .triangles = 400, .first = 1},
                      {.cost = 1.0, .triangles = 100, .depth = 1},
                      {.cost = 1.0, .triangles = 300, .first = 3, .depth = 1},
                      {.cost = 9.0, .triangles = 100, .depth = 2},
                      {.cost = 1.0, .triangles = 200, .first = 5, .depth = 2},
                      {.cost = 8.0, .triangles = 100, .depth = 3},
                      {.cost = 8.0, .triangles = 100, .depth = 3}};
    // A thread for each level.
    CHECK(makespan(lopsided, asymmetric, 4) == 1.0 + 1.0 + (1.0 + 8.0));
    // Of three threads one may be started below a leaf, in vain: two are left for 28 of the work.
    CHECK(makespan(lopsided, symmetric, 4) == 1.0 + 1.0 + (1.0 + 8.0 + 8.0));
    CHECK(makespan(lopsided, queued(Condition::depth), 4) == 1.0 + 1.0 + (1.0 + 8.0));
    const TaskGraph balanced = balanced_tree(4, 8.0);
    CHECK(makespan(balanced, symmetric, 4) == 8.0 + 4.0 + (2.0 + 1.0 + 1.0));
    CHECK(makespan(balanced, asymmetric, 4) == 8.0 + (4.0 + 2 * 2.0 + 4 * 1.0));
}

TEST_CASE("a thread method's budget is spent on the larger side below the root") {
    TaskGraph graph = balanced_tree(4, 8.0);
    graph.nodes[1].triangles = 500;  // of the left child, and so the threads are started there
    graph.nodes[2].triangles = 300;
    for (std::size_t i : {5u, 6u, 11u, 12u, 13u, 14u}) graph.nodes[i].cost = 0.0;
    CHECK(makespan(graph, asymmetric, 8) == 8.0 + 4.0 + 2.0 + 2 * 1.0);
    std::swap(graph.nodes[1].triangles, graph.nodes[2].triangles);
    CHECK(makespan(graph, asymmetric, 8) == 8.0 + 4.0 + 2 * 2.0 + 4 * 1.0);
    // Of as many triangles the second side is the one.
    graph.nodes[1].triangles = graph.nodes[2].triangles;
    CHECK(makespan(graph, asymmetric, 8) == 8.0 + 4.0 + 2 * 2.0 + 4 * 1.0);
}

TEST_CASE("on any number of cores the thread methods start one thread less") {
    const TaskGraph full = balanced_tree(9, 1.0), path = chain(40);
    for (unsigned cores = 1; cores <= 40; ++cores) {
        CAPTURE(cores);
        const auto starts = [&](const TaskGraph& graph, const ParallelMethod& method) {
            const Schedule schedule = simulate(graph, method, cores);
            return std::ranges::count(schedule.runs, Doing::starting, &CoreRun::doing);
        };
        REQUIRE(starts(full, symmetric) == cores - 1);
        REQUIRE(starts(path, asymmetric) == cores - 1);
    }
}

TEST_CASE("who has started a thread waits for it, and does nothing else") {
    TaskGraph graph = balanced_tree(2, 4.0);
    graph.nodes[1].cost = 6.0;  // of the new thread; the other leaf costs 2
    for (const ParallelMethod& method : {asymmetric, symmetric}) {
        const Schedule schedule = simulate(graph, method, 2);
        CHECK(schedule.makespan == 4.0 + 6.0);
        CHECK(schedule.spent(Doing::join_wait) == 6.0 - 2.0);
        CHECK(schedule.idle() == 2 * 10.0 - 12.0);
    }
}

TEST_CASE("a thread is not started before the one that starts it has paid for it") {
    const TaskGraph graph = balanced_tree(3, 4.0);
    const SchedulingCosts costs{.thread_start = 0.5};
    CHECK(makespan(graph, symmetric, 4, costs) == 4.0 + 0.5 + 2.0 + 0.5 + 1.0);
    // The queue: the root, three starts one after another; then 2, 1.
    CHECK(makespan(graph, queued(Condition::depth), 4, costs) == 4.0 + 0.5 + 0.5 + 2.0 + 1.0);
}

TEST_CASE("the queue's lock is held by one thread, and the others wait in line") {
    const TaskGraph graph = balanced_tree(2, 4.0);  // 4, 2 2
    const Schedule schedule = simulate(graph, queued(Condition::depth), 2, {.lock = 1.0});
    // Root 0-4, its children put 4-5; both threads want one at 5: 5-6 and 6-7.
    CHECK(schedule.makespan == 7.0 + 2.0);
    CHECK(schedule.spent(Doing::lock_wait) == 1.0);
    CHECK(schedule.spent(Doing::locked) == 3.0);
    CHECK(schedule.idle() == 2 * 9.0 - 8.0 - 3.0);
}

TEST_CASE("the queue binds: no number of cores is faster than its locked parts in line") {
    const TaskGraph graph = balanced_tree(9, 1.0);  // 511 nodes, 255 of them inner
    const ParallelMethod method{.kind = Kind::queue, .condition = Condition::depth, .deepest = 100};
    for (const unsigned cores : {8u, 64u, 256u})
        CHECK(makespan(graph, method, cores, {.lock = 1.0}) > 255.0 + 510.0);
}

TEST_CASE("a thread that keeps a subtree takes no lock for it") {
    const TaskGraph graph = balanced_tree(9, 1.0);
    for (const unsigned deepest : {0u, 1u, 3u}) {
        const ParallelMethod method{
            .kind = Kind::queue, .condition = Condition::depth, .deepest = deepest};
        const Schedule schedule = simulate(graph, method, 1, {.lock = 1.0});
        // Nodes down to `deepest` put their children there; each child is taken.
        const double puts = double((2u << deepest) - 1);
        CHECK(schedule.spent(Doing::locked) == puts + 2.0 * puts);
    }
}

TEST_CASE("one core and a queue: which nodes it keeps is seen by the order") {
    const TaskGraph graph = balanced_tree(3, 4.0);  // 1 2 below 0, 3 4 below 1, 5 6 below 2
    const auto order = [&](Condition condition) {
        std::vector<std::uint32_t> nodes;
        for (const CoreRun& run : simulate(graph, queued(condition), 1).runs)
            if (run.doing == Doing::node) nodes.push_back(run.node);
        return nodes;
    };
    // (1) With one node waiting 1 is kept with its children; with none 2 puts its own there.
    CHECK(order(Condition::threads) == std::vector<std::uint32_t>{0, 1, 3, 4, 2, 5, 6});
    // (2) With one node waiting 1 puts its children there; with two 2 keeps its own.
    CHECK(order(Condition::twice_threads) == std::vector<std::uint32_t>{0, 1, 2, 5, 6, 3, 4});
    CHECK(order(Condition::threads_to_threads) == order(Condition::threads));
    // (4) Down to level 4 all are put there: breadth first.
    CHECK(order(Condition::depth) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6});
}

TEST_CASE("conditions 1 to 3 refill a queue that has shrunk; condition 4 does not") {
    // One side is a leaf, the other a long chain of nodes with work beside it.
    const TaskGraph graph = balanced_tree(8, 128.0);
    const auto locked = [&](Condition condition) {
        return simulate(graph, queued(condition), 2, {.lock = 0x1p-20}).spent(Doing::locked);
    };
    CHECK(locked(Condition::threads) > 0.0);
    CHECK(locked(Condition::threads_to_threads) >= locked(Condition::twice_threads));
    CHECK(simulate(graph, queued(Condition::threads), 2).makespan < 8 * 128.0);
}

TEST_CASE("the combined rule is condition 4 for small scenes and 2 for large ones") {
    TaskGraph graph = balanced_tree(9, 64.0);
    const SchedulingCosts costs{.lock = 0.125};
    const ParallelMethod combined = queued(Condition::combined);
    CHECK(makespan(graph, combined, 4, costs) ==
          makespan(graph, queued(Condition::depth), 4, costs));
    graph.nodes[0].triangles = 500'000;
    CHECK(makespan(graph, combined, 4, costs) ==
          makespan(graph, queued(Condition::twice_threads), 4, costs));
}

TEST_CASE("a steal costs the thief, and nobody else") {
    const TaskGraph graph = balanced_tree(2, 4.0);
    const Schedule schedule = simulate(graph, stealing, 2, {.steal = 0.5});
    CHECK(schedule.makespan == 4.0 + 0.5 + 2.0);
    CHECK(schedule.spent(Doing::stealing) == 0.5);
    CHECK(schedule.idle() == 2 * 6.5 - 8.0 - 0.5);
}

TEST_CASE("a large node is made by all, but for its serial share") {
    TaskGraph graph = balanced_tree(2, 8.0);  // 8, 4 4
    ParallelMethod method = stealing;
    method.large = 150;  // the root has 200
    method.chunk = 50;
    CHECK(makespan(graph, method, 2) == 4.0 + 4.0);
    CHECK(makespan(graph, method, 4) == 2.0 + 4.0);
    CHECK(makespan(graph, method, 8) == 2.0 + 4.0);  // four chunks, no more
    CHECK(makespan(graph, method, 4, {.serial_share = 0.5}) == 4.0 * 0.25 + 4.0 + 4.0);
    CHECK(makespan(graph, method, 2, {.chunk = 0.25}) == 4.0 + 2 * 0.25 + 4.0);
    // One core, too, goes from chunk to chunk.
    CHECK(makespan(graph, method, 1, {.chunk = 0.25, .serial_share = 0.5}) == 8.0 + 1.0 + 8.0);
}

TEST_CASE("a thief takes the oldest of another's nodes, and each thread the latest of its own") {
    // Core 1 takes node 1. Core 0 goes down on the other side and leaves 3, and then 5.
    TaskGraph graph;
    graph.nodes = {{.cost = 1.0, .triangles = 4, .first = 1},
                   {.cost = 4.0, .triangles = 1, .depth = 1},
                   {.cost = 1.0, .triangles = 3, .first = 3, .depth = 1},
                   {.cost = 2.0, .triangles = 1, .depth = 2},
                   {.cost = 1.0, .triangles = 2, .first = 5, .depth = 2},
                   {.cost = 3.0, .triangles = 1, .depth = 3},
                   {.cost = 10.0, .triangles = 1, .depth = 3}};
    const auto made_by = [&](unsigned core) {
        std::vector<std::uint32_t> nodes;
        for (const CoreRun& run : simulate(graph, stealing, 2).runs)
            if (run.core == core && run.doing == Doing::node) nodes.push_back(run.node);
        return nodes;
    };
    CHECK(made_by(1) == std::vector<std::uint32_t>{1, 3, 5});
    graph.nodes[1].cost = 100.0;
    CHECK(made_by(0) == std::vector<std::uint32_t>{0, 2, 4, 6, 5, 3});
}

TEST_CASE("who puts two nodes into the queue wakes two threads, and not all") {
    TaskGraph graph = balanced_tree(2, 2.0);
    graph.nodes[1].first = 3;
    graph.nodes.resize(5, {.cost = 5.0, .triangles = 50, .depth = 2});
    const Schedule schedule =
        simulate(graph, queued(Condition::threads_to_threads), 6, {.lock = 1.0});
    // Two puts; six threads that ask for the root's children, when the first is started and the
    // queue not yet empty; then two that are woken, and who has put.
    CHECK(std::ranges::count(schedule.runs, Doing::locked, &CoreRun::doing) == 2 + 6 + 3);
}

TEST_CASE("one core steals from nobody, also where it makes large nodes") {
    ParallelMethod method = stealing;
    method.large = 150, method.chunk = 50;
    CHECK(makespan(balanced_tree(3, 4.0), method, 1, {.steal = 0.5}) == 3 * 4.0);
}

TEST_CASE("a chunk of no triangle is one of one, and one of more than there are is one of all") {
    const TaskGraph graph = balanced_tree(3, 4.0);
    ParallelMethod method = stealing, same = stealing;
    method.large = same.large = 150;
    for (const auto& [chunk, as] :
         {std::pair{std::size_t{0}, std::size_t{1}}, {~std::size_t{0}, std::size_t{400}}}) {
        method.chunk = chunk, same.chunk = as;
        CHECK(makespan(graph, method, 2) == makespan(graph, same, 2));
    }
    CHECK(makespan(graph, method, 2) == 4.0 + 2 * 2.0 + 2 * 1.0);  // one has all of a node to do
}

TEST_CASE("a simulation of no core, and of times that are none, is refused") {
    const double no_number = std::nan("");
    const TaskGraph graph = balanced_tree(3, 4.0);
    const auto refused = [](const TaskGraph& of, unsigned cores, const SchedulingCosts& costs) {
        for (const ParallelMethod& method : all_methods)
            CHECK_THROWS_AS(simulate(of, method, cores, costs), std::invalid_argument);
    };
    refused(graph, 0, {});
    for (const double none : {no_number, -1.0, double(infinity)}) {
        refused(graph, 2, {.thread_start = none});
        refused(graph, 2, {.lock = none});
        refused(graph, 2, {.steal = none});
        refused(graph, 2, {.chunk = none});
        refused(graph, 2, {.serial_share = none});
        refused(graph, 2, {.bandwidth_share = none});
        TaskGraph other = graph;
        other.nodes.back().cost = none;
        refused(other, 2, {});
        refused({.nodes = graph.nodes, .boxing = none}, 2, {});
        refused({.nodes = graph.nodes, .joining = none}, 2, {});
    }
    refused(graph, 2, {.serial_share = 1.5});
}

TEST_CASE("cores slow down together where they ask for more than the memory gives") {
    const TaskGraph graph = balanced_tree(2, 4.0);  // 4 alone, then 2 beside 2
    for (const ParallelMethod& method : all_methods) {
        CHECK(makespan(graph, method, 2, {.bandwidth_share = 0.5}) == 4.0 + 2.0);
        CHECK(makespan(graph, method, 2, {.bandwidth_share = 0.75}) == 4.0 + 1.5 * 2.0);
        CHECK(makespan(graph, method, 2, {.bandwidth_share = 1.0}) == 4.0 + 2.0 * 2.0);
    }
}

TEST_CASE("Amdahl's law is what an even schedule takes") {
    // A tenth is serial; the rest is 64 leaves' worth, which up to 64 cores divide evenly.
    TaskGraph graph = balanced_tree(7, 0.0);
    for (TaskNode& node : graph.nodes)
        if (node.is_leaf()) node.cost = 90.0 / 64;
    graph.boxing = 10.0;
    for (const unsigned cores : {1u, 2u, 4u, 16u, 64u})
        CHECK(graph.total() / makespan(graph, symmetric, cores) ==
              Approx(amdahl_speedup(0.1, cores)).epsilon(1e-12));
    CHECK(amdahl_bound(0.15) == Approx(100.0 / 15.0));
    CHECK(serial_share_of(amdahl_speedup(0.15, 7), 7) == Approx(0.15).epsilon(1e-12));
}

}  // namespace space
