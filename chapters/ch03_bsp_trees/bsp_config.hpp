/// @file
/// What may be chosen about a BSP tree before it is built.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace space {

/// What a builder may choose.
struct BspConfig {
    /// How a node's plane is chosen.
    enum class SplitterChoice {
        first,          ///< the first of the set
        random,         ///< any of the set
        balanced,       ///< of the candidates, the one with |front| nearest to |back|
        fewest_splits,  ///< of the candidates, the one that cuts fewest
        weighted,       ///< of the candidates, the least |front| - |back| + split_weight cuts
        free,  ///< weighted, and where all candidates are lopsided a plane across an axis that no
               ///< polygon lies in
    };
    /// Straddling polygons are cut, or put whole into both subtrees (Heinonen16, section 3.1.1).
    enum class Straddlers { split, share };

    SplitterChoice splitter = SplitterChoice::weighted;
    Straddlers straddlers = Straddlers::split;
    Grade grade = Grade::exact;
    std::uint32_t candidates = 8;  ///< polygons tried for each splitter
    double split_weight = 8.0;     ///< how many polygons of imbalance a cut is worth avoiding
    double lopsided = 0.1;         ///< below this share on the smaller side a free plane is tried
    /// Of planes that aren't exact: times roundoff times the largest coordinate.
    double thickness_in_roundings = 8.0;
    std::uint64_t seed = 1;  ///< of the random choices
    /// Limits memory.
    std::size_t max_fragments = std::numeric_limits<std::uint32_t>::max();
    /// Limits time: polygons that all nodes together may place; n^2 / 2 in a chain.
    std::uint64_t max_placed = std::numeric_limits<std::uint64_t>::max();
    /// Splitters to take first, by polygon, where they are in the set.
    std::span<const std::uint32_t> order = {};
};

/// The thickness of planes that aren't exact, in scene units.
template <int D>
double thickness_of_planes(std::span<const Simplex<D>> polygons, const BspConfig& config) {
    float largest = 0.0f;
    for (const Simplex<D>& polygon : polygons)
        for (int corner = 0; corner < D; ++corner)
            for (int axis = 0; axis < D; ++axis)
                if (std::isfinite(polygon[corner][axis]))
                    largest = std::max(largest, std::abs(polygon[corner][axis]));
    const bool floats = config.grade == Grade::thick_float || config.grade == Grade::ordered_float;
    const double roundoff = floats ? 0x1p-24 : double_roundoff;
    return config.thickness_in_roundings * roundoff * static_cast<double>(largest);
}

}  // namespace space
