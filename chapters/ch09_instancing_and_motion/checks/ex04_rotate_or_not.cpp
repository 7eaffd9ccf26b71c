#include "ex04_rotate_or_not.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// All inner boxes anew, whatever stands where; the sum of their half areas.
Aabb fit(BvhNodes<3>& tree, std::uint32_t node, double& sum) {
    BvhNode<3>& at = tree.nodes[node];
    if (at.is_leaf()) return at.box;
    at.box = fit(tree, at.first, sum);
    at.box.extend(fit(tree, at.first + 1, sum));
    sum += at.box.half_area();
    return at.box;
}
double inner_sum(BvhNodes<3> tree) {
    double sum = 0.0;
    fit(tree, 0, sum);
    return sum;
}
double saved_by(BvhNodes<3> tree, std::uint32_t one, std::uint32_t other) {
    const double before = inner_sum(tree);
    std::swap(tree.nodes[one], tree.nodes[other]);
    return before - inner_sum(tree);
}

/// Whether it is a swap below the node at all.
bool is_swap_below(const BvhNodes<3>& tree, std::uint32_t node, const ChildSwap& swap) {
    const std::uint32_t first = tree.nodes[node].first;
    if (swap.child != first && swap.child != first + 1) return false;
    const BvhNode<3>& sibling = tree.nodes[2 * first + 1 - swap.child];
    return !sibling.is_leaf() &&
           (swap.grandchild == sibling.first || swap.grandchild == sibling.first + 1);
}

/// What the best of all swaps saves; nothing where none does.
double most_saved(const BvhNodes<3>& tree, std::uint32_t node) {
    const std::uint32_t first = tree.nodes[node].first;
    double most = 0.0;
    for (const std::uint32_t child : {first, first + 1}) {
        const BvhNode<3>& sibling = tree.nodes[2 * first + 1 - child];
        if (sibling.is_leaf()) continue;
        for (const std::uint32_t out : {sibling.first, sibling.first + 1})
            most = std::max(most, saved_by(tree, child, out));
    }
    return most;
}

void check_node(const BvhNodes<3>& tree, std::uint32_t node) {
    const double rounding = 1e-9 * inner_sum(tree), most = most_saved(tree, node);
    const std::optional<ChildSwap> best = best_swap(tree, node);
    if (most > rounding) {
        REQUIRE(best.has_value());
    } else if (!best) {
        return;
    }
    REQUIRE(is_swap_below(tree, node, *best));
    const double is = saved_by(tree, best->child, best->grandchild);
    CAPTURE(best->child, best->grandchild, is, most);
    REQUIRE(is >= most - rounding);
    REQUIRE(std::abs(best->saved - is) <= rounding);
}

/// A root, two children, four leaves: places 4 to 7 have these boxes.
BvhNodes<3> four_leaves(const std::array<Aabb, 4>& boxes) {
    BvhNodes<3> tree;
    tree.nodes.resize(8);
    tree.references = {0, 1, 2, 3};
    for (std::uint32_t i = 0; i < 4; ++i) tree.nodes[4 + i] = {boxes[i], i, 1};
    tree.nodes[2].first = 4;
    tree.nodes[3].first = 6;
    tree.nodes[0].first = 2;
    unite_boxes(tree);
    return tree;
}
Aabb cell(float x) {
    return {{x, 0, 0}, {x + 1, 1, 1}};
}

}  // namespace

TEST_CASE("one that is far away is taken out of a pair: the other two join its neighbour") {
    // Cells at 0, 1, 2, and one at 100: the pair with the far one has a box of 99 and more.
    for (std::uint32_t far = 0; far < 4; ++far) {
        std::array<Aabb, 4> boxes;
        float x = 0.0f;
        for (std::uint32_t i = 0; i < 4; ++i) boxes[i] = i == far ? cell(100) : cell(x++);
        const BvhNodes<3> tree = four_leaves(boxes);
        CAPTURE(far);
        const std::optional<ChildSwap> best = best_swap(tree, 0);
        REQUIRE(best.has_value());
        CHECK(best->grandchild == 4 + far);
        CHECK(best->child == (far < 2 ? 3u : 2u));
        check_node(tree, 0);
    }
}

TEST_CASE("where no swap makes boxes smaller there is none") {
    CHECK(!best_swap(four_leaves({cell(0), cell(1), cell(10), cell(11)}), 0));
    CHECK(!best_swap(four_leaves({cell(0), cell(0), cell(0), cell(0)}), 0));  // nothing is saved
}

TEST_CASE("leaves have no children to give away") {
    BvhNodes<3> tree;  // a leaf, and a pair of which one lies at the leaf's
    tree.nodes.resize(6);
    tree.references = {0, 1, 2};
    tree.nodes[2] = {cell(0), 4, 1};  // not a pair at place 4
    tree.nodes[3] = {{}, 4, 0};
    tree.nodes[4] = {cell(1), 1, 1};
    tree.nodes[5] = {cell(50), 2, 1};
    tree.nodes[0].first = 2;
    unite_boxes(tree);
    check_node(tree, 0);
    const std::optional<ChildSwap> best = best_swap(tree, 0);
    REQUIRE(best.has_value());
    CHECK(best->child == 2);
    CHECK(best->grandchild == 5);
    CHECK(best->saved == 96.0);  // 50 x 1 x 1 becomes 2 x 1 x 1: 101 - 5
    std::swap(tree.nodes[2], tree.nodes[3]);
    check_node(tree, 0);
    tree.nodes[2] = {cell(0), 2, 1};  // two leaves
    tree.nodes[3] = {cell(7), 0, 1};
    unite_boxes(tree);
    CHECK(!best_swap(tree, 0));
}

TEST_CASE("it is the surface that counts, not the volume or the edges") {
    // Flat boxes have no volume; long ones have long edges and little surface.
    const Aabb plate{{0, 0, 0}, {8, 8, 0}}, above{{0, 0, 3}, {8, 8, 3}},
        rod{{0, 0, 0}, {60, 0.5f, 0.5f}}, bead{{50, 0, 0}, {50.5f, 0.5f, 0.5f}};
    check_node(four_leaves({plate, bead, rod, above}), 0);
    check_node(four_leaves({plate, rod, bead, above}), 0);
    check_node(four_leaves({rod, plate, above, bead}), 0);
    check_node(four_leaves({bead, rod, rod, plate}), 0);
}

TEST_CASE("all nodes of random trees: the best of all swaps, and what it saves") {
    Pcg32 random(4);
    for (int round = 0; round < sized(60, 6); ++round) {
        std::vector<Triangle> triangles;
        for (std::uint32_t count = 3 + random.below(40); count > 0; --count) {
            const Point3 a = 4.0f * random_vector(random);
            const Vector3 b = random_vector(random);
            const Vector3 c = random_vector(random);
            triangles.push_back({a, a + b, a + c});
        }
        BvhNodes<3> tree =
            MedianBuilder::build<3>(triangles, {.max_leaf_size = 1 + random.below(3)});
        for (Triangle& t : triangles) {  // and then they move
            const Vector3 by = 3.0f * random_vector(random);
            t = {t.a + by, t.b + by, t.c + by};
        }
        refit<3>(tree, triangles);
        for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
            if (i == 1 || tree.nodes[i].is_leaf()) continue;
            CAPTURE(round, i);
            check_node(tree, i);
        }
    }
}
