// Where quadtrees and octrees fail: of each failure a test in which the plain method fails, by how
// much, and the cure holds. (O4, and O3 in codes, stand with the linear tree.)
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace space {
namespace {

/// Nodes of the plain recursive quadtree that is cut while two points share a cell, and stops at
/// `limit` levels because it must stop somewhere.
std::size_t plain_nodes(const std::vector<Point3>& points, const OrthtreeFrame<3>& frame,
                        const OrthtreeCell<3>& cell, std::uint32_t limit) {
    std::size_t inside = 0;
    for (const Point3& p : points) inside += frame.cell_of(p, cell.depth) == cell;
    if (inside <= 1 || cell.depth == limit) return 1;
    std::size_t nodes = 1;
    for (std::uint32_t k = 0; k < 8; ++k) nodes += plain_nodes(points, frame, cell.child(k), limit);
    return nodes;
}

std::vector<Triangle> as_triangles(const std::vector<Point3>& points) {
    std::vector<Triangle> all;
    for (const Point3& p : points) all.push_back({p, p, p});
    return all;
}

}  // namespace

TEST_CASE("O1: coincident points are cut until the depth limit; a chain without empty nodes") {
    std::vector<Point3> points(1000, Point3(0.3f));
    points.push_back(Point3(1.0f));
    const auto frame = OrthtreeFrame<3>::around({Point3(0.0f), Point3(1.0f)});
    // Each level that the limit allows costs a block of eight nodes, and separates nothing.
    CHECK(plain_nodes(points, frame, {}, 10) == 1 + 8 * 10);
    CHECK(plain_nodes(points, frame, {}, 20) == 1 + 8 * 20);

    const auto tree = Octree<>::build(as_triangles(points), {.max_leaf_size = 1});
    CHECK(tree.shape().depth == max_orthtree_depth<3>);
    CHECK(tree.shape().nodes <= 1 + 2 + max_orthtree_depth<3>);
    CHECK(tree.shape().references == points.size());
    // Copies of a triangle that no cut frees: no reference is made for nothing.
    const std::vector<Triangle> copies(1000, Triangle{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, 1}});
    CHECK(Octree<>::build(copies).shape().references <= 8 * copies.size());
}

TEST_CASE("O2: strict comparisons lose points on planes, closed ones double them, half-open none") {
    constexpr std::uint32_t depth = 4, cells = 1u << depth;
    const OrthtreeFrame<3> frame;
    std::size_t points = 0, lost = 0, copies = 0;
    for (std::uint32_t i = 0; i < 17 * 17 * 17; ++i) {
        const Point3 p(float(i % 17) / 16.0f, float(i / 17 % 17) / 16.0f, float(i / 289) / 16.0f);
        const OrthtreeCell<3> own = frame.cell_of(p, depth);
        std::size_t strict = 1, closed = 1;  // cells that hold the point: products over the axes
        for (int axis = 0; axis < 3; ++axis) {
            std::size_t inside = 0, on = 0;
            for (std::uint32_t place = 0; place < cells; ++place) {
                const double low = frame.plane(axis, depth, place),
                             high = frame.plane(axis, depth, place + 1);
                inside += low < p[axis] && p[axis] < high;
                on += low <= p[axis] && p[axis] <= high;
            }
            strict *= inside, closed *= on;
            REQUIRE(own.place[std::size_t(axis)] ==
                    std::min(static_cast<std::uint32_t>(p[axis] * 16.0f), cells - 1));
        }
        ++points, lost += strict == 0, copies += closed - 1;
    }
    fmt::print("  of {} points on planes strict cells lose {}, closed ones make {} copies\n",
               points, lost, copies);
    CHECK(points == 4913);
    CHECK(lost == points);
    CHECK(copies == 32 * 32 * 32 - points);
}

TEST_CASE("O3: equal cells see a teapot in a stadium as one; an octree goes down to it") {
    // A dense patch in 10^-3 of the cube, and the cube.
    std::vector<Triangle> triangles = scenes::mapped(
        scenes::soup(2'000, 0.05f, 3), [](const Point3& p) { return p * 1e-3f + Point3(0.3f); });
    triangles.push_back({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    triangles.push_back({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}});
    const auto tree = Octree<>::build(triangles);
    const auto largest_leaf = [](const OrthtreeNodes<3>& nodes) {
        std::size_t largest = 0;
        for (std::uint32_t i = 0; i < nodes.nodes.size(); ++i)
            largest = std::max(largest, nodes.own(i).size());
        return largest;
    };
    // As many equal cells as the tree has nodes: a grid of 2^(3 d).
    std::uint32_t depth = 0;
    while ((1u << 3 * (depth + 1)) <= tree.nodes().nodes.size()) ++depth;
    const auto even = Octree<>::build(triangles, {.max_depth = depth});
    fmt::print("  {} nodes: the fullest cell has {} triangles; of equal ones {}\n",
               tree.nodes().nodes.size(), largest_leaf(tree.nodes()), largest_leaf(even.nodes()));
    CHECK(largest_leaf(even.nodes()) == 2'000);
    CHECK(largest_leaf(tree.nodes()) < 40);
}

}  // namespace space
