/// @file
/// Work that needs no teaching: the same function over many indices, on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace space {

/// Calls body(i) once for each i in 0 .. count - 1 on up to `threads` threads, which take chunks of
/// indices in turn. The body must not care which thread calls it; the first exception is thrown on
/// after all threads ended.
template <class Body>
void parallel_for(std::size_t count, unsigned threads, std::size_t chunk, const Body& body) {
    if (threads <= 1 || count <= chunk) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex error_lock;
    const auto work = [&] {
        try {
            for (std::size_t first; (first = next.fetch_add(chunk)) < count;)
                for (std::size_t i = first; i < std::min(first + chunk, count); ++i) body(i);
        } catch (...) {
            next = count;
            const std::lock_guard guard(error_lock);
            if (!error) error = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> workers;
        const std::size_t useful = std::min<std::size_t>(threads, (count + chunk - 1) / chunk);
        for (std::size_t i = 1; i < useful; ++i) workers.emplace_back(work);
        work();
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace space
