/// @file
/// What is counted of collapses, of visits, of leaves and of margins, as plain values: the same on
/// every machine.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch10 {

/// One binary tree, collapsed in one way, and diffuse rays through it.
struct CollapsePoint {
    std::string scene;
    std::string_view way;
    int width = 0;  ///< most children of a node
    std::uint64_t triangles = 0, nodes = 0, blocks = 0, bytes = 0;
    std::uint64_t places_used = 0;  ///< of all nodes
    double cost = 0.0;              ///< expected of a ray that meets the root's box
    std::uint64_t rays = 0, nodes_visited = 0, blocks_tested = 0;

    double full() const { return double(places_used) / double(width * nodes); }
    double bytes_per_triangle() const { return double(bytes) / double(triangles); }
};

/// How many children a visit to a node of eight meets.
struct MetPoint {
    std::string scene;
    std::array<std::uint64_t, 9> visits = {};  ///< by the number of children

    std::uint64_t all() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t some : visits) sum += some;
        return sum;
    }
    double share(std::size_t met) const { return double(visits[met]) / double(all()); }
};

/// What a ray visits if a node's children are taken in one order.
struct OrderPoint {
    std::string scene;
    std::string_view order;
    std::uint64_t rays = 0, nodes = 0, blocks = 0;
};

/// What the float filter says of the triangles that rays come to.
struct FilterPoint {
    std::string scene;
    std::string_view rays;       ///< how they were chosen
    std::uint64_t lanes = 0;     ///< triangles that were tested
    std::uint64_t left = 0;      ///< of them, for the exact test
    std::uint64_t hits = 0;      ///< of these
    std::uint64_t lost = 0;      ///< hits that the filter has thrown out
    std::uint64_t sure = 0;      ///< hits that it was sure of
    std::uint64_t invented = 0;  ///< of what it was sure of, misses
    double largest = 0.0;        ///< error of a volume over the bound

    double left_share() const { return double(left) / double(lanes); }
};

/// Rays at edges and vertices, answered by leaves without the filter and the exact test.
struct PlainLeafPoint {
    std::string scene;
    std::uint64_t rays = 0;
    std::uint64_t plain_wrong = 0;  ///< by leaves in plain float
    std::uint64_t wrong = 0;        ///< by the chapter's
};

/// Near and far planes of random rays, beside the exact t.
struct SlabErrorPoint {
    double away = 0.0;  ///< of the scene, which has size 1, from the origin
    std::uint64_t planes = 0;
    std::uint64_t unsafe = 0;               ///< near planes too late, far ones too early
    std::uint64_t unsafe_fused = 0;         ///< the same with one fused instruction a plane
    std::uint64_t unsafe_fused_safely = 0;  ///< and with the margin that it needs
    double largest = 0.0;                   ///< error over margin, of the kernels'
};

/// Rays that leave a triangle that lies in a plane across an axis, and whether they are said to
/// meet its box.
struct ReturnPoint {
    std::string scene;
    std::uint64_t rays = 0, ours = 0, fused = 0;

    double share_of_ours() const { return double(ours) / double(rays); }
    double share_of_fused() const { return double(fused) / double(rays); }
};

/// All of it.
struct WalkCounts {
    std::vector<CollapsePoint> collapses;
    std::vector<MetPoint> met;
    std::vector<OrderPoint> orders;
    std::vector<FilterPoint> filter;
    std::vector<PlainLeafPoint> plain_leaves;
    std::vector<SlabErrorPoint> slabs;
    std::vector<ReturnPoint> returns;
};

}  // namespace space::ch10
