#include <array>

#include "kernel.hpp"
#include "motus/core/instruction_sets.hpp"

namespace motus::snow {

std::span<const Kernel* const> kernels() {
#if defined(__x86_64__)
    static constexpr std::array all{&base_kernel, &avx2_kernel, &avx512_kernel};
#else
    static constexpr std::array all{&base_kernel};
#endif
    return std::span(all).first(runnable_sets());
}

}  // namespace motus::snow
