/// @file
/// Exercise 10.1, our answer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace space {

/// Of a binary tree: an inner node, whose two children stand side by side and behind it, or a leaf.
struct BinaryNode {
    double area = 0.0;        ///< of its box
    std::uint32_t first = 0;  ///< of the two children; 0 for a leaf

    bool is_leaf() const { return first == 0; }
};

/// For each node of the tree, of which the first is the root: whether it stays. Leaves do not count
/// as nodes that stay.
inline std::vector<bool> nodes_that_stay(std::span<const BinaryNode> tree) {
    /// What all below a node costs if the node may fill up to so many places in the one above.
    std::vector<std::array<double, 5>> cost(tree.size());
    /// How `places` are best shared by two children.
    struct Share {
        double cost = std::numeric_limits<double>::infinity();
        std::size_t first = 0;  ///< places of the first child
    };
    const auto share = [&](const BinaryNode& node, std::size_t places) {
        Share best;
        for (std::size_t k = 1; k < places; ++k) {
            const double both = cost[node.first][k] + cost[node.first + 1][places - k];
            if (both < best.cost) best = {both, k};
        }
        return best;
    };
    for (std::size_t i = tree.size(); i-- > 0;) {
        if (tree[i].is_leaf()) continue;
        const double as_node = tree[i].area + share(tree[i], 4).cost;
        for (std::size_t places = 1; places <= 4; ++places)
            cost[i][places] = std::min(as_node, share(tree[i], places).cost);
    }
    std::vector<bool> stays(tree.size());
    std::vector<std::size_t> places(tree.size(), 1);
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (tree[i].is_leaf()) continue;
        const Share whole = share(tree[i], 4), part = share(tree[i], places[i]);
        stays[i] = tree[i].area + whole.cost <= part.cost;
        const std::size_t first = stays[i] ? whole.first : part.first;
        places[tree[i].first] = first;
        places[tree[i].first + 1] = (stays[i] ? 4 : places[i]) - first;
    }
    return stays;
}

}  // namespace space
