/// @file
/// The same tree in its plainest layout, to see what the layout costs: a pointer to each child.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_nodes.hpp"
#include "common/geometry.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace space {

/// A node with a place for each child, empty or not: 80 bytes in space, each node an allocation of
/// its own, wherever that may lie.
template <int D>
struct PointerNode {
    std::array<std::unique_ptr<PointerNode>, orthants<D>> children;
    std::uint32_t first = 0, count = 0;  ///< what it names among the references
    std::uint32_t mask = 0;              ///< bit k is set where child k is not empty

    bool is_leaf() const { return mask == 0; }
    bool has(std::uint32_t k) const { return children[k] != nullptr; }
    const PointerNode* child(std::uint32_t k) const { return children[k].get(); }
};

/// A copy of a tree, for the same walks. References are those of the tree that it was made from.
template <int D>
class PointerOrthtree {
  public:
    using Handle = const PointerNode<D>*;

    explicit PointerOrthtree(const OrthtreeNodes<D>& tree)
        : frame(tree.frame), bounds(tree.bounds), looseness(tree.looseness) {
        if (!tree.empty()) root_ = copy(tree, tree.root());
    }
    bool empty() const { return root_ == nullptr; }
    Handle root() const { return root_.get(); }
    const PointerNode<D>& node(Handle handle) const { return *handle; }
    /// Without what the allocator adds to each node.
    std::size_t bytes() const { return nodes_ * sizeof(PointerNode<D>); }

    OrthtreeFrame<D> frame;
    BasicAabb<D> bounds;
    double looseness;

  private:
    std::unique_ptr<PointerNode<D>> copy(const OrthtreeNodes<D>& tree, std::uint32_t index) {
        ++nodes_;
        auto node = std::make_unique<PointerNode<D>>();
        const OrthtreeNode old = tree.node(index);
        node->first = old.first, node->count = old.count, node->mask = old.mask;
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            if (old.has(k)) node->children[k] = copy(tree, old.child(k));
        return node;
    }

    std::unique_ptr<PointerNode<D>> root_;
    std::size_t nodes_ = 0;
};

}  // namespace space
