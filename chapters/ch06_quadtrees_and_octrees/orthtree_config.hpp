/// @file
/// What may be chosen about a quadtree or octree over segments or triangles before it is built.
#pragma once

#include "chapters/ch04_kd_trees/sah_sweep.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace space {

/// What a builder may choose.
struct OctreeConfig {
    /// What becomes of polygons that reach into several children.
    enum class Straddlers {
        duplicate,  ///< every child names them whose closed cell they overlap
        keep,       ///< the lowest cell names them that holds them whole
    };
    /// How a ray finds the children that it passes.
    enum class Walk {
        parametric,  ///< all of them by where it meets the planes that they share
        plain,       ///< each by a slab test of its own
    };

    Straddlers straddlers = Straddlers::duplicate;
    /// Where straddlers are kept, a cell reaches this many times as far from its centre: 1 for
    /// cells as they are, above it for a loose tree. (At 2 a polygon finds room at the depth where
    /// it is no longer than a cell: Ulrich 2000, "Loose Octrees".)
    double looseness = 1.0;
    /// A cell is cut where that lowers the expected cost of a ray, as in chapter 4; at a traversal
    /// cost of 0, wherever it spares tests. A ray finds its way among eight children in about twice
    /// the time that it takes at a plane between two.
    SahCosts costs = {.traversal = 2.0};
    std::size_t max_leaf_size = 2;  ///< a cell with so few is not cut
    std::uint32_t max_depth = max_orthtree_depth<3>;
    /// On no way from the root to a leaf do cuts multiply references by more than this. So there
    /// are at most that many for each polygon: see OrthtreeBuilder.
    double max_growth = 8.0;
    std::size_t max_references = 1u << 31;  ///< limits memory
    bool mailboxes = true;  ///< no triangle is tested twice in a row by one ray (Octree)
    Walk walk = Walk::parametric;
};

}  // namespace space
