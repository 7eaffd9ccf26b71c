/// @file
/// Chapter 6's structures: octrees.
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

#include <algorithm>

namespace space {
namespace {

using Straddlers = OctreeConfig::Straddlers;

Structure offer_octree(std::string_view name, std::string_view about, Straddlers straddlers,
                       double looseness) {
    return offer<Octree>(name, about, [=](OctreeConfig& config, const Limits& limits) {
        config.straddlers = straddlers;
        config.looseness = looseness;
        config.max_references = std::min(config.max_references, limits.references);
    });
}

}  // namespace

std::vector<Structure> ch06_structures() {
    return {
        offer_octree("octree", "octree, straddlers in all cells that they overlap (chapter 6)",
                     Straddlers::duplicate, 1.0),
        offer_octree("octree-loose",
                     "loose octree: each triangle in one cell, which reaches twice as far",
                     Straddlers::keep, 2.0),
        offer<LinearOctree>("octree-linear",
                            "linear octree: triangles sorted by code, cells with boxes"),
    };
}

}  // namespace space
