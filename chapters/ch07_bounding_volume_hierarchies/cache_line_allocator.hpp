/// @file
/// Memory for what rays walk through.
#pragma once

#include <cstddef>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace space {

/// For a vector that begins with a cache line of 64 bytes, so that two siblings share one. A large
/// one asks the system for pages of 2 MB: a ray goes from page to page, and the processor keeps in
/// mind where a few hundred of them are, be they large or small.
template <class T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) {
        void* const memory = ::operator new(n * sizeof(T), alignment(n));
#ifdef __linux__
        if (alignment(n) == page) madvise(memory, n * sizeof(T), MADV_HUGEPAGE);  // may be refused
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t n) {
        ::operator delete(memory, alignment(n));
    }
    /// A vector that grows by plain values does not write them: pages come to be, and are filled
    /// with zeros, as they are first touched, and that may be by several threads.
    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
    bool operator==(const CacheLineAllocator&) const = default;

  private:
    static constexpr std::align_val_t line{64}, page{std::size_t{1} << 21};
    static std::align_val_t alignment(std::size_t n) {
        return n * sizeof(T) < std::size_t(page) ? line : page;
    }
};

}  // namespace space
