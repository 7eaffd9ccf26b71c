/// @file
/// An array that grows while other threads read it: nothing in it ever moves.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>

namespace space {

/// A row of chunks, each twice as long as the one before it, and a directory of them. Threads add
/// at its end; a thread may use what it has added, and whatever another has told it of.
template <class T>
class Chunks {
  public:
    Chunks() = default;
    Chunks(const Chunks&) = delete;
    Chunks& operator=(const Chunks&) = delete;
    ~Chunks() {
        for (auto& chunk : directory_) delete[] chunk.load();
    }

    // [at]
    T& operator[](std::uint32_t index) const {
        const std::uint32_t place = index + first_length;
        return directory_[std::bit_width(place)].load(
            std::memory_order_acquire)[place ^ std::bit_floor(place)];
    }
    // [at]

    /// The index of the first of `count` new elements, which lie side by side in one chunk.
    /// @throws std::bad_alloc where there is no memory, or would be more than `most` elements
    std::uint32_t add(std::uint32_t count, std::uint32_t most) {
        std::uint32_t end = end_.load(std::memory_order_relaxed), first;
        do {
            std::uint64_t place = std::uint64_t{end} + first_length;
            std::uint64_t next = 2 * std::bit_floor(place);  // the start of the next chunk
            while (place + count > next) place = next, next *= 2;
            if (place + count > std::uint64_t{most} + first_length) throw std::bad_alloc();
            first = static_cast<std::uint32_t>(place - first_length);
        } while (!end_.compare_exchange_weak(end, first + count, std::memory_order_relaxed));
        if (count > 0) make_chunk_of(first + first_length);
        return first;
    }

  private:
    static constexpr std::uint32_t first_length = 64;

    /// The one lock: each chunk is made once.
    void make_chunk_of(std::uint32_t place) {
        std::atomic<T*>& chunk = directory_[std::bit_width(place)];
        if (chunk.load(std::memory_order_acquire)) return;
        const std::lock_guard guard(growing_);
        if (!chunk.load()) chunk.store(new T[std::bit_floor(place)], std::memory_order_release);
    }

    std::array<std::atomic<T*>, 33> directory_ = {};  ///< by the number of bits of a place
    std::atomic<std::uint32_t> end_{0};
    std::mutex growing_;
};

}  // namespace space
