/// @file
/// BSP trees (Fuchs, Kedem & Naylor 1980) for segments in the plane and polygons in space: what a
/// tree is, and what can be asked of it. bsp_builder.hpp makes one.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// Where a point lies, seen from a closed mesh.
enum class Location { outside, inside, boundary };

/// The tree over segments (D = 2) or polygons (D = 3).
template <int D>
struct BspTree {
    static constexpr std::uint32_t none = ~0u;  ///< no node

    /// Every node has a cell, the part of space that the planes above it leave to it. Its own plane
    /// cuts that in two: everything in the front half is below `front`, everything in the back half
    /// below `back`; what lies in the plane, facing either way, is its own. Where a child is none,
    /// its cell is empty.
    struct Node {
        std::uint32_t plane;
        std::uint32_t front = none, back = none;
        std::uint32_t first = 0, count = 0;  ///< of the tree's fragments
    };

    std::vector<Simplex<D>> polygons;  ///< the input
    std::vector<SplitPlane<D>> planes;
    std::vector<Node> nodes;  ///< the root first; none for no polygons
    std::vector<Fragment<D>> fragments;

    // [back_to_front]
    /// Painter's order (Fuchs, Kedem & Naylor 1980, section 3): calls draw(fragment) from the
    /// farthest to the nearest as seen from the eye, in a tree made by cutting (shared polygons
    /// stick out of their cells). What lies behind a plane, seen from the eye, can't cover what
    /// lies before it; to an eye in the plane neither half covers the other, and either order is
    /// right. The stack is our own: a tree may be deeper than the machine's stack.
    template <class Draw>
    void back_to_front(const Point<D>& eye, const Draw& draw) const {
        struct Task {
            std::uint32_t node;
            bool own;  ///< only the node's own fragments
        };
        std::vector<Task> tasks{{nodes.empty() ? none : 0, false}};
        while (!tasks.empty()) {
            const auto [index, own] = tasks.back();
            tasks.pop_back();
            if (index == none) continue;
            const Node& node = nodes[index];
            if (own) {
                for (std::uint32_t i = 0; i < node.count; ++i) draw(fragments[node.first + i]);
                continue;
            }
            const bool in_front = side_of(eye, node) >= 0;
            tasks.push_back({in_front ? node.front : node.back, false});
            tasks.push_back({index, true});
            tasks.push_back({in_front ? node.back : node.front, false});
        }
    }
    // [back_to_front]

    // [locate]
    /// Inside or outside of the closed mesh that the tree was built from by cutting, front sides
    /// outwards. An empty cell in front of the last polygon's plane touches that polygon's front. A
    /// point on a plane is asked of both sides (Thibault & Naylor 1987): it is on the boundary
    /// where the empty cells around it differ.
    Location locate(const Point<D>& p) const {
        if (nodes.empty()) return Location::outside;
        bool inside = false, outside = false;
        std::vector<std::uint32_t> to_visit{0};
        while (!to_visit.empty()) {
            const Node& node = nodes[to_visit.back()];
            to_visit.pop_back();
            const int side = side_of(p, node);
            if (side >= 0 && node.front != none) to_visit.push_back(node.front);
            if (side <= 0 && node.back != none) to_visit.push_back(node.back);
            outside = outside || (side >= 0 && node.front == none);
            inside = inside || (side <= 0 && node.back == none);
        }
        return inside && outside ? Location::boundary
               : inside          ? Location::inside
                                 : Location::outside;
    }
    // [locate]

    /// Exactly: 1 in front of the node's plane, 0 on it, -1 behind.
    int side_of(const Point<D>& p, const Node& node) const {
        const SplitPlane<D>& plane = planes[node.plane];
        if (const auto side = side_filter(plane, Double<D>(p), 0.0)) return *side;
        return exact_side<D>(plane.through, p);
    }

    /// Edges from the root to the deepest node; 0 for a root alone. A node stands before its
    /// children.
    std::size_t depth() const {
        std::vector<std::size_t> level(nodes.size());
        std::size_t deepest = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (const std::uint32_t child : {nodes[i].front, nodes[i].back})
                if (child != none) {
                    level[child] = level[i] + 1;
                    deepest = std::max(deepest, level[i] + 1);
                }
        return deepest;
    }
};

}  // namespace space
