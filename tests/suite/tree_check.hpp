/// @file
/// What must hold in every tree of boxes, with a diagnosis when it does not.
#pragma once

#include "common/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace space {

/// What a structure hands over of each of its nodes; node 0 is the root. A leaf has no children.
struct TreeNode {
    Aabb box;
    std::vector<std::uint32_t> children;
    std::vector<std::uint32_t> triangles;
};

/// Which of the rules a structure keeps, beyond those of every tree.
struct TreeRules {
    bool boxes_hold_triangles = true;  ///< bounding volumes: a leaf's box contains its triangles
    bool tight = false;                ///< a box is no larger than its triangles need
    bool cells_hold_pieces = false;    ///< cells of space: where a triangle passes through a leaf's
                                       ///< cell, the leaf names it
    bool once = true;                  ///< each triangle is in exactly one leaf
    std::size_t max_leaf_size = std::numeric_limits<std::size_t>::max();
};

namespace detail {

/// "exceeds parent by 1e-07 on x", for the axis where it is worst; empty where `inner` lies within
/// `outer`.
inline std::string excess(const Aabb& inner, const Aabb& outer) {
    double worst = 0.0;
    int worst_axis = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (const double beyond : {double{outer.min[axis]} - double{inner.min[axis]},
                                    double{inner.max[axis]} - double{outer.max[axis]}})
            if (beyond > worst) worst = beyond, worst_axis = axis;
    return worst > 0.0 ? fmt::format("by {:.3g} on {}", worst, "xyz"[worst_axis]) : std::string();
}

inline bool is_nan(const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::isnan(box.min[axis]) || std::isnan(box.max[axis])) return true;
    return false;
}

/// Points of a triangle: of a grid of weights, its corners among them.
inline std::vector<Double3> sample_points(const Triangle& triangle) {
    constexpr int steps = 6;
    std::vector<Double3> points;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j)
            points.push_back((double(i) * Double3(triangle.a) + double(j) * Double3(triangle.b) +
                              double(steps - i - j) * Double3(triangle.c)) /
                             double{steps});
    return points;
}

/// The box holds the point, or misses it by no more than `slack`.
inline bool holds(const Aabb& box, const Double3& p, double slack) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.min[axis] - slack <= p[axis] && p[axis] <= box.max[axis] + slack)) return false;
    return true;
}

}  // namespace detail

/// All faults, each a phrase such as "node 37: child 41 exceeds parent by 1e-07 on x" or "triangle
/// 12 in no leaf"; none for a good tree.
inline std::vector<std::string> tree_faults(std::span<const TreeNode> nodes,
                                            std::span<const Triangle> triangles,
                                            const TreeRules& rules = {}) {
    std::vector<std::string> faults;
    const auto fault = [&]<class... T>(fmt::format_string<T...> text, T&&... values) {
        faults.push_back(fmt::format(text, std::forward<T>(values)...));
    };
    if (nodes.empty()) {
        if (!triangles.empty()) fault("no nodes for {} triangles", triangles.size());
        return faults;
    }

    // The shape first: what follows relies on it.
    std::vector<int> parents(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const std::uint32_t child : nodes[i].children) {
            if (child >= nodes.size())
                fault("node {}: child {} is none of the {} nodes", i, child, nodes.size());
            else
                ++parents[child];
        }
    if (parents[0] > 0) fault("node 0: the root is somebody's child");
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (parents[i] == 0) fault("node {}: no parent", i);
        if (parents[i] > 1) fault("node {}: {} parents", i, parents[i]);
    }
    if (!faults.empty()) return faults;
    std::vector<std::uint32_t> reached{0};
    for (std::size_t next = 0; next < reached.size(); ++next)
        for (const std::uint32_t child : nodes[reached[next]].children) reached.push_back(child);
    if (reached.size() !=
        nodes.size()) {  // every node has one parent, so the rest go round in circles
        fault("{} nodes cannot be reached from the root", nodes.size() - reached.size());
        return faults;
    }

    std::vector<int> leaves_with(triangles.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const TreeNode& node = nodes[i];
        if (detail::is_nan(node.box)) fault("node {}: box is not a number", i);
        Aabb content;
        for (const std::uint32_t child : node.children) {
            content.extend(nodes[child].box);
            if (const std::string by = detail::excess(nodes[child].box, node.box);
                !by.empty() && !nodes[child].box.is_empty())
                fault("node {}: child {} exceeds parent {}", i, child, by);
        }
        if (!node.children.empty() && !node.triangles.empty())
            fault("node {}: has children and triangles", i);
        if (node.triangles.size() > rules.max_leaf_size)
            fault("node {}: {} triangles in a leaf, {} allowed", i, node.triangles.size(),
                  rules.max_leaf_size);
        for (const std::uint32_t id : node.triangles) {
            if (id >= triangles.size()) {
                fault("node {}: triangle {} is none of the {}", i, id, triangles.size());
                continue;
            }
            ++leaves_with[id];
            const Aabb box = bounds(triangles[id]);
            content.extend(box);
            if (!rules.boxes_hold_triangles) continue;
            if (const std::string by = detail::excess(box, node.box); !by.empty())
                fault("node {}: triangle {} exceeds its leaf {}", i, id, by);
        }
        std::vector<std::uint32_t> ids = node.triangles;
        std::sort(ids.begin(), ids.end());
        if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
            fault("node {}: triangle {} twice in the leaf", i, *twice);
        if (rules.tight && !node.box.is_empty())
            if (const std::string by = detail::excess(node.box, content); !by.empty())
                fault("node {}: box is larger than its content {}", i, by);
    }
    for (std::size_t id = 0; id < triangles.size(); ++id) {
        if (leaves_with[id] == 0) fault("triangle {} in no leaf", id);
        if (rules.once && leaves_with[id] > 1)
            fault("triangle {} in {} leaves", id, leaves_with[id]);
    }

    if (rules.cells_hold_pieces) {
        const Vector3 extent = nodes[0].box.extent();
        const double slack =
            1e-6 *
            std::max({extent.x, extent.y, extent.z});  // what rounding a split's position may move
        for (std::size_t id = 0; id < triangles.size(); ++id)
            for (const Double3& p : detail::sample_points(triangles[id])) {
                const auto in_leaf = [&](const TreeNode& node, double margin) {
                    return node.children.empty() && detail::holds(node.box, p, margin);
                };
                const auto named = [&](const TreeNode& node) {
                    return in_leaf(node, slack) &&
                           std::find(node.triangles.begin(), node.triangles.end(), id) !=
                               node.triangles.end();
                };
                if (std::any_of(nodes.begin(), nodes.end(), named)) continue;
                const auto leaf =
                    std::find_if(nodes.begin(), nodes.end(),
                                 [&](const TreeNode& node) { return in_leaf(node, 0.0); });
                if (leaf == nodes.end()) continue;  // outside the tree's box
                fault("node {}: triangle {} passes through the cell, and the leaf does not name it",
                      leaf - nodes.begin(), id);
                break;
            }
    }
    return faults;
}

/// The faults in one line, the first few of them.
inline std::string diagnosis(const std::vector<std::string>& faults) {
    constexpr std::size_t shown = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(shown, faults.size()); ++i)
        text += (i ? "; " : "") + faults[i];
    if (faults.size() > shown) text += fmt::format("; and {} more", faults.size() - shown);
    return text;
}

}  // namespace space
