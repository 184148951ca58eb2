// How depths of lying snow are settled, compiled for several instruction sets. Private to the library.
#pragma once
#include <span>
#include <vector>

#include "heaps.hpp"

namespace motus::snow {

/// Heaps::settle() for one instruction set; all sets give the same bits.
struct HeapKernel {
    const char* name = nullptr;
    /// `depths`: of the vertices, and 0 in the end.
    void (*settle)(const HeapPlan& plan, std::vector<float>& depths, float steepest) = nullptr;
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const HeapKernel> heap_kernels();

}  // namespace motus::snow
