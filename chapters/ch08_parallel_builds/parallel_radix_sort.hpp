/// @file
/// Chapter 6's radix sort, by all threads.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [parallel_radix_sort]
/// By code; items of equal code stay in their order. Each chunk counts its digits; then it is known
/// where the chunk's items of each digit go, behind those of the same digit in the chunks before
/// it; and each chunk puts them there, in nobody's way. @return the one of both in which they are
/// sorted
inline std::span<CodedIndex> parallel_radix_sort(std::span<CodedIndex> items,
                                                 std::span<CodedIndex> scratch, std::size_t chunk,
                                                 WorkStealing& threads) {
    constexpr int digit_bits = 8;
    constexpr std::size_t values = std::size_t{1} << digit_bits;
    const ChunksOf chunks{items.size(), chunk};
    std::vector<std::array<std::uint32_t, values>> places(chunks.count());
    for (int shift = 0; shift < 64; shift += digit_bits) {
        const auto digit_of = [shift](const CodedIndex& item) {
            return static_cast<std::size_t>(item.code >> shift) & (values - 1);
        };
        threads.for_each(chunks.count(), [&](std::size_t i) {
            places[i].fill(0);
            for (const CodedIndex& item : chunks(items, i)) ++places[i][digit_of(item)];
        });
        std::uint32_t before = 0;  // from counts to places
        bool is_sorted = true;     // all in one digit
        for (std::size_t value = 0; value < values; ++value) {
            const std::uint32_t begin = before;
            for (auto& of_chunk : places) before += std::exchange(of_chunk[value], before);
            is_sorted &= before == begin || before - begin == items.size();
        }
        if (is_sorted) continue;
        threads.for_each(chunks.count(), [&](std::size_t i) {
            for (const CodedIndex& item : chunks(items, i))
                scratch[places[i][digit_of(item)]++] = item;
        });
        std::swap(items, scratch);
    }
    return items;
}
// [parallel_radix_sort]

}  // namespace space
