/// @file
/// Exercise 10.1, a near miss: each node opens the child with the largest area until it has four.
/// That is best for the node and not for the tree: a child with four grandchildren would have been
/// full as it was, and opened it leaves two nodes that are half empty.
#pragma once

#include <cstddef>
#include <cstdint>
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
    std::vector<bool> stays(tree.size());
    std::vector<std::uint32_t> waiting;
    if (!tree.empty()) waiting.push_back(0);
    while (!waiting.empty()) {
        const std::uint32_t index = waiting.back();
        waiting.pop_back();
        if (tree[index].is_leaf()) continue;
        stays[index] = true;
        std::vector<std::uint32_t> children{tree[index].first, tree[index].first + 1};
        while (children.size() < 4) {
            std::size_t largest = children.size();
            for (std::size_t i = 0; i < children.size(); ++i)
                if (!tree[children[i]].is_leaf() &&
                    (largest == children.size() ||
                     tree[children[i]].area > tree[children[largest]].area))
                    largest = i;
            if (largest == children.size()) break;
            const std::uint32_t opened = children[largest];
            children[largest] = tree[opened].first;
            children.push_back(tree[opened].first + 1);
        }
        waiting.insert(waiting.end(), children.begin(), children.end());
    }
    return stays;
}

}  // namespace space
