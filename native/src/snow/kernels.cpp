#include <array>

#include "kernel.hpp"

namespace motus::snow {

std::span<const Kernel* const> kernels() {
#if defined(__x86_64__)
    static constexpr std::array all{&base_kernel, &avx2_kernel, &avx512_kernel};
    static const std::size_t count = [] {
        if (!__builtin_cpu_supports("avx2")) return std::size_t{1};
        const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
        return has_avx512 ? std::size_t{3} : std::size_t{2};
    }();
    return std::span(all).first(count);
#else
    static constexpr std::array all{&base_kernel};
    return all;
#endif
}

}  // namespace motus::snow
