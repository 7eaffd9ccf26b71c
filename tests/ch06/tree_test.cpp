// Trees over segments and triangles: nothing is lost, nothing explodes, edges are s / 2^i.
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "common/limit_error.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch04/exact_parts.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace space {
namespace {

using Straddlers = OctreeConfig::Straddlers;

/// Finds in rational numbers what a tree loses: where a polygon has a point in a cell, the node or
/// one below it must name it; of what lies in a middle plane, on one of its sides.
template <int D>
class LossFinderOfOrthtree {
  public:
    LossFinderOfOrthtree(const OrthtreeNodes<D>& tree, std::span<const Simplex<D>> polygons)
        : tree_(tree) {
        names_.resize(tree.nodes.size());
        if (!tree.empty()) collect(0);
        for (std::uint32_t i = 0; i < polygons.size(); ++i)
            if (!tree.empty()) descend(0, {}, i, exact_part<D>(polygons[i]));
    }
    /// "polygon 3 at node 12", one a loss.
    const std::vector<std::string>& losses() const { return losses_; }

  private:
    void collect(std::uint32_t index) {
        const auto own = tree_.own(index);
        names_[index].insert(own.begin(), own.end());
        for (std::uint32_t k = 0; k < orthants<D>; ++k) {
            if (!tree_.nodes[index].has(k)) continue;
            const std::uint32_t child = tree_.nodes[index].child(k);
            collect(child);
            names_[index].insert(names_[child].begin(), names_[child].end());
        }
    }
    bool names(std::uint32_t index, std::uint32_t k, std::uint32_t polygon) const {
        return tree_.nodes[index].has(k) && names_[tree_.nodes[index].child(k)].count(polygon) != 0;
    }
    void lose(std::uint32_t polygon, std::uint32_t node) {
        losses_.push_back("polygon " + std::to_string(polygon) + " at node " +
                          std::to_string(node));
    }
    void descend(std::uint32_t index, const OrthtreeCell<D>& cell, std::uint32_t polygon,
                 const ExactPart<D>& part) {
        if (names_[index].count(polygon) == 0) return lose(polygon, index);
        for (const std::uint32_t own : tree_.own(index))
            if (own == polygon) return;
        const Double<D> middle = tree_.frame.box(cell).centre();
        for (std::uint32_t k = 0; k < orthants<D>; ++k) {
            ExactPart<D> below = part;
            for (int axis = 0; axis < D; ++axis)
                below = exactly_clipped<D>(below, std::size_t(axis), middle[axis],
                                           (k >> axis & 1u) != 0 ? -1 : 1);
            if (below.empty()) continue;
            if (names(index, k, polygon))
                descend(tree_.nodes[index].child(k), cell.child(k), polygon, below);
            else if (!across(index, k, polygon, below, middle))
                lose(polygon, index);
        }
    }
    /// Whether a child names the part on the other side of planes in which all of it lies.
    bool across(std::uint32_t index, std::uint32_t k, std::uint32_t polygon,
                const ExactPart<D>& part, const Double<D>& middle) const {
        std::uint32_t in_planes = 0;
        for (int axis = 0; axis < D; ++axis) {
            bool all = true;
            for (const auto& corner : part) all = all && corner[std::size_t(axis)] == middle[axis];
            in_planes |= std::uint32_t(all) << axis;
        }
        for (std::uint32_t some = 1; some < orthants<D>; ++some)
            if ((some & ~in_planes) == 0 && names(index, k ^ some, polygon)) return true;
        return false;
    }

    const OrthtreeNodes<D>& tree_;
    std::vector<std::set<std::uint32_t>> names_;  ///< by node, of its whole subtree
    std::vector<std::string> losses_;
};

template <int D>
std::vector<Simplex<D>> flattened(std::span<const Triangle> triangles) {
    std::vector<Simplex<D>> all;
    for (const Triangle& t : triangles)
        if constexpr (D == 3)
            all.push_back(t);
        else
            all.push_back({{t.a.x, t.a.y}, {t.b.x, t.b.y}});
    return all;
}

template <int D>
void check_losses(const TestScene& scene, const OctreeConfig& config) {
    std::vector<Simplex<D>> polygons = flattened<D>(scene.triangles);
    if (is_sanitized && polygons.size() > 60) polygons.resize(60);
    const auto tree = OrthtreeBuilder<D>::build(polygons, config);
    const LossFinderOfOrthtree<D> finder(tree, polygons);
    INFO(scene.name << ", D = " << D);
    CHECK(finder.losses() == std::vector<std::string>{});
    if (config.straddlers == Straddlers::duplicate)
        for (const OrthtreeNode& node : tree.nodes) REQUIRE((node.is_leaf() || node.count == 0));
}

/// In a tree that keeps them: each polygon once, in a cell that reaches around it.
template <int D>
void check_kept(const TestScene& scene, double looseness) {
    const std::vector<Simplex<D>> polygons = flattened<D>(scene.triangles);
    const auto tree = OrthtreeBuilder<D>::build(
        polygons, {.straddlers = Straddlers::keep, .looseness = looseness});
    std::vector<int> named(polygons.size(), 0);
    INFO(scene.name << ", D = " << D << ", looseness " << looseness);
    tree.for_each_cell([&](std::uint32_t index, const OrthtreeCell<D>& cell) {
        const OrthtreeBox<D> box = tree.frame.box(cell);
        const double half = 0.5 * tree.frame.cell_edge(cell.depth);
        for (const std::uint32_t polygon : tree.own(index)) {
            ++named[polygon];
            for (int corner = 0; corner < D && cell.depth > 0; ++corner)
                for (int axis = 0; axis < D; ++axis) {
                    const double off =
                        std::abs(polygons[polygon][corner][axis] - box.centre()[axis]);
                    REQUIRE(off <= looseness * half * (1.0 + 1e-12) +
                                       1e-15 * std::abs(box.centre()[axis]));
                }
        }
    });
    CHECK(named == std::vector<int>(polygons.size(), 1));
}

/// Many needles in one place, of which no cut frees a ray: every level could double them.
std::vector<Triangle> needles(std::uint32_t count) {
    Pcg32 random(7);
    std::vector<Triangle> all;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 off = random_point(random, 0.0f, 1e-6f);
        const Point3 a = off, b = Point3(1.0f, 0.61f, 0.37f) + off;
        all.push_back({a, b, (a + b) * 0.5f + Point3(0.0f, 1e-6f, 0.0f)});
    }
    return all;
}

}  // namespace

TEST_CASE("wherever a polygon has a point in a cell, a node on the way there names it") {
    for (const TestScene& scene : some_of(adversarial_scenes())) {
        check_losses<3>(scene, {});
        check_losses<2>(scene, {});
        check_losses<2>(scene, {.costs = {.traversal = 0.0}, .max_leaf_size = 1});
        check_losses<3>(scene, {.straddlers = Straddlers::keep});
    }
}

TEST_CASE("a tree that keeps straddlers names each once, where the cell holds all of it") {
    for (const TestScene& scene : some_of(adversarial_scenes()))
        for (const double looseness : {1.0, 1.3, 2.0}) {
            check_kept<3>(scene, looseness);
            check_kept<2>(scene, looseness);
        }
}

TEST_CASE("a loose tree has room for a polygon at the depth where cells are no smaller than it") {
    Pcg32 random(5);
    std::vector<Triangle> triangles = scenes::soup(3'000, 1.0f, 5);
    for (Triangle& t : triangles) {
        const float scale = std::ldexp(1.0f, -int(random.below(12)));
        t = {t.a, t.a + (t.b - t.a) * scale, t.a + (t.c - t.a) * scale};
    }
    const auto tree = OrthtreeBuilder<3>::build(triangles, {.straddlers = Straddlers::keep,
                                                            .looseness = 2.0,
                                                            .costs = {.traversal = 0.0},
                                                            .max_leaf_size = 0});
    tree.for_each_cell([&](std::uint32_t index, const OrthtreeCell<3>& cell) {
        for (const std::uint32_t i : tree.own(index)) {
            const Aabb box = bounds(triangles[i]);
            const Double3 extent = Double3(box.max) - Double3(box.min);
            const double longest = std::max({extent.x, extent.y, extent.z});
            // It may have found room one level deeper, and never less deep.
            if (cell.depth < max_orthtree_depth<3> && !tree.nodes[index].is_leaf())
                CHECK(longest > tree.frame.cell_edge(cell.depth + 1));
            CHECK(longest <= 2.0 * tree.frame.cell_edge(cell.depth));
        }
    });
}

TEST_CASE("a cell at depth i has an edge of s / 2^i, and lies in its parent's") {
    const auto triangles = scenes::soup(500, 0.2f, 3);
    const auto tree = OrthtreeBuilder<3>::build(triangles);
    std::size_t nodes = 0, deepest = 0;
    tree.for_each_cell([&](std::uint32_t, const OrthtreeCell<3>& cell) {
        ++nodes;
        deepest = std::max<std::size_t>(deepest, cell.depth);
        const OrthtreeBox<3> box = tree.frame.box(cell);
        const double edge = tree.frame.edge / std::pow(2.0, double(cell.depth));
        REQUIRE(box.max - box.min == Double3(edge));
        if (cell.depth == 0) return;
        const OrthtreeBox<3> parent = tree.frame.box(cell.parent());
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(parent.min[axis] <= box.min[axis]);
            REQUIRE(box.max[axis] <= parent.max[axis]);
        }
    });
    CHECK(nodes == tree.nodes.size());
    CHECK(deepest == tree.depth);
}

TEST_CASE("references stay below max_growth for each polygon, nodes below that times the depth") {
    for (const double growth : {1.0, 3.0, 16.0}) {
        const auto triangles = needles(300);
        const auto tree = OrthtreeBuilder<3>::build(
            triangles, {.costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_growth = growth});
        CHECK(double(tree.references.size()) <= growth * double(triangles.size()));
        CHECK(tree.nodes.size() <= tree.depth * tree.references.size() + 1);
    }
    const auto unbounded = [] {
        return OrthtreeBuilder<3>::build(needles(300), {.costs = {.traversal = 0.0},
                                                        .max_leaf_size = 1,
                                                        .max_growth = 1e9,
                                                        .max_references = 100'000});
    };
    CHECK_THROWS_AS(unbounded(), LimitError);
}

TEST_CASE("the same triangles give the same tree, node by node") {
    for (const Straddlers straddlers : {Straddlers::duplicate, Straddlers::keep}) {
        const OctreeConfig config{.straddlers = straddlers};
        const auto triangles = scenes::soup(2'000, 0.1f, 11);
        const auto tree = OrthtreeBuilder<3>::build(triangles, config),
                   again = OrthtreeBuilder<3>::build(triangles, config);
        CHECK(tree.nodes == again.nodes);
        CHECK(tree.references == again.references);
        for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
            const auto own = tree.own(i);
            REQUIRE(std::is_sorted(own.begin(), own.end()));
        }
    }
}

TEST_CASE("a builder tells every node once, and what it tells is what the tree becomes") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        void observe(const OrthtreeBuilder<2>::Chosen& chosen) {
            ++nodes;
            cuts += chosen.is_cut;
            if (!chosen.is_cut) references += chosen.polygons.size();
            if (chosen.is_cut)
                for (const std::uint8_t children : chosen.children) REQUIRE(children != 0);
        }
        std::size_t nodes = 0, cuts = 0, references = 0;
    } watcher;
    const auto segments = flattened<2>(scenes::soup(200, 0.1f, 9));
    const auto tree = OrthtreeBuilder<2>::build(segments, {}, watcher);
    std::size_t inner = 0;
    for (const OrthtreeNode& node : tree.nodes) inner += !node.is_leaf();
    CHECK(watcher.nodes == tree.nodes.size());
    CHECK(watcher.cuts == inner);
    CHECK(watcher.references == tree.references.size());
}

}  // namespace space
