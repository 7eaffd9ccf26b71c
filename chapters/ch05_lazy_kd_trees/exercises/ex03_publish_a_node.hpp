/// @file
/// Exercise 5.3: Publish a node
/// Difficulty 3 of 3, about 40 minutes.
///
/// A node's word says that it waits (4), that it is being made (5), or what it is (any other
/// value). `node_at(word, make)` returns what it is. Whoever comes first makes it with `make()`,
/// once for all threads, and publishes its value, so that whoever reads the value also sees all
/// that `make` has written. Others that come meanwhile wait until the word changes, by word.wait,
/// not in a loop of loads. If `make()` throws, the node waits again, for the next who comes, and
/// for those who wait now; the exception goes on to the caller. `Word` has the members of
/// std::atomic<std::uint64_t>: load, store, compare_exchange_strong and _weak, exchange, wait,
/// notify_one and notify_all, with memory orders. A finished node costs one load and no more than
/// acquire. The check plays the other threads, between any two of your steps, and sees each step.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace space {

/// The states of a node's word, besides those of a node that stands: any other value.
inline constexpr std::uint64_t waiting_word = 4, being_made_word = 5;

template <class Word>
std::uint64_t node_at(Word& word, const std::function<std::uint64_t()>& make) {
    // TODO: alone in the world this is right; two threads may both make the node
    std::uint64_t value = word.load(std::memory_order_acquire);
    if (value != waiting_word) return value;
    value = make();
    word.store(value, std::memory_order_release);
    return value;
}

}  // namespace space
