/// @file
/// Memory that nobody has touched yet.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace space {

/// An array of plain values that have none before they are written. A std::vector writes all of
/// them, by one thread; and it is the first write to a page for which the system finds memory,
/// which takes longer than the write.
template <class T>
class Untouched {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  public:
    explicit Untouched(std::size_t size)
        : size_(size), values_(size > 0 ? CacheLineAllocator<T>().allocate(size) : nullptr) {}
    ~Untouched() {
        if (values_) CacheLineAllocator<T>().deallocate(values_, size_);
    }
    Untouched(const Untouched&) = delete;
    Untouched& operator=(const Untouched&) = delete;

    std::span<T> all() { return {values_, size_}; }

  private:
    std::size_t size_;
    T* values_;
};

}  // namespace space
