/// @file
/// Sorting by Morton code: a stable radix sort, from the lowest digit to the highest (Knuth, The
/// Art of Computer Programming 3, 5.2.5). Its time grows as the number of items, whatever the
/// codes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace space {

/// A code, and the index of what it belongs to.
struct CodedIndex {
    std::uint64_t code;
    std::uint32_t index;

    bool operator==(const CodedIndex&) const = default;
};

/// What a sort moved, to be held against the machine's memory bandwidth.
struct RadixSortWork {
    std::size_t items = 0;
    int passes = 0;  ///< digits in which the codes differ

    /// Every item is read once to count digits; each pass reads and writes it.
    std::size_t bytes_moved() const {
        return items * sizeof(CodedIndex) * static_cast<std::size_t>(1 + 2 * passes);
    }
};

// [radix_sort]
/// By code; items of equal code stay in their order. A digit that all codes have in common needs no
/// pass. `scratch` becomes as long as `items`, and keeps its memory from sort to sort; nothing else
/// is allocated. Fewer than 2^32 items.
inline RadixSortWork radix_sort(std::vector<CodedIndex>& items, std::vector<CodedIndex>& scratch) {
    constexpr int digit_bits = 8, digits = 64 / digit_bits;
    constexpr std::size_t values = std::size_t{1} << digit_bits;
    const auto digit_of = [](std::uint64_t code, int digit) {
        return static_cast<std::size_t>(code >> (digit * digit_bits)) & (values - 1);
    };
    std::array<std::array<std::uint32_t, values>, digits> counts{};
    for (const CodedIndex& item : items)
        for (int digit = 0; digit < digits; ++digit)
            ++counts[std::size_t(digit)][digit_of(item.code, digit)];

    RadixSortWork work{.items = items.size()};
    scratch.resize(items.size());
    for (int digit = 0; digit < digits; ++digit) {
        auto& next = counts[std::size_t(digit)];
        if (items.empty() || next[digit_of(items.front().code, digit)] == items.size()) continue;
        std::uint32_t before = 0;  // from counts to the place of the first item of each value
        for (std::uint32_t& count : next) before += std::exchange(count, before);
        for (const CodedIndex& item : items) scratch[next[digit_of(item.code, digit)]++] = item;
        std::swap(items, scratch);
        ++work.passes;
    }
    return work;
}
// [radix_sort]

}  // namespace space
