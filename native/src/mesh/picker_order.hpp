// The order in which a picking tree holds its vertices: along a Hilbert curve. Private to the library.
// State machine: Hamilton, Rau-Chaplin, "Compact Hilbert indices" (2008).
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "motus/core/executor.hpp"

namespace motus::mesh {

/// Memory for large arrays in large pages, if the system has them: an array that is read here and there
/// takes half the time, and a new one is made of a few hundred times fewer pages.
[[nodiscard]] void* allocate_pages(std::size_t bytes);
void free_pages(void* memory, std::size_t bytes) noexcept;

/// Like std::allocator, but the elements of a vector are not set to anything before they are written: large
/// arrays are then first touched by the threads that fill them.
template <class T>
struct Unset {
    using value_type = T;
    Unset() = default;
    template <class U>
    explicit(false) Unset(const Unset<U>& /*other*/) noexcept {}
    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(allocate_pages(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept { free_pages(memory, count * sizeof(T)); }
    template <class U>
    void construct(U* place) noexcept {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Values>
    void construct(U* place, Values&&... values) {
        ::new (static_cast<void*>(place)) U(std::forward<Values>(values)...);
    }
    bool operator==(const Unset& /*other*/) const = default;
};

template <class T>
using Array = std::vector<T, Unset<T>>;

/// Cells along each axis: 2^hilbert_bits.
constexpr int hilbert_bits = 20;

/// Where on the curve through all cells the cell (x, y, z) lies: those that follow each other share a side.
[[nodiscard]] std::uint64_t hilbert_place(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept;

/// A sort key in the upper 32 bits, and the index that it belongs to in the lower ones.
using Keyed = std::uint64_t;

/// Sorts by the lowest `bits` of the key, others being 0; equal keys stay in order.
void sort_by_key(Array<Keyed>& items, int bits, const Executor& executor);

/// The indices of the points along the Hilbert curve through their bounding cube; those of one cell
/// ascending. Points that are not finite lie anywhere.
[[nodiscard]] Array<std::uint32_t> hilbert_order(std::span<const glm::vec3> points, const Executor& executor);

}  // namespace motus::mesh
