/// @file
/// Points in the order of their Morton codes.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// Codes at the finest depth, ascending, and the indices of their points; of equal codes the lower
/// index first.
struct MortonOrder {
    std::vector<std::uint64_t> codes = {};
    std::vector<std::uint32_t> indices = {};
};

// [morton_order]
/// Of fewer than 2^32 finite points.
template <int D>
MortonOrder morton_order(const OrthtreeFrame<D>& frame, std::span<const Point<D>> points) {
    std::vector<CodedIndex> items(points.size()), scratch;
    for (std::uint32_t i = 0; i < points.size(); ++i) items[i] = {morton_code(frame, points[i]), i};
    radix_sort(items, scratch);
    MortonOrder order;
    order.codes.reserve(items.size());
    order.indices.reserve(items.size());
    for (const auto& [code, index] : items) {
        order.codes.push_back(code);
        order.indices.push_back(index);
    }
    return order;
}
// [morton_order]

}  // namespace space
