#include "tests/suite/tree_check.hpp"

#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/small_bvh.hpp"

#include <cmath>

namespace space {
namespace {

const std::vector<Triangle> triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                      {{2, 0, 0}, {3, 0, 0}, {2, 1, 1}},
                                      {{4, 0, 0}, {5, 0, 0}, {4, 1, 0}}};

Aabb box(Point3 low, Point3 high) {
    return {low, high};
}

/// Root 0 with the leaf 1 (triangle 0) and the node 2, which has the leaves 3 (triangle 1) and 4
/// (triangle 2).
std::vector<TreeNode> good_tree() {
    return {{box({0, 0, 0}, {5, 1, 1}), {1, 2}, {}},
            {box({0, 0, 0}, {1, 1, 0}), {}, {0}},
            {box({2, 0, 0}, {5, 1, 1}), {3, 4}, {}},
            {box({2, 0, 0}, {3, 1, 1}), {}, {1}},
            {box({4, 0, 0}, {5, 1, 0}), {}, {2}}};
}
std::string faults_of(const std::vector<TreeNode>& tree, const TreeRules& rules = {}) {
    return diagnosis(tree_faults(tree, triangles, rules));
}
constexpr TreeRules cells{.boxes_hold_triangles = false, .cells_hold_pieces = true, .once = false};

}  // namespace

TEST_CASE("a good tree has no faults, under the strictest rules") {
    CHECK(faults_of(good_tree(), {.tight = true, .cells_hold_pieces = true, .max_leaf_size = 1}) ==
          "");
    CHECK(tree_faults({}, {}).empty());
}

TEST_CASE("boxes that do not hold their content are told, with the excess and the axis") {
    auto tree = good_tree();
    tree[4].box.max.x = std::nextafter(5.0f, 6.0f);
    CHECK(faults_of(tree) == "node 2: child 4 exceeds parent by 4.77e-07 on x");
    CHECK(faults_of(tree, {.tight = true}) ==
          "node 2: child 4 exceeds parent by 4.77e-07 on x; node 4: box is larger than its content "
          "by 4.77e-07 on x");

    tree = good_tree();
    tree[3].box.max.z = 0.75f;
    CHECK(faults_of(tree) == "node 3: triangle 1 exceeds its leaf by 0.25 on z");
    tree = good_tree();
    tree[0].box.min.y = std::nanf("");
    CHECK(faults_of(tree) == "node 0: box is not a number");
}

TEST_CASE("triangles that are lost, doubled, unknown or too many are told") {
    auto tree = good_tree();
    tree[3].triangles.clear();
    CHECK(faults_of(tree) == "triangle 1 in no leaf");
    tree = good_tree();
    tree[2].box = tree[0].box;
    tree[3].box = tree[0].box;
    tree[3].triangles = {1, 0};
    CHECK(faults_of(tree) == "triangle 0 in 2 leaves");
    CHECK(faults_of(tree, {.once = false}) == "");
    CHECK(faults_of(tree, {.once = false, .max_leaf_size = 1}) ==
          "node 3: 2 triangles in a leaf, 1 allowed");
    tree[3].triangles = {1, 1};
    CHECK(faults_of(tree, {.once = false}) == "node 3: triangle 1 twice in the leaf");
    tree = good_tree();
    tree[4].triangles = {7};
    CHECK(faults_of(tree) == "node 4: triangle 7 is none of the 3; triangle 2 in no leaf");
    tree = good_tree();
    tree[2].triangles = {1};
    CHECK(faults_of(tree, {.once = false}) == "node 2: has children and triangles");
    CHECK(diagnosis(tree_faults({}, triangles)) == "no nodes for 3 triangles");
}

TEST_CASE("nodes that do not make a tree are told, and end the search") {
    auto tree = good_tree();
    tree[2].children = {3, 9};
    CHECK(faults_of(tree) == "node 2: child 9 is none of the 5 nodes; node 4: no parent");
    tree = good_tree();
    tree[2].children = {3, 4, 1};
    CHECK(faults_of(tree) == "node 1: 2 parents");
    tree = good_tree();
    tree[4].children = {0};
    CHECK(faults_of(tree) == "node 0: the root is somebody's child");
    tree = good_tree();
    tree[0].children = {1};
    tree[4].children = {2};
    CHECK(faults_of(tree) == "3 nodes cannot be reached from the root");
}

TEST_CASE("a cell that a triangle passes through without a vertex in it must name the triangle") {
    const std::vector<Triangle> spanning{{{-10, -9, 0.5f}, {11, -8, 0.5f}, {0, 12, 0.5f}}};
    std::vector<TreeNode> tree{{box({-16, -16, 0}, {16, 16, 1}), {1, 2}, {}},
                               {box({-16, -16, 0}, {0.5f, 16, 1}), {}, {0}},
                               {box({0.5f, -16, 0}, {16, 16, 1}), {}, {0}}};
    CHECK(diagnosis(tree_faults(tree, spanning, cells)) == "");
    tree[2].triangles.clear();
    CHECK(diagnosis(tree_faults(tree, spanning, cells)) ==
          "node 2: triangle 0 passes through the cell, and the leaf does not name it");
}

TEST_CASE("of many faults the first eight are shown, the rest counted") {
    std::vector<TreeNode> tree{{box({0, 0, 0}, {1, 1, 1}), {}, {}}};
    const std::vector<Triangle> many(11, triangles[0]);
    CHECK(diagnosis(tree_faults(tree, many)).ends_with("triangle 7 in no leaf; and 3 more"));
}

TEST_CASE("the trees of all adversarial scenes keep the rules; boxes of too few vertices do not") {
    bool caught = false;
    for (const TestScene& scene : adversarial_scenes()) {
        INFO(scene.name);
        CHECK(diagnosis(tree_faults(SmallBvh<>::build(scene.triangles).nodes(), scene.triangles,
                                    {.tight = true, .max_leaf_size = 4})) == "");
        caught = caught ||
                 !tree_faults(SmallBvh<TreeFlaw::vertices_only>::build(scene.triangles).nodes(),
                              scene.triangles)
                      .empty();
    }
    CHECK(caught);
}

}  // namespace space
