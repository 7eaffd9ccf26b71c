#include "ex01_divide_the_budget.hpp"

#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace space;

namespace {

std::string divided(unsigned budget) {
    const ChildBudgets budgets = divide_budget(budget);
    return std::to_string(budgets.first) + " and " + std::to_string(budgets.second);
}

/// By node its first child; nodes are cut in the order of their numbers.
std::vector<std::uint32_t> full_tree(unsigned levels) {
    const std::uint32_t inner = (1u << (levels - 1)) - 1;
    std::vector<std::uint32_t> first_child(2 * inner + 1, 0);
    for (std::uint32_t i = 0; i < inner; ++i) first_child[i] = 2 * i + 1;
    return first_child;
}
/// Inner nodes below one another, all of them first or all of them second children.
std::vector<std::uint32_t> chain(std::uint32_t inner, bool second) {
    std::vector<std::uint32_t> first_child(2 * inner + 1, 0);
    for (std::uint32_t i = 0, node = 0; i < inner; ++i) {
        first_child[node] = 2 * i + 1;
        node = 2 * i + (second ? 2 : 1);
    }
    return first_child;
}
/// The mirrored tree, numbered from the other end: children stand before their parents, and the
/// root is the last node. (Node 0 is none of its nodes: 0 would mean a leaf.)
std::vector<std::uint32_t> backwards(const std::vector<std::uint32_t>& first_child) {
    const auto size = static_cast<std::uint32_t>(first_child.size());
    std::vector<std::uint32_t> reversed(size + 1, 0);
    for (std::uint32_t i = 0; i < size; ++i)
        if (first_child[i] != 0) reversed[size - i] = size - first_child[i] - 1;
    return reversed;
}

/// What the chapter's simulator starts.
unsigned simulated(const std::vector<std::uint32_t>& first_child, unsigned budget) {
    TaskGraph graph;
    for (const std::uint32_t child : first_child)
        graph.nodes.push_back({.cost = 1.0, .triangles = 1, .first = child});
    const Schedule schedule =
        simulate(graph, {.kind = ParallelMethod::Kind::symmetric}, budget + 1);
    unsigned starts = 0;
    for (const CoreRun& run : schedule.runs) starts += run.doing == CoreRun::Doing::starting;
    return starts;
}

}  // namespace

TEST_CASE("four cores: one thread is started at the root, and one by each child") {
    CHECK(divided(3) == "1 and 1");
    CHECK(divided(7) == "3 and 3");
    CHECK(divided(15) == "7 and 7");
}

TEST_CASE("the last thread is for the node itself") {
    CHECK(divided(1) == "0 and 0");
}

TEST_CASE("an even budget: the second child may start one more than the first") {
    CHECK(divided(2) == "0 and 1");
    CHECK(divided(4) == "1 and 2");
    CHECK(divided(6) == "2 and 3");
}

TEST_CASE("no core is lost at a node, and none is given away twice") {
    for (unsigned budget = 1; budget < 10'000; ++budget) {
        const ChildBudgets budgets = divide_budget(budget);
        CAPTURE(budget, budgets.first, budgets.second);
        REQUIRE(1 + budgets.first + budgets.second == budget);
        REQUIRE(budgets.first <= budgets.second);
        REQUIRE(budgets.second <= budgets.first + 1);
    }
}

TEST_CASE("the largest budgets are divided as all others") {
    const unsigned largest = std::numeric_limits<unsigned>::max();
    CHECK(divided(largest) == "2147483647 and 2147483647");
    CHECK(divided(largest - 1) == "2147483646 and 2147483647");
}

TEST_CASE("a leaf starts no thread, nor does a node without a budget") {
    CHECK(started_threads(std::vector<std::uint32_t>{0}, 0, 7) == 0);
    CHECK(started_threads(full_tree(4), 0, 0) == 0);
}

TEST_CASE("a full tree starts all its threads") {
    const auto tree = full_tree(10);
    for (unsigned budget = 0; budget < 200; ++budget) {
        CAPTURE(budget);
        REQUIRE(started_threads(tree, 0, budget) == budget);
    }
}

TEST_CASE("no tree starts more threads than it has inner nodes") {
    CHECK(started_threads(full_tree(3), 0, 1'000) == 3);
    CHECK(started_threads(full_tree(5), 0, 1'000) == 15);
}

TEST_CASE("what a leaf is given nobody gets: a chain halves its budget at each node") {
    for (const bool second : {false, true}) {
        CAPTURE(second);
        CHECK(started_threads(chain(50, second), 0, 1) == 1);
        CHECK(started_threads(chain(50, second), 0, 3) == 2);
        CHECK(started_threads(chain(50, second), 0, 7) == 3);
        CHECK(started_threads(chain(50, second), 0, 1'023) == 10);
    }
    CHECK(started_threads(chain(50, true), 0, 2) == 2);   // 0 for the leaf, 1 for the chain
    CHECK(started_threads(chain(50, false), 0, 2) == 1);  // 0 for the chain
    CHECK(started_threads(chain(50, true), 0, std::numeric_limits<unsigned>::max()) == 32);
}

TEST_CASE("only the part below the node that is asked for counts") {
    const auto tree = full_tree(4);  // nodes 3 to 6 have two leaves each
    CHECK(started_threads(tree, 1, 100) == 3);
    CHECK(started_threads(tree, 6, 100) == 1);
    CHECK(started_threads(tree, 14, 100) == 0);
}

TEST_CASE("nodes may stand in any order, children before their parents as well") {
    for (unsigned budget = 0; budget < 20; ++budget) {
        CAPTURE(budget);
        REQUIRE(started_threads(backwards(full_tree(6)), 63, budget) == budget);
    }
    CHECK(started_threads(backwards(full_tree(3)), 7, 1'000) == 3);
    CHECK(started_threads(backwards(full_tree(1)), 1, 9) == 0);
    CHECK(started_threads(backwards(chain(20, true)), 41, 2) == 1);  // its children changed places
    CHECK(started_threads(backwards(chain(20, false)), 41, 2) == 2);
}

TEST_CASE("a long chain is left alone where no budget is left") {
    CHECK(started_threads(chain(2'000'000, true), 0, 3) == 2);
}

TEST_CASE("random trees start as many threads as the chapter's simulator") {
    Pcg32 random(8);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint32_t> tree(1, 0);
        const std::uint32_t cuts = random.below(40);
        for (std::uint32_t cut = 0; cut < cuts; ++cut) {
            const auto leaf = random.below(static_cast<std::uint32_t>(tree.size()));
            if (tree[leaf] != 0) continue;
            tree[leaf] = static_cast<std::uint32_t>(tree.size());
            tree.resize(tree.size() + 2, 0);
        }
        const unsigned budget = random.below(70);
        CAPTURE(i, budget, tree);
        REQUIRE(started_threads(tree, 0, budget) == simulated(tree, budget));
    }
}
