#include "ex01_four_from_two.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

using namespace space;

namespace {

/// A tree that grows from its root.
struct Tree {
    std::vector<BinaryNode> nodes;

    explicit Tree(double area) : nodes{{area, 0}} {}
    /// Gives a leaf two children. @return the first
    std::uint32_t split(std::uint32_t node, double first, double second) {
        const auto pair = std::uint32_t(nodes.size());
        nodes[node].first = pair;
        nodes.push_back({first, 0});
        nodes.push_back({second, 0});
        return pair;
    }
    std::uint32_t split(std::uint32_t node) {
        return split(node, nodes[node].area, nodes[node].area);
    }
};

/// All leaves at one depth, all areas equal.
Tree complete(int depth) {
    Tree tree(1.0);
    for (std::uint32_t i = 0; i + 1 < std::uint32_t{1} << depth; ++i) tree.split(i);
    return tree;
}
/// One leaf on each level, and two on the last one, so many levels.
Tree chain(int levels) {
    Tree tree(1.0);
    std::uint32_t node = 0;
    for (int i = 0; i < levels; ++i) node = tree.split(node);
    return tree;
}

/// What a choice costs, or what is wrong with it.
struct Judged {
    double cost = 0.0;
    std::string fault;

    bool operator==(const Judged&) const = default;
};
/// So many places the node fills in the one above.
std::size_t places_of(const std::vector<BinaryNode>& tree, const std::vector<std::size_t>& below,
                      const std::vector<bool>& stays, std::uint32_t node) {
    return tree[node].is_leaf() || stays[node] ? 1 : below[node];
}
Judged judged(const std::vector<BinaryNode>& tree, const std::vector<bool>& stays) {
    if (stays.size() != tree.size())
        return {0.0, "an answer for " + std::to_string(stays.size()) + " nodes of " +
                         std::to_string(tree.size())};
    Judged result;
    std::vector<std::size_t> below(tree.size());
    for (std::size_t i = tree.size(); i-- > 0;) {
        if (tree[i].is_leaf()) {
            if (stays[i]) return {0.0, "leaf " + std::to_string(i) + " counts as a node"};
            continue;
        }
        for (const std::uint32_t child : {tree[i].first, tree[i].first + 1})
            below[i] += places_of(tree, below, stays, child);
        if (!stays[i]) continue;
        if (below[i] > 4)
            return {0.0,
                    "node " + std::to_string(i) + " has " + std::to_string(below[i]) + " children"};
        result.cost += tree[i].area;
    }
    if (!tree.empty() && !tree[0].is_leaf() && !stays[0]) return {0.0, "the root is gone"};
    return result;
}
Judged answer(const Tree& tree) {
    return judged(tree.nodes, nodes_that_stay(tree.nodes));
}
Judged costs(double cost) {
    return {cost, ""};
}

/// All choices tried.
double least(const std::vector<BinaryNode>& tree) {
    std::vector<std::size_t> inner;
    for (std::size_t i = 0; i < tree.size(); ++i)
        if (!tree[i].is_leaf()) inner.push_back(i);
    double best = 1e300;
    for (std::uint32_t set = 0; set < std::uint32_t{1} << inner.size(); ++set) {
        std::vector<bool> stays(tree.size());
        for (std::size_t k = 0; k < inner.size(); ++k) stays[inner[k]] = (set >> k & 1u) != 0;
        const Judged choice = judged(tree, stays);
        if (choice.fault.empty()) best = std::min(best, choice.cost);
    }
    return best;
}

/// Leaves split at random; the areas are whole numbers, each at most that of the node above.
Tree random_tree(Pcg32& random, std::size_t inner, std::uint32_t area) {
    Tree tree(area);
    for (std::size_t i = 0; i < inner; ++i) {
        std::uint32_t leaf = 0;
        while (!tree.nodes[leaf].is_leaf()) leaf = random.below(std::uint32_t(tree.nodes.size()));
        const auto most = std::uint32_t(tree.nodes[leaf].area) + 1;
        const double first = random.below(most);
        const double second = random.below(most);
        tree.split(leaf, first, second);
    }
    return tree;
}

}  // namespace

namespace Catch {
template <>
struct StringMaker<Judged> {
    static std::string convert(const Judged& choice) {
        return choice.fault.empty() ? fmt::format("a tree that costs {}", choice.cost)
                                    : choice.fault;
    }
};
}  // namespace Catch

TEST_CASE("in a tree without inner nodes none can stay") {
    CHECK(nodes_that_stay({}).empty());
    CHECK(answer(Tree(5.0)) == costs(0.0));
}

TEST_CASE("the root stays, and alone where there are no more than four leaves") {
    Tree two(8.0);
    two.split(0, 7.0, 6.0);
    CHECK(answer(two) == costs(8.0));
    Tree three = two;
    three.split(2, 1.0, 1.0);
    CHECK(answer(three) == costs(8.0));
    Tree four = three;
    four.split(1, 2.0, 2.0);
    CHECK(answer(four) == costs(8.0));
    CHECK(answer(chain(3)) == costs(1.0));
}

TEST_CASE("of five leaves in a chain the smallest node below the root stays") {
    Tree tree(16.0);
    tree.split(0, 8.0, 1.0);
    tree.split(1, 4.0, 1.0);
    tree.split(3, 2.0, 1.0);
    tree.split(5, 1.0, 1.0);
    CHECK(answer(tree) == costs(16.0 + 2.0));
}

TEST_CASE("leaves cost nothing, however large they are") {
    Tree tree(100.0);
    tree.split(0, 20.0, 10.0);
    tree.split(1, 20.0, 20.0);  // two leaves of 20
    tree.split(2, 10.0, 9.0);
    tree.split(5, 3.0, 3.0);
    // Five leaves: of 20, 10 and its child of 10 one has to stay.
    CHECK(answer(tree) == costs(110.0));
}

TEST_CASE("what is opened should be what would not be full anyway: eight leaves") {
    Tree tree(100.0);
    tree.split(0, 20.0, 16.0);
    tree.split(1, 19.0, 19.0);
    tree.split(2, 14.0, 14.0);
    for (const std::uint32_t node : {3u, 4u, 5u, 6u}) tree.split(node, 1.0, 1.0);
    CHECK(answer(tree) == costs(100.0 + 20.0 + 14.0));
}

TEST_CASE("areas count, not the number of nodes that stay") {
    // Two nodes could hold the seven leaves, the root and the one of 90. Three are cheaper.
    Tree tree(100.0);
    tree.split(0, 90.0, 2.0);
    tree.split(1, 1.0, 1.0);
    tree.split(3, 1.0, 1.0);
    tree.split(4, 1.0, 1.0);
    tree.split(2, 1.0, 1.0);
    tree.split(9, 1.0, 1.0);
    CHECK(answer(tree) == costs(103.0));
}

TEST_CASE(
    "boxes without area cost nothing, and their nodes have no more than four children either") {
    Tree tree(0.0);
    for (std::uint32_t i = 0; i < 40; ++i) tree.split(i);
    CHECK(answer(tree) == costs(0.0));
}

TEST_CASE("with equal areas as few nodes stay as can be") {
    CHECK(answer(complete(2)) == costs(1.0));
    CHECK(answer(complete(3)) == costs(3.0));
    CHECK(answer(complete(4)) == costs(5.0));
    CHECK(answer(complete(6)) == costs(21.0));
    CHECK(answer(chain(4)) == costs(2.0));
    CHECK(answer(chain(6)) == costs(2.0));
    CHECK(answer(chain(7)) == costs(3.0));
    CHECK(answer(chain(1'000)) == costs(334.0));
}

TEST_CASE("areas that differ where floats do not") {
    Tree tree(0x1p30);
    tree.split(0, 0x1p28 + 2.0, 0x1p28);
    tree.split(1, 0x1p28 + 1.0, 1.0);
    tree.split(2, 1.0, 1.0);
    tree.split(3, 1.0, 1.0);
    CHECK(answer(tree) == costs(0x1p30 + 0x1p28));
}

TEST_CASE("random trees: as cheap as the best of all choices") {
    Pcg32 random(10);
    for (int i = 0; i < sized(2'000, 200); ++i) {
        const std::size_t inner = 1 + random.below(11);
        const std::uint32_t area = 1 + random.below(i % 2 == 0 ? 8 : 1'000);
        const Tree tree = random_tree(random, inner, area);
        CAPTURE(i, inner, area);
        REQUIRE(answer(tree) == costs(least(tree.nodes)));
    }
}

TEST_CASE("a tree of 131,072 leaves, level after level of four") {
    CHECK(answer(complete(16)) == costs(21'845.0));  // (4^8 - 1) / 3
    CHECK(answer(complete(17)) == costs(43'691.0));  // and one with two children above two of these
}
