/// @file
/// The exact part of a polygon in a cell, in rational numbers: what a k-d tree must not lose.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace space {

template <int D>
using ExactPoint = std::array<mpq_class, std::size_t(D)>;
/// Corners in their order; none where nothing is left.
template <int D>
using ExactPart = std::vector<ExactPoint<D>>;

template <int D>
ExactPart<D> exact_part(const Simplex<D>& polygon) {
    ExactPart<D> part;
    for (int corner = 0; corner < D; ++corner) {
        ExactPoint<D> p;
        for (int axis = 0; axis < D; ++axis) p[std::size_t(axis)] = double{polygon[corner][axis]};
        part.push_back(p);
    }
    return part;
}

/// What lies where sign * x[axis] <= sign * position.
template <int D>
ExactPart<D> exactly_clipped(const ExactPart<D>& part, std::size_t axis, const mpq_class& position,
                             int sign) {
    ExactPart<D> kept;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const ExactPoint<D>&from = part[i], &to = part[(i + 1) % part.size()];
        const mpq_class before = sign * (position - from[axis]),
                        after = sign * (position - to[axis]);
        if (before >= 0) kept.push_back(from);
        if ((before < 0 && after > 0) || (before > 0 && after < 0)) {
            const mpq_class s = (position - from[axis]) / (to[axis] - from[axis]);
            ExactPoint<D> cut;
            for (std::size_t k = 0; k < std::size_t(D); ++k)
                cut[k] = from[k] + s * (to[k] - from[k]);
            kept.push_back(cut);
        }
    }
    return kept;
}
template <int D>
ExactPart<D> exactly_clipped(ExactPart<D> part, const BasicAabb<D>& cell) {
    for (int axis = 0; axis < D; ++axis) {
        part = exactly_clipped<D>(part, std::size_t(axis), double{cell.min[axis]}, -1);
        part = exactly_clipped<D>(part, std::size_t(axis), double{cell.max[axis]}, 1);
    }
    return part;
}

/// Finds what a tree loses: a polygon must be named, by a leaf or by a node above it, wherever it
/// has a point in the leaf's cell; of what lies wholly in a node's plane, below it or above it.
template <int D>
class LossFinder {
  public:
    LossFinder(const KdNodes<D>& tree, std::span<const Simplex<D>> polygons) : tree_(tree) {
        names_.resize(tree.nodes.size());
        if (!tree.nodes.empty()) collect(0);
        for (std::uint32_t i = 0; i < polygons.size(); ++i) {
            const ExactPart<D> all = exact_part<D>(polygons[i]);
            if (exactly_clipped<D>(all, tree.box) != all) lose(i, 0);  // the root's box holds all
            if (!tree.nodes.empty()) descend(0, i, all);
        }
    }
    /// "polygon 3 at node 12", one a loss.
    const std::vector<std::string>& losses() const { return losses_; }

  private:
    void collect(std::uint32_t index) {
        const auto own = tree_.own(index);
        names_[index].insert(own.begin(), own.end());
        const KdNode node = tree_.nodes[index];
        if (node.is_leaf()) return;
        for (const std::uint32_t child : {node.below(), node.below() + 1}) {
            collect(child);
            names_[index].insert(names_[child].begin(), names_[child].end());
        }
    }
    void lose(std::uint32_t polygon, std::uint32_t node) {
        losses_.push_back("polygon " + std::to_string(polygon) + " at node " +
                          std::to_string(node));
    }
    void descend(std::uint32_t index, std::uint32_t polygon, const ExactPart<D>& part) {
        if (names_[index].count(polygon) == 0) return lose(polygon, index);
        for (const std::uint32_t own : tree_.own(index))
            if (own == polygon) return;
        const KdNode node = tree_.nodes[index];
        const auto axis = std::size_t(node.axis());
        const mpq_class position = double{node.position()};
        bool below = false, above = false;
        for (const ExactPoint<D>& corner : part) {
            below = below || corner[axis] < position;
            above = above || corner[axis] > position;
        }
        if (!below && !above)  // in the plane: either half will do
            (names_[node.below()].count(polygon) ? below : above) = true;
        if (below) descend(node.below(), polygon, exactly_clipped<D>(part, axis, position, 1));
        if (above) descend(node.below() + 1, polygon, exactly_clipped<D>(part, axis, position, -1));
    }

    const KdNodes<D>& tree_;
    std::vector<std::set<std::uint32_t>> names_;  ///< by node, of its whole subtree
    std::vector<std::string> losses_;
};

}  // namespace space
