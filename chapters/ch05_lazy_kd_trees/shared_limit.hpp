/// @file
/// A limit that threads share.
#pragma once

#include <atomic>
#include <cstddef>

namespace space {

/// So much may be taken, by all threads together. Never is more taken than may be, not for a
/// moment: else one thread's failure would take the room of another. So to take nothing always
/// works. Tests have their own `Counter`.
template <class Counter = std::atomic<std::size_t>>
class SharedLimit {
  public:
    explicit SharedLimit(std::size_t most) : most_(most) {}

    /// Whether there was room; else nothing is taken.
    bool take(std::size_t count) {
        std::size_t taken = taken_.load();
        do {
            if (count > most_ - taken) return false;
        } while (!taken_.compare_exchange_weak(taken, taken + count));
        return true;
    }
    void give_back(std::size_t count) { taken_ -= count; }

  private:
    std::size_t most_;
    Counter taken_{0};
};

}  // namespace space
