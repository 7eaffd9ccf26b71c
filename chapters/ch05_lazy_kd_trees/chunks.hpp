/// @file
/// An array that grows while other threads read it: nothing in it ever moves.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>

namespace space {

/// A row of chunks. The first is to be long enough for nearly always: memory that is only reserved
/// costs nothing until it is written. Each later one is as long as all before it, so that an index
/// tells by its highest bit in which it is. Threads add at the end; a thread may use what it has
/// added, and what another has told it of.
template <class T>
class Chunks {
    static_assert(std::is_trivial_v<T>, "elements begin as whatever memory holds");

  public:
    explicit Chunks(std::size_t expected)
        : first_length_(std::bit_ceil(static_cast<std::uint32_t>(
              std::clamp<std::size_t>(expected, 64, std::size_t{1} << 31)))),
          first_(std::make_unique_for_overwrite<T[]>(first_length_)) {}

    // [at]
    T& operator[](std::uint32_t index) const {
        if (index < first_length_) [[likely]]
            return first_[index];
        return later_[std::bit_width(index)].load(
            std::memory_order_acquire)[index ^ std::bit_floor(index)];
    }
    // [at]

    /// The index of the first of `count` new elements, which lie side by side in one chunk.
    /// @throws std::bad_alloc where there is no memory, or would be more than `most` elements
    std::uint32_t add(std::size_t count, std::uint32_t most) {
        std::uint32_t end = end_.load(std::memory_order_relaxed);
        std::uint64_t first;
        do {
            first = end;
            while (first + count > end_of_chunk(first)) first = end_of_chunk(first);
            if (first + count > most) throw std::bad_alloc();
        } while (!end_.compare_exchange_weak(end, static_cast<std::uint32_t>(first + count),
                                             std::memory_order_relaxed));
        if (count > 0) make(static_cast<std::uint32_t>(first));
        return static_cast<std::uint32_t>(first);
    }

    /// Makes the chunk of an element that another array, of the same expected length, has added.
    void make(std::uint32_t index) {
        if (index < first_length_) return;
        std::atomic<T*>& chunk = later_[std::bit_width(index)];
        if (chunk.load(std::memory_order_acquire)) return;
        const std::lock_guard guard(growing_);  // the one lock: each chunk is made once
        if (!chunk.load()) chunk.store(new T[std::bit_floor(index)], std::memory_order_release);
    }

    Chunks(const Chunks&) = delete;
    Chunks& operator=(const Chunks&) = delete;
    ~Chunks() {
        for (auto& chunk : later_) delete[] chunk.load();
    }

  private:
    std::uint64_t end_of_chunk(std::uint64_t index) const {
        return index < first_length_ ? first_length_ : 2 * std::bit_floor(index);
    }

    std::uint32_t first_length_;
    std::unique_ptr<T[]> first_;
    std::array<std::atomic<T*>, 33> later_ = {};  ///< by the number of bits of an index
    std::atomic<std::uint32_t> end_{0};
    std::mutex growing_;
};

}  // namespace space
