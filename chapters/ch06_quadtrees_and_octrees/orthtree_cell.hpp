/// @file
/// The cells of quadtrees (D = 2) and octrees (D = 3): a cube, halved on every axis again and
/// again. A cell is known by whole numbers; its corners are exact.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace space {

/// The largest depth of a cell: a place on each axis, one after the other, fills 62 or 63 bits.
template <int D>
inline constexpr std::uint32_t max_orthtree_depth = D == 2 ? 31 : 21;
/// How many children a cell has: quadrants or octants.
template <int D>
inline constexpr std::uint32_t orthants = 1u << D;
/// Those in the lower half of an axis, bit k for child k.
template <int D>
constexpr std::uint32_t lower_children(std::uint32_t axis) {
    std::uint32_t mask = 0;
    for (std::uint32_t k = 0; k < orthants<D>; ++k) mask |= (~k >> axis & 1u) << k;
    return mask;
}

// [orthtree_cell]
/// One cell of the grid that has 2^depth cells along an edge of the root.
template <int D>
struct OrthtreeCell {
    std::uint32_t depth = 0;
    std::array<std::uint32_t, D> place{};  ///< by axis, below 2^depth

    /// Bit `axis` of k is set for the upper half of that axis.
    OrthtreeCell child(std::uint32_t k) const {
        OrthtreeCell cell{depth + 1, place};
        for (std::size_t axis = 0; axis < D; ++axis)
            cell.place[axis] = place[axis] << 1 | (k >> axis & 1u);
        return cell;
    }
    OrthtreeCell parent() const { return ancestor(depth - 1); }
    /// The cell at a lesser depth in which this one lies.
    OrthtreeCell ancestor(std::uint32_t lesser) const {
        OrthtreeCell cell{lesser, place};
        for (std::uint32_t& along : cell.place) along >>= depth - lesser;
        return cell;
    }
    /// Which child of its parent it is.
    std::uint32_t orthant() const {
        std::uint32_t k = 0;
        for (std::size_t axis = 0; axis < D; ++axis) k |= (place[axis] & 1u) << axis;
        return k;
    }
    bool operator==(const OrthtreeCell&) const = default;
};
// [orthtree_cell]

/// A closed box whose corners are doubles.
template <int D>
struct OrthtreeBox {
    Double<D> min, max;

    Double<D> centre() const { return 0.5 * (min + max); }
    bool operator==(const OrthtreeBox&) const = default;
};

// [orthtree_frame]
/// The root's cube. Its edge is a power of two and its corner a multiple of 2^-(L + 1) edges, L the
/// largest depth, no farther from 0 than 2^(51 - L) edges: the corners and the centres of all cells
/// are such multiples, too, have at most 53 bits, and are exact as doubles.
template <int D>
struct OrthtreeFrame {
    Double<D> corner{0.0};  ///< the lowest
    double edge = 1.0;

    /// The smallest such cube that holds the box, which must be finite. A box that is small and far
    /// from 0 gets a cube that is larger than it: at least 2^-30 (D = 3) or 2^-20 (D = 2) of the
    /// largest coordinate. A box of floats is as small as that only where it is flat on the axis of
    /// that coordinate, or a few floats wide (D = 2).
    static OrthtreeFrame around(const BasicAabb<D>& box) {
        OrthtreeFrame frame;
        if (box.is_empty()) return frame;
        constexpr int depth = max_orthtree_depth<D>;
        double needed = 0.0;
        for (int axis = 0; axis < D; ++axis) {
            const double low = box.min[axis], high = box.max[axis];
            const double farthest = std::max(std::abs(low), std::abs(high));
            needed = std::max({needed, high - low, std::ldexp(farthest, depth - 51)});
        }
        if (needed == 0.0) return frame;  // one point, which is 0
        int exponent = 0;
        const double mantissa = std::frexp(needed, &exponent);
        frame.edge = std::ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
        while (!frame.place_at(box.min, box.max)) frame.edge *= 2.0;
        return frame;
    }

    /// The cell at this depth that holds the point: cells are half-open, what lies on a plane is in
    /// the upper one; only the root's upper faces belong to the cells below them. A point outside
    /// of the root is in the cell next to it; NaN counts as below the root.
    OrthtreeCell<D> cell_of(const Point<D>& point, std::uint32_t depth) const {
        OrthtreeCell<D> cell{depth, {}};
        const double size = cell_edge(depth), per_size = 1.0 / size, last = edge * per_size - 1.0;
        for (int axis = 0; axis < D; ++axis) {
            const double x = point[axis], along = (x - corner[axis]) * per_size;
            std::uint32_t& place = cell.place[static_cast<std::size_t>(axis)];
            // Arguments in this order: what is not a number goes to place 0.
            place = static_cast<std::uint32_t>(std::max(0.0, std::min(along, last)));
            // The difference may have been rounded, up to the next plane at most.
            if (place > 0 && x < corner[axis] + double(place) * size) --place;
        }
        return cell;
    }

    /// Where the cells at this depth meet, exactly.
    double plane(int axis, std::uint32_t depth, std::uint32_t place) const {
        return corner[axis] + double(place) * cell_edge(depth);
    }
    /// edge / 2^depth (BvhThesis13, lemma of section 2.1.2), exactly.
    double cell_edge(std::uint32_t depth) const { return edge / double(std::uint64_t{1} << depth); }
    OrthtreeBox<D> box(const OrthtreeCell<D>& cell) const {
        OrthtreeBox<D> result;
        for (int axis = 0; axis < D; ++axis)
            result.min[axis] = plane(axis, cell.depth, cell.place[static_cast<std::size_t>(axis)]);
        result.max = result.min + cell_edge(cell.depth);
        return result;
    }
    OrthtreeBox<D> box() const { return box({}); }

  private:
    /// Moves the corner to the last multiple that is not above `low`; whether the cube holds
    /// `high`.
    bool place_at(const Point<D>& low, const Point<D>& high) {
        const double grain = std::ldexp(edge, -1 - static_cast<int>(max_orthtree_depth<D>));
        bool holds = true;
        for (int axis = 0; axis < D; ++axis) {
            corner[axis] = std::floor(double{low[axis]} / grain) * grain;
            holds = holds && double{high[axis]} <= corner[axis] + edge;
        }
        return holds;
    }
};
// [orthtree_frame]

}  // namespace space
