/// @file
/// A model of a processor's caches: which of a walk's accesses they would serve, counted, so that
/// every machine gives the same numbers, also one whose counters a program may not read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// One cache: how much it holds, and in how many places of it a line may stand (its ways).
struct CacheShape {
    std::size_t bytes, ways;

    bool operator==(const CacheShape&) const = default;
};

/// The caches of one core of an Intel Cascade Lake (2019), the nearest first; of the last one,
/// which cores share, all.
inline std::vector<CacheShape> stated_caches() {
    return {{std::size_t{32} << 10, 8}, {std::size_t{1} << 20, 16}, {std::size_t{36} << 20, 12}};
}

inline constexpr std::size_t cache_line = 64;  ///< bytes

// [cache_level]
/// A cache whose sets each forget the line that was not used for the longest time (LRU). Processors
/// forget by a cheaper rule that is nearly this one, and fetch lines before they are asked for.
class CacheLevel {
  public:
    explicit CacheLevel(const CacheShape& shape)
        : ways_(shape.ways),
          sets_(shape.bytes / (shape.ways * cache_line)),
          lines_(sets_ * ways_, no_line) {}

    /// Whether the line is there; it is afterwards, as its set's latest.
    bool touch(std::uint64_t line) {
        const auto set = lines_.begin() + static_cast<std::ptrdiff_t>(line % sets_ * ways_);
        const auto end = set + static_cast<std::ptrdiff_t>(ways_);
        const auto found = std::find(set, end, line);
        const bool is_there = found != end;
        std::move_backward(set, is_there ? found : end - 1, is_there ? found + 1 : end);
        *set = line;
        return is_there;
    }

  private:
    static constexpr std::uint64_t no_line = ~std::uint64_t{0};

    std::size_t ways_, sets_;
    std::vector<std::uint64_t> lines_;  ///< a set's lines side by side, the latest first
};
// [cache_level]

/// Caches one behind the other: a line is looked for in the nearest, then in the next, and stands
/// in all of them afterwards.
class CacheModel {
  public:
    explicit CacheModel(const std::vector<CacheShape>& shapes) : misses_(shapes.size()) {
        for (const CacheShape& shape : shapes) levels_.emplace_back(shape);
    }

    /// All lines that these bytes lie in.
    void touch(std::uint64_t address, std::size_t bytes) {
        const std::uint64_t last = (address + bytes - 1) / cache_line;
        for (std::uint64_t line = address / cache_line; line <= last; ++line) {
            ++lines_;
            for (std::size_t i = 0; i < levels_.size(); ++i) {
                if (levels_[i].touch(line)) break;
                ++misses_[i];
            }
        }
    }
    void forget_counts() {
        lines_ = 0;
        std::ranges::fill(misses_, 0);
    }

    std::uint64_t lines() const { return lines_; }  ///< asked for
    /// Lines that were in none of the levels up to this one.
    const std::vector<std::uint64_t>& misses() const { return misses_; }

  private:
    std::vector<CacheLevel> levels_;
    std::uint64_t lines_ = 0;
    std::vector<std::uint64_t> misses_;
};

}  // namespace space
