/// @file
/// What may be chosen about a k-d tree before it is built.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/sah_sweep.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace space {

/// What a builder may choose.
struct KdTreeConfig {
    /// Where a cell is cut.
    enum class Rule {
        middle,  ///< axes in turn, in the middle of the cell
        median,  ///< axes in turn, at the median of the boxes' middles
        sah,     ///< any axis, where the surface area heuristic finds the least cost
    };
    /// What becomes of polygons on both sides of a plane.
    enum class Straddlers {
        duplicate,  ///< both halves name them, wherever their bounding boxes reach
        clip,       ///< both halves name them, where the part in the cell reaches: perfect splits
        keep,       ///< the inner node names them
        split,  ///< each half names its piece, cut from the parent's piece and rounded to float:
                ///< what rounding takes away, rays lose
    };

    Rule rule = Rule::sah;
    Straddlers straddlers = Straddlers::clip;
    SahCosts costs = {};
    std::size_t max_leaf_size = 4;  ///< of middle and median
    /// Middle and median don't cut where more than this share straddles: both halves would be about
    /// as hard as the whole.
    double max_straddling = 0.75;
    /// Edges from the root to the deepest leaf: 8 + 1.3 log2 n unless it is given, and never more
    /// than KdTree's stack can hold.
    std::optional<std::size_t> max_depth = {};
    /// Limits memory.
    std::size_t max_references = KdNode::largest;
    /// Planes to take first, one for each node that has more than max_leaf_size polygons, below
    /// before above.
    std::span<const KdSplit> planned = {};
    bool mailboxes = true;  ///< no triangle is tested twice in a row by one ray (KdTree)
};

/// The largest depth of all trees, by which the stack of a ray's walk is sized.
inline constexpr std::size_t max_kd_depth = 60;

}  // namespace space
