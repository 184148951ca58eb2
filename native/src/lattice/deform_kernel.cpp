#include "deform_kernel.hpp"

#include <array>
#include <cstddef>

#include "motus/core/instruction_sets.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "deform_kernel.cpp"
#include <hwy/foreach_target.h>

#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::lattice::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

static_assert(numbers_of_move == 4);

/// Sum over the lattice points of weight * number. Taps: how many along u, if the compiler is to know; else
/// 0.
template <std::size_t Taps>
HWY_INLINE Four blend(const Rows& rows, const float* numbers) {
    const std::size_t along_u = Taps > 0 ? Taps : rows.u.count;
    Four sum = hn::Zero(as_four);
    for (std::size_t w = 0; w < rows.w.count; ++w) {
        Four layer = hn::Zero(as_four);
        for (std::size_t v = 0; v < rows.v.count; ++v) {
            const float* const line = numbers + rows.w.offset[w] + rows.v.offset[v];
            Four run = hn::Zero(as_four);
            for (std::size_t u = 0; u < along_u; ++u)
                run = run + hn::Set(as_four, rows.u.weight[u]) * hn::LoadU(as_four, line + rows.u.offset[u]);
            layer = layer + hn::Set(as_four, rows.v.weight[v]) * run;
        }
        sum = sum + hn::Set(as_four, rows.w.weight[w]) * layer;
    }
    return sum;
}

HWY_INLINE Four blend(const Rows& rows, const float* numbers) {
    switch (rows.u.count) {
        case 2:
            return blend<2>(rows, numbers);
        case 4:
            return blend<4>(rows, numbers);
        default:
            return blend<0>(rows, numbers);
    }
}

void deform(const Deformation& deformation, std::size_t first, std::size_t last) {
    const auto* const numbers = reinterpret_cast<const float*>(deformation.moves.data());
    for (std::size_t i = first; i < last; ++i) {
        const glm::vec3& position = deformation.positions[i];
        const float factor = deformation.factors.empty() ? 1.0f : deformation.factors[i];
        if (factor == 0.0f) {
            deformation.out[i] = position;
            continue;
        }
        const Rows rows(deformation.grid, deformation.grid.coordinates(glm::dvec3(position)));
        alignas(16) std::array<float, numbers_of_move> change{};
        for (std::size_t number = 0; number < numbers_of_move; number += lanes_of_four)
            hn::StoreU(hn::Set(as_four, factor) * blend(rows, numbers + number), as_four, &change[number]);
        glm::vec3 move(change[0], change[1], change[2]);
        if (deformation.fades) move *= change[3];
        deformation.out[i] = position + move;
    }
}

constexpr DeformKernel kernel{HWY_STR(HWY_NAMESPACE), &deform};

}  // namespace
}  // namespace motus::lattice::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::lattice {

std::span<const DeformKernel> deform_kernels() {
    static const Kernels<DeformKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::lattice
#endif
