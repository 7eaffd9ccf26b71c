// Trees over sorted codes: cells, ranges and chains. Catalogue O1 and O2.
#include "chapters/ch06_quadtrees_and_octrees/linear_orthtree.hpp"

#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace space {
namespace {

template <int D>
std::vector<Point<D>> clustered_points(std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    const BasicAabb<D> unit{Point<D>(0.0f), Point<D>(1.0f)};
    std::vector<Point<D>> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Point<D> p = random_point(random, unit);
        points.push_back(i % 3 == 0   ? p
                         : i % 3 == 1 ? 0.3f + 1e-4f * p
                                      : 0.5f * glm::floor(8.0f * p));
    }
    return points;
}

/// Whether the cell at this depth holds the point, by its corners.
template <int D>
bool holds(const OrthtreeFrame<D>& frame, const OrthtreeCell<D>& cell, const Point<D>& p) {
    const OrthtreeBox<D> box = frame.box(cell), root = frame.box();
    for (int axis = 0; axis < D; ++axis) {
        const double x = p[axis];
        if (x < box.min[axis] || x > box.max[axis]) return false;
        if (x == box.max[axis] && box.max[axis] != root.max[axis]) return false;
    }
    return true;
}

/// Each node: its range is what its cell holds, its children part it, and it is split when it must.
template <int D>
void check_nodes(const OrthtreePoints<D>& tree, const LinearOrthtreeConfig& config) {
    const auto& cells = tree.cells;
    std::vector<int> parents(cells.nodes.size());
    for (const auto& node : cells.nodes) {
        const OrthtreeCell<D> cell = cells.cell(node);
        REQUIRE(node.size() > 0);
        for (std::uint32_t place = 0; place < tree.size; ++place)
            REQUIRE(holds(tree.frame, cell, tree.point(place)) ==
                    (node.first <= place && place < node.last));
        const bool at_limit = node.depth >= std::min(config.max_depth, max_orthtree_depth<D>);
        REQUIRE(node.is_leaf() == (node.size() <= config.leaf_size || at_limit));
        std::uint32_t next = node.first;
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            if (const auto* child = cells.child(node, k)) {
                REQUIRE(child->first == next);
                next = child->last;
                REQUIRE(cells.cell(*child).ancestor(node.depth + 1u) == cell.child(k));
                if (!config.skip_chains) REQUIRE(child->depth == node.depth + 1);
                ++parents[std::size_t(child - cells.nodes.data())];
            }
        if (!node.is_leaf()) REQUIRE(next == node.last);
        if (config.skip_chains && !node.is_leaf()) REQUIRE(cells.children(node).size() > 1);
        REQUIRE(node.depth <= cells.depth);
        REQUIRE(node.depth <= config.max_depth);
    }
    REQUIRE(parents[0] == 0);
    REQUIRE(std::count(parents.begin(), parents.end(), 1) == std::ptrdiff_t(parents.size() - 1));
}

template <int D>
void check_trees() {
    for (const std::size_t count : {1u, 8u, 9u, 300u})
        for (const bool skip_chains : {false, true})
            for (const std::uint32_t max_depth : {0u, 3u, 31u}) {
                const LinearOrthtreeConfig config{
                    .leaf_size = 4, .max_depth = max_depth, .skip_chains = skip_chains};
                const auto points = clustered_points<D>(count, count);
                const auto tree = OrthtreePoints<D>::build(points, config);
                check_nodes(tree, config);
                for (std::uint32_t place = 0; place < count; ++place)
                    REQUIRE(tree.point(place) == points[tree.index(place)]);
                auto indices = tree.indices;
                std::ranges::sort(indices);
                for (std::uint32_t i = 0; i < count; ++i) REQUIRE(indices[i] == i);
            }
}

}  // namespace

TEST_CASE("a node's range is what its half-open cell holds, and its children part it") {
    check_trees<2>();
    check_trees<3>();
}

TEST_CASE("no points make an empty tree, and one point one leaf") {
    CHECK(OrthtreePoints<3>::build({}).cells.empty());
    const auto one = OrthtreePoints<2>::build(std::vector<Point2>{{3, 4}});
    CHECK(one.cells.nodes.size() == 1);
    CHECK(one.cells.nodes[0].is_leaf());
}

TEST_CASE("a point that is not finite, or outside of a given root, is refused by its number") {
    std::vector<Point3> points(5, Point3(0.5f));
    points[3].y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(OrthtreePoints<3>::build(points), "orthtree: point 3 is not finite");
    points[3].y = infinity;
    CHECK_THROWS_WITH(OrthtreePoints<3>::build(points), "orthtree: point 3 is not finite");
    points[3].y = std::nextafter(1.0f, 2.0f);
    CHECK_THROWS_WITH(OrthtreePoints<3>::build(points, OrthtreeFrame<3>{}),
                      "orthtree: point 3 lies outside of the root");
    points[3].y = 1.0f;
    CHECK_NOTHROW(OrthtreePoints<3>::build(points, OrthtreeFrame<3>{}));
}

TEST_CASE("the builder tells every node once, when its children are there") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::vector<OrthtreeCell<2>> cells;
        void observe(const LinearOrthtree<2>::Made& made) {
            CHECK(made.node == cells.size());
            cells.push_back(made.cell);
        }
    } watcher;
    const std::vector<Point2> points{{0, 0}, {1, 1}, {0.9f, 0.9f}};
    OrthtreePoints<2>::build(points, OrthtreeFrame<2>{}, {.leaf_size = 1, .max_depth = 3}, watcher);
    CHECK(watcher.cells == std::vector<OrthtreeCell<2>>{
                               {0, {0, 0}}, {1, {0, 0}}, {1, {1, 1}}, {2, {3, 3}}, {3, {7, 7}}});
}

// ---- catalogue --------------------------------------------------------------------------------

namespace {

std::size_t inner_nodes(const LinearOrthtree<3>& tree) {
    return std::size_t(std::ranges::count_if(tree.nodes, [](auto& n) { return !n.is_leaf(); }));
}
/// Empty ones, too.
std::size_t all_leaves(const LinearOrthtree<3>& tree) {
    return 7 * inner_nodes(tree) + 1;
}

}  // namespace

TEST_CASE("O1: a thousand coincident points end at the depth limit, in one leaf that overflows") {
    std::vector<Point3> points(1'000, Point3(0.3f));
    for (const bool with_another : {false, true}) {
        if (with_another) points.push_back(Point3(1.0f));
        const auto tree = OrthtreePoints<3>::build(points, OrthtreeFrame<3>{},
                                                   {.leaf_size = 20, .max_depth = 10});
        CHECK(tree.cells.depth == 10);
        CHECK(all_leaves(tree.cells) == 71);
        const auto& deepest = tree.cells.nodes.back();
        CHECK(deepest.size() == 1'000);
        CHECK(deepest.is_leaf());
    }
}

TEST_CASE("O1: without chains two points that share 20 digits take one inner node, not 21") {
    const std::vector<Point3> points{Point3(0.0f), Point3(0x1p-21f)};
    const auto chain = OrthtreePoints<3>::build(points, OrthtreeFrame<3>{}, {.leaf_size = 1});
    CHECK(chain.cells.nodes.size() == 23);
    const auto jump =
        OrthtreePoints<3>::build(points, OrthtreeFrame<3>{}, {.leaf_size = 1, .skip_chains = true});
    CHECK(jump.cells.nodes.size() == 3);
    CHECK(jump.cells.depth == 21);
    CHECK(jump.cells.cell(jump.cells.nodes[0]) == OrthtreeCell<3>{20, {0, 0, 0}});
}

namespace {

/// How a careless splitter hands its points down to depth 4: the lower child takes those below the
/// middle, the upper one those above; on the middle, neither or both do.
std::size_t handed_down(const std::vector<Point3>& points, Point3 low, float edge, int levels,
                        bool closed) {
    if (levels == 0) return points.size();
    std::size_t sum = 0;
    for (int k = 0; k < 8; ++k) {
        const float half = edge / 2;
        const Point3 corner = low + half * Point3(k & 1, k >> 1 & 1, k >> 2 & 1);
        std::vector<Point3> child;
        for (const Point3& p : points) {
            bool taken = true;
            for (int axis = 0; axis < 3; ++axis) {
                const float middle = low[axis] + half;
                const bool upper = (k >> axis) & 1;
                const bool inside = upper ? p[axis] > middle : p[axis] < middle;
                taken = taken && (inside || (closed && p[axis] == middle));
            }
            if (taken) child.push_back(p);
        }
        sum += handed_down(child, corner, half, levels - 1, closed);
    }
    return sum;
}

std::vector<Point3> sixteenths() {
    std::vector<Point3> points;
    for (int i = 0; i < 17 * 17 * 17; ++i)
        points.push_back(Point3(i % 17, i / 17 % 17, i / 289) / 16.0f);
    return points;
}

}  // namespace

TEST_CASE("O2: of points on boundaries strict cells lose nearly all, closed ones hold copies") {
    const std::vector<Point3> points = sixteenths();
    REQUIRE(points.size() == 4913);
    CHECK(handed_down(points, Point3(0.0f), 1.0f, 4, false) == 8);  // the root's corners
    CHECK(handed_down(points, Point3(0.0f), 1.0f, 4, true) == 4913 + 27'855);
}

TEST_CASE("O2: half-open cells hold each point on a boundary once") {
    const std::vector<Point3> points = sixteenths();
    const auto tree =
        OrthtreePoints<3>::build(points, OrthtreeFrame<3>{}, {.leaf_size = 0, .max_depth = 4});
    std::size_t leaves = 0, held = 0;
    for (const auto& node : tree.cells.nodes)
        if (node.is_leaf()) {
            ++leaves;
            held += node.size();
            const OrthtreeCell<3> cell = tree.cells.cell(node);
            // The last cell on an axis has two of its 17 coordinates: the root is closed there.
            std::uint32_t wanted = 1;
            for (const std::uint32_t along : cell.place) wanted *= along == 15 ? 2 : 1;
            REQUIRE(node.size() == wanted);
        }
    CHECK(leaves == 16 * 16 * 16);
    CHECK(held == 4913);
}

}  // namespace space
