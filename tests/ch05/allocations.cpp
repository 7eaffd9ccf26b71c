// Every allocation of the program passes here, so that what is not given back is seen, and so that
// one can fail. In a file of its own: the compiler would otherwise see through new and delete, and
// warn of malloc and free.
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace space::test {
std::atomic<std::ptrdiff_t> living_allocations{0};
std::atomic<std::ptrdiff_t> allocations_left{-1};  ///< until one fails; none does below 0
}  // namespace space::test

void* operator new(std::size_t size) {
    if (space::test::allocations_left >= 0 && space::test::allocations_left-- == 0)
        throw std::bad_alloc();
    void* memory = std::malloc(size ? size : 1);
    if (!memory) throw std::bad_alloc();
    ++space::test::living_allocations;
    return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* memory) noexcept {
    if (memory) --space::test::living_allocations;
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    operator delete(memory);
}
