#include "ex05_refit.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <cstdint>
#include <vector>

using namespace space;

namespace {

/// A tree whose boxes can be changed, and that counts how often they are.
class CountedTree {
  public:
    explicit CountedTree(std::vector<Triangle> all, std::size_t leaf_size = 1)
        : triangles(std::move(all)),
          nodes_(MedianBuilder::build<3>(triangles, {.max_leaf_size = leaf_size})),
          parents_(nodes_.nodes.size()) {
        nodes_.for_each_node([&](std::uint32_t index, unsigned) {
            const BvhNode<3>& node = nodes_.nodes[index];
            if (!node.is_leaf()) parents_[node.first] = parents_[node.first + 1] = index;
        });
    }

    Aabb box(std::uint32_t node) const { return known(node).box; }
    void set_box(std::uint32_t node, const Aabb& box) {
        idle += known(node).box == box;
        nodes_.nodes[node].box = box;
        if (++set > 10 * size()) FAIL("boxes are set without end");
    }
    std::uint32_t parent(std::uint32_t node) {
        known(node);
        if (++climbed > 10 * size()) FAIL("a way up without end");
        return parents_[node];
    }
    std::uint32_t first_child(std::uint32_t node) const {
        if (known(node).is_leaf()) FAIL("a leaf was asked for its children");
        return nodes_.nodes[node].first;
    }
    Aabb bounds_of_triangles(std::uint32_t leaf) {
        ++asked;
        return own_box(leaf);
    }

    // What follows is the check's.
    std::vector<Triangle> triangles;
    std::size_t set = 0, idle = 0, asked = 0, climbed = 0;

    std::size_t size() const { return nodes_.nodes.size(); }
    std::uint32_t leaf_of(std::uint32_t triangle) const {
        for (std::uint32_t i = 0; i < nodes_.nodes.size(); ++i)
            for (const std::uint32_t named : nodes_.own(i))
                if (named == triangle) return i;
        FAIL("no such triangle");
        return 0;
    }
    /// The boxes of a tree of this shape over the triangles as they are.
    std::vector<Aabb> fitting() const {
        std::vector<Aabb> boxes(size());
        for (std::uint32_t i = std::uint32_t(size()); i-- > 0;) {  // children stand behind
            if (i == 1) continue;
            if (nodes_.nodes[i].is_leaf()) {
                boxes[i] = own_box(i);
            } else {
                boxes[i] = boxes[nodes_.nodes[i].first];
                boxes[i].extend(boxes[nodes_.nodes[i].first + 1]);
            }
        }
        return boxes;
    }

  private:
    const BvhNode<3>& known(std::uint32_t node) const {
        if (node == 1 || node >= size()) FAIL("there is no node " << node);
        return nodes_.nodes[node];
    }
    Aabb own_box(std::uint32_t leaf) const {
        if (!known(leaf).is_leaf()) FAIL("an inner node was asked for its triangles");
        Aabb box;
        for (const std::uint32_t i : nodes_.own(leaf)) box.extend(bounds(triangles[i]));
        return box;
    }

    BvhNodes<3> nodes_;
    std::vector<std::uint32_t> parents_;
};

/// Unit triangles at 0, 4, 8 ... on the x axis: the tree is in this order.
CountedTree row(int count) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; ++i) {
        const float x = 4.0f * float(i);
        triangles.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 1}});
    }
    return CountedTree(triangles);
}

void move(CountedTree& tree, std::uint32_t triangle, const Vector3& by) {
    Triangle& t = tree.triangles[triangle];
    t = {t.a + by, t.b + by, t.c + by};
}

/// Refits after the triangle has changed, and looks at every box.
void refit_and_check(CountedTree& tree, std::uint32_t triangle) {
    const std::vector<Aabb> wanted = tree.fitting();
    std::size_t changes = 0;
    for (std::uint32_t i = 0; i < tree.size(); ++i)
        changes += i != 1 && !(tree.box(i) == wanted[i]);
    tree.set = tree.idle = tree.asked = tree.climbed = 0;
    refit_from(tree, tree.leaf_of(triangle));
    for (std::uint32_t i = 0; i < tree.size(); ++i) {
        if (i == 1) continue;
        CAPTURE(i);
        REQUIRE(tree.box(i) == wanted[i]);
    }
    REQUIRE(tree.set == changes);
    REQUIRE(tree.idle == 0);
    REQUIRE(tree.asked == 1);
    REQUIRE(tree.climbed <= tree.set);
}

}  // namespace

TEST_CASE("a root that is a leaf gets the box of its triangles") {
    CountedTree tree = row(1);
    move(tree, 0, {2, 3, 4});
    refit_and_check(tree, 0);
}

TEST_CASE("all boxes up to the root fit again after a triangle has moved out of them") {
    CountedTree tree = row(8);
    move(tree, 3, {0, 10, 0});
    refit_and_check(tree, 3);
    move(tree, 7, {0, 0, -50});
    refit_and_check(tree, 7);
}

TEST_CASE("boxes shrink when it comes back") {
    CountedTree tree = row(8);
    move(tree, 2, {0, 100, 0});
    refit_and_check(tree, 2);
    move(tree, 2, {0, -100, 0});
    refit_and_check(tree, 2);
    move(tree, 0, {1, 0, 0});  // the lower end of all
    refit_and_check(tree, 0);
}

TEST_CASE("where nothing has changed nothing is set") {
    CountedTree tree = row(8);
    refit_and_check(tree, 4);
    CHECK(tree.set == 0);
}

TEST_CASE("above a box that comes out as it was nothing is done") {
    CountedTree tree = row(16);
    tree.triangles[5].b.x -= 0.5f;  // within its parent's box
    tree.triangles[5].c.y -= 0.25f;
    refit_and_check(tree, 5);
    CHECK(tree.set >= 1);
    CHECK(tree.set <= 2);
}

TEST_CASE("a change at the end of a box that another triangle holds up stops there") {
    CountedTree tree = row(4);
    move(tree, 1, {0, 5, 0});
    refit_and_check(tree, 1);
    move(tree, 2, {0, 5, 0});  // the root's box stays
    refit_and_check(tree, 2);
    CHECK(tree.set == 2);
    move(tree, 1, {0, -5, 0});
    refit_and_check(tree, 1);
    CHECK(tree.set == 2);
}

TEST_CASE("leaves of several triangles: the others count, too") {
    CountedTree tree(row(12).triangles, 4);
    move(tree, 5, {0, 7, 0});
    refit_and_check(tree, 5);
    move(tree, 6, {0, 7, 0});
    refit_and_check(tree, 6);
    move(tree, 5, {0, -9, 0});
    refit_and_check(tree, 5);
}

TEST_CASE("random moves in random trees: every box is the smallest, and no work is for nothing") {
    Pcg32 random(6);
    for (int i = 0; i < sized(200, 20); ++i) {
        std::vector<Triangle> triangles;
        for (std::uint32_t k = 1 + random.below(60); k > 0; --k) {
            const Point3 at = 10.0f * random_vector(random);
            const Vector3 b = random_vector(random);
            const Vector3 c = random_vector(random);
            triangles.push_back({at, at + b, at + c});
        }
        CountedTree tree(triangles, 1 + random.below(4));
        for (int step = 0; step < 20; ++step) {
            const std::uint32_t triangle = random.below(std::uint32_t(triangles.size()));
            const float far = random.below(3) ? 0.5f : 20.0f;
            move(tree, triangle, far * random_vector(random));
            CAPTURE(i, step, triangle);
            refit_and_check(tree, triangle);
        }
    }
}
