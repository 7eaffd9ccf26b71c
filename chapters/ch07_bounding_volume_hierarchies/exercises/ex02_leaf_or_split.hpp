/// @file
/// Exercise 7.2: Leaf or split
/// Difficulty 1 of 3, about 25 minutes.
///
/// A builder has some ways to cut a node's triangles in two, and has to choose the cheapest, or to
/// leave the node as it is. As a leaf it costs a ray one test for each of its triangles. Cut in
/// two, it costs a step, and the tests in each part that the ray meets; and a ray that meets the
/// node's box meets a part's with the chance (surface of the part's box) / (surface of the node's).
///
/// A course note has this as "the sum of the total surface areas of the child volumes". What is
/// missing there? The check has a case in which it makes a difference.
///
/// Boxes may be flat: their surface is that of both faces. Where the node's box is a line no box
/// has a surface, and lengths take the place of areas; where it is a point, each ray that meets
/// it meets both parts. Of equally cheap cuts take the first; cut only if that is cheaper than the
/// leaf. Do it without `HitChance`, and for boxes as large as floats allow: their areas are too
/// large for floats.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace space {

/// A part of a node's triangles, with their box.
struct Part {
    Aabb box;
    std::size_t count = 0;
};

/// One way to cut them; neither part is empty.
struct PossibleCut {
    Part first, second;
};

/// The index of the best cut; nothing for a leaf.
inline std::optional<std::size_t> best_cut(const Part& node, std::span<const PossibleCut> cuts,
                                           const BvhCosts& costs) {
    // TODO: the first cut is not always the best, and a leaf may be better still
    static_cast<void>(node);
    static_cast<void>(costs);
    if (cuts.empty()) return std::nullopt;
    return 0;
}

}  // namespace space
