/// @file
/// Morton codes (Morton 1966, "A Computer Oriented Geodetic Data Base and a New Technique in File
/// Sequencing"): the bits of a cell's place by turns, so that the order of codes is the order in
/// which a walk from the root comes to the cells, depth first.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"

#include <array>
#include <cstdint>
#include <tuple>

namespace space {

// [interleave]
/// Bits that one axis may have: 21 in space, so that three fit into 63, and 32 in the plane.
template <int D>
constexpr int morton_bits = 64 / D;

/// A step of spreading: bits that belong together move apart by `shift`; `mask` holds their places
/// after the step.
struct MortonStep {
    int shift;
    std::uint64_t mask;
};
template <int D>
constexpr std::array<MortonStep, 6> morton_steps{};
template <>
inline constexpr std::array<MortonStep, 6> morton_steps<2>{{{0, 0x00000000ffffffff},
                                                            {16, 0x0000ffff0000ffff},
                                                            {8, 0x00ff00ff00ff00ff},
                                                            {4, 0x0f0f0f0f0f0f0f0f},
                                                            {2, 0x3333333333333333},
                                                            {1, 0x5555555555555555}}};
template <>
inline constexpr std::array<MortonStep, 6> morton_steps<3>{{{0, 0x00000000001fffff},
                                                            {32, 0x001f00000000ffff},
                                                            {16, 0x001f0000ff0000ff},
                                                            {8, 0x100f00f00f00f00f},
                                                            {4, 0x10c30c30c30c30c3},
                                                            {2, 0x1249249249249249}}};

/// Bit i goes to bit D i. Bits from morton_bits<D> on are left out.
template <int D>
constexpr std::uint64_t spread_bits(std::uint32_t number) {
    std::uint64_t bits = number;
    const auto take = [&](const MortonStep& step) {
        bits = (bits | (bits << step.shift)) & step.mask;
    };
    std::apply([&](const auto&... step) { (take(step), ...); }, morton_steps<D>);  // no loop
    return bits;
}
/// Bit D i goes to bit i; all other bits are left out.
template <int D>
constexpr std::uint32_t gather_bits(std::uint64_t bits) {
    bits &= morton_steps<D>.back().mask;
    for (std::size_t step = morton_steps<D>.size(); --step > 0;)
        bits = (bits | (bits >> morton_steps<D>[step].shift)) & morton_steps<D>[step - 1].mask;
    return static_cast<std::uint32_t>(bits);
}

/// Bit i of axis a becomes bit D i + a: a digit of D bits for each depth, which is the number of
/// the child there.
template <int D>
constexpr std::uint64_t interleave(const std::array<std::uint32_t, D>& place) {
    std::uint64_t code = 0;
    for (std::size_t axis = 0; axis < D; ++axis) code |= spread_bits<D>(place[axis]) << axis;
    return code;
}
template <int D>
constexpr std::array<std::uint32_t, D> deinterleave(std::uint64_t code) {
    std::array<std::uint32_t, D> place{};
    for (std::size_t axis = 0; axis < D; ++axis) place[axis] = gather_bits<D>(code >> axis);
    return place;
}
// [interleave]

// [morton_code]
/// A cell's place as one number. Among cells of one depth it is the order of a walk that goes to
/// each cell's children by their numbers.
template <int D>
constexpr std::uint64_t morton_code(const OrthtreeCell<D>& cell) {
    return interleave<D>(cell.place);
}
/// Of the smallest cell that holds the point, which is finite.
template <int D>
std::uint64_t morton_code(const OrthtreeFrame<D>& frame, const Point<D>& point) {
    return morton_code(frame.cell_of(point, max_orthtree_depth<D>));
}
template <int D>
constexpr OrthtreeCell<D> cell_of_code(std::uint64_t code, std::uint32_t depth) {
    return {depth, deinterleave<D>(code)};
}
// [morton_code]

}  // namespace space
