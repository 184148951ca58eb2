#include "allocations.hpp"

#include <cstdlib>

namespace motus::test {

thread_local int allocations_left = -1;
thread_local std::size_t allocated_bytes = 0;

}  // namespace motus::test

// The test program's own, so that they can fail and are counted.
void* operator new(std::size_t size) {
    using motus::test::allocations_left;
    if (allocations_left == 0) throw std::bad_alloc();
    if (allocations_left > 0) --allocations_left;
    motus::test::allocated_bytes += size;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
