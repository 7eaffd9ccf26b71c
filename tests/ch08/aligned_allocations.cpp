// As ../ch05/allocations.cpp, for memory that begins with a cache line or a page: nodes and
// references lie there.
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace space::test {
extern std::atomic<std::ptrdiff_t> living_allocations;
extern std::atomic<std::ptrdiff_t> allocations_left;
}  // namespace space::test

void* operator new(std::size_t size, std::align_val_t alignment) {
    if (space::test::allocations_left >= 0 && space::test::allocations_left-- == 0)
        throw std::bad_alloc();
    const auto unit = static_cast<std::size_t>(alignment);
    void* memory = std::aligned_alloc(unit, (size + unit) / unit * unit);
    if (!memory) throw std::bad_alloc();
    ++space::test::living_allocations;
    return memory;
}
void operator delete(void* memory, std::align_val_t) noexcept {
    if (memory) --space::test::living_allocations;
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
    operator delete(memory, alignment);
}
