/// @file
/// Exercise 5.3, our answer.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace space {

/// The states of a node's word, besides those of a node that stands: any other value.
inline constexpr std::uint64_t waiting_word = 4, being_made_word = 5;

template <class Word>
std::uint64_t node_at(Word& word, const std::function<std::uint64_t()>& make) {
    const auto publish = [&](std::uint64_t value) {
        word.store(value, std::memory_order_release);
        word.notify_all();
    };
    std::uint64_t value = word.load(std::memory_order_acquire);
    while (value == waiting_word || value == being_made_word) {
        if (value == being_made_word) {
            word.wait(value, std::memory_order_acquire);
            value = word.load(std::memory_order_acquire);
        } else if (word.compare_exchange_strong(value, being_made_word,
                                                std::memory_order_acquire)) {
            try {
                value = make();
            } catch (...) {
                publish(waiting_word);
                throw;
            }
            publish(value);
        }
    }
    return value;
}

}  // namespace space
