// The same cells as CGAL's quadtree and octree, over the same points with the same rule.
#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_search.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <CGAL/Octree.h>
#include <CGAL/Quadtree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <type_traits>
#include <vector>

namespace space {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
template <int D>
using CgalPoint = std::conditional_t<D == 2, Kernel::Point_2, Kernel::Point_3>;
template <int D>
using CgalPoints = std::vector<CgalPoint<D>>;

/// A cell, by its depth and place, and what is in it.
template <int D>
using Key = std::pair<std::uint32_t, std::array<std::uint32_t, D>>;
template <int D>
using Coordinates = std::array<double, D>;
template <int D>
struct Contents {
    bool is_leaf = true;
    std::vector<Coordinates<D>> points = {};  ///< sorted

    bool operator==(const Contents&) const = default;
};
template <int D>
using Cells = std::map<Key<D>, Contents<D>>;

template <int D, class Node, class Range>
void insert(Cells<D>& cells, std::size_t depth, const Node& place, bool is_leaf,
            const Range& points) {
    Key<D> key{std::uint32_t(depth), {}};
    for (std::size_t axis = 0; axis < D; ++axis) key.second[axis] = place[axis];
    Contents<D> contents{is_leaf};
    for (const auto& p : points) {
        Coordinates<D> coordinates;
        for (int axis = 0; axis < D; ++axis) coordinates[std::size_t(axis)] = p[axis];
        contents.points.push_back(coordinates);
    }
    std::ranges::sort(contents.points);
    cells[key] = std::move(contents);
}

template <int D>
using CgalTree = std::conditional_t<D == 2, CGAL::Quadtree<Kernel, CgalPoints<2>>,
                                    CGAL::Octree<Kernel, CgalPoints<3>>>;

// CGAL 6 has nodes by number, and no longer enlarges the root; up to 5 nodes are handles.
#if CGAL_VERSION_NR >= 1060000000
template <int D>
Cells<D> cells_of_cgal(CgalPoints<D> points, std::size_t max_depth, std::size_t leaf_size) {
    CgalTree<D> tree(points);
    tree.refine(max_depth, leaf_size);
    Cells<D> cells;
    for (const auto node : tree.traverse(CGAL::Orthtrees::Preorder_traversal<CgalTree<D>>(tree)))
        insert<D>(cells, tree.depth(node), tree.global_coordinates(node), tree.is_leaf(node),
                  tree.data(node));
    return cells;
}
#else
template <int D>
Cells<D> cells_of_cgal(CgalPoints<D> points, std::size_t max_depth, std::size_t leaf_size) {
    CgalTree<D> tree(points, {}, 1.0);
    tree.refine(max_depth, leaf_size);
    Cells<D> cells;
    for (const auto& node : tree.template traverse<CGAL::Orthtrees::Preorder_traversal>())
        insert<D>(cells, node.depth(), node.global_coordinates(), node.is_leaf(), node);
    return cells;
}
#endif

/// Ours, and empty leaves, which have no node, made up for.
template <int D>
Cells<D> cells_of(const OrthtreePoints<D>& tree) {
    Cells<D> cells;
    for (const auto& node : tree.cells.nodes) {
        const auto cell = tree.cells.cell(node);
        insert<D>(cells, cell.depth, cell.place, node.is_leaf(),
                  std::span(tree.points).subspan(node.first, node.size()));
        for (std::uint32_t k = 0; k < orthants<D> && !node.is_leaf(); ++k)
            if (!tree.cells.child(node, k))
                insert<D>(cells, cell.depth + 1, cell.child(k).place, true,
                          std::vector<Point<D>>{});
    }
    return cells;
}

enum class Places { uniform, clustered, grid, duplicates, near_planes };

/// In the unit cube, two of whose corners are points, too: that makes it the root of both trees.
template <int D>
std::vector<Point<D>> some_points(Places places, std::size_t count) {
    Pcg32 random(10 * D + std::uint64_t(places));
    std::vector<Point<D>> points{Point<D>(0.0f), Point<D>(1.0f)};
    for (std::size_t i = 0; i < count; ++i) {
        Point<D> p = random_point(random, BasicAabb<D>{Point<D>(0.0f), Point<D>(1.0f)});
        for (int axis = 0; axis < D; ++axis) {
            float& x = p[axis];
            if (places == Places::clustered) x = 0.3f + 1e-3f * x * x;
            if (places == Places::grid) x = std::floor(17.0f * x) / 16.0f;
            if (places == Places::duplicates) x = std::floor(4.0f * x) * 0.3f;
            if (places == Places::near_planes) {
                const float towards = float(random.below(3)) - 1.0f;
                x = std::nextafter(std::floor(64.0f * x) / 64.0f, towards * 9.0f + x);
            }
            x = std::clamp(x, 0.0f, 1.0f);
        }
        points.push_back(p);
    }
    return points;
}

template <int D>
CgalPoints<D> to_cgal(const std::vector<Point<D>>& points) {
    CgalPoints<D> theirs;
    for (const Point<D>& p : points)
        if constexpr (D == 2)
            theirs.emplace_back(p.x, p.y);
        else
            theirs.emplace_back(p.x, p.y, p.z);
    return theirs;
}

template <int D>
void compare_cells(std::size_t count) {
    for (const Places places : {Places::uniform, Places::clustered, Places::grid,
                                Places::duplicates, Places::near_planes}) {
        const auto points = some_points<D>(places, count);
        for (const auto& [max_depth, leaf_size] :
             {std::pair{10u, 20u}, std::pair{4u, 1u}, std::pair{20u, 3u}}) {
            CAPTURE(D, int(places), max_depth, leaf_size);
            const auto ours =
                OrthtreePoints<D>::build(points, {.leaf_size = leaf_size, .max_depth = max_depth});
            REQUIRE(ours.frame.edge == 1.0);
            const Cells<D> theirs = cells_of_cgal<D>(to_cgal<D>(points), max_depth, leaf_size);
            REQUIRE(theirs.size() > orthants<D>);
            CHECK((cells_of<D>(ours) == theirs));
        }
    }
}

}  // namespace

TEST_CASE("the same cells, the same leaves and the same points in them as CGAL's quadtree") {
    compare_cells<2>(5'000);
}
TEST_CASE("the same cells, the same leaves and the same points in them as CGAL's octree") {
    compare_cells<3>(5'000);
}

TEST_CASE("O1: CGAL's octree of a thousand coincident points has 71 leaves, too") {
    std::vector<Point3> points(1'000, Point3(0.3f));
    points.push_back(Point3(0.0f));
    points.push_back(Point3(1.0f));
    const Cells<3> theirs = cells_of_cgal<3>(to_cgal<3>(points), 10, 20);
    CHECK(std::ranges::count_if(theirs, [](const auto& c) { return c.second.is_leaf; }) == 71);
    const auto ours = OrthtreePoints<3>::build(points, {.leaf_size = 20, .max_depth = 10});
    CHECK((cells_of<3>(ours) == theirs));
}

TEST_CASE("the nearest points are as far as those of CGAL's octree") {
    // Coordinates are multiples of 2^-20, so that CGAL's squares in double are exact.
    Pcg32 random(3);
    std::vector<Point3> points{Point3(0.0f), Point3(1.0f)};
    const auto drawn = [&] {
        return glm::round(random_point(random, 0.0f, 1.0f) * 0x1p20f) * 0x1p-20f;
    };
    for (int i = 0; i < 3'000; ++i) points.push_back(drawn());
    const auto ours = OrthtreePoints<3>::build(points);
    CgalPoints<3> theirs = to_cgal<3>(points);
#if CGAL_VERSION_NR >= 1060000000
    CgalTree<3> tree(theirs);
#else
    CgalTree<3> tree(theirs, {}, 1.0);
#endif
    tree.refine(10, 8);
    for (int i = 0; i < 2'000; ++i) {
        const Point3 query = drawn();
        CgalPoints<3> found;
#if CGAL_VERSION_NR >= 1060000000
        tree.nearest_k_neighbors({query.x, query.y, query.z}, 5, std::back_inserter(found));
#else
        tree.nearest_neighbors({query.x, query.y, query.z}, 5, std::back_inserter(found));
#endif
        const auto best = k_nearest<3, OrthtreeSearch<3>>(ours, query, 5);
        REQUIRE(found.size() == best.size());
        for (std::size_t j = 0; j < 5; ++j)
            REQUIRE(CGAL::squared_distance(found[j], CgalPoint<3>(query.x, query.y, query.z)) ==
                    best[j].squared_distance);
    }
}

}  // namespace space
