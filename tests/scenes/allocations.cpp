// Every allocation of the program passes here, so that one that follows a lying header is seen. In
// a file of its own: the compiler would otherwise see through new and delete, and warn of malloc
// and free.
#include <algorithm>
#include <cstdlib>
#include <new>

namespace space::test {
std::size_t largest_allocation = 0;
}

void* operator new(std::size_t size) {
    space::test::largest_allocation = std::max(space::test::largest_allocation, size);
    if (void* memory = std::malloc(size ? size : 1)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size ? size : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
