// The test program's memory: allocations that fail, and how much is allocated.
#pragma once
#include <cstddef>
#include <new>

namespace motus::test {

/// Allocations of this thread. allocations_left: number of allocations until one fails; below 0 none fails.
extern thread_local int allocations_left;
extern thread_local std::size_t allocated_bytes;

/// Runs `work` with so many allocations granted; whether they were enough.
template <class Work>
bool with_allocations(int count, Work&& work) {
    allocations_left = count;
    bool enough = true;
    try {
        work();
    } catch (const std::bad_alloc&) {
        enough = false;
    }
    allocations_left = -1;
    return enough;
}

/// Bytes that `work` allocates in this thread, including those that it frees again.
template <class Work>
[[nodiscard]] std::size_t bytes_allocated_by(Work&& work) {
    const std::size_t before = allocated_bytes;
    work();
    return allocated_bytes - before;
}

}  // namespace motus::test
