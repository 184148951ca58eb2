#include "pull_kernel.hpp"

#include <array>

#include "force_loops.hpp"
#include "move_loops.hpp"

// The loops are inlined into one function for each instruction set, whose instructions they then take. AVX2
// without FMA rounds as SSE2 does.
#if defined(__x86_64__)
#define MOTUS_AVX2 [[gnu::target("avx2")]]
#endif

namespace motus {
namespace {

namespace base {

Seen measure(const float* positions, std::size_t count, const glm::vec3& root, float reach,
             float* distances) {
    return loops::measure(positions, count, root, reach, distances);
}
Seen measure_by(const glm::mat3& metric, const float* positions, std::size_t count, const glm::vec3& root,
                float reach, float* distances) {
    return loops::measure_by(metric, positions, count, root, reach, distances);
}
void force(const ForceTerms& terms, float* values, std::size_t count) {
    loops::force(terms, values, count);
}
bool are_weights(const float* weights, std::size_t count) {
    return loops::are_weights(weights, count);
}
void weigh(const float* weights, std::size_t count, float* forces) {
    loops::weigh(weights, count, forces);
}
void move(const MoveTerms& terms, const float* forces, std::size_t count, float* positions) {
    loops::move<4>(terms, forces, count, positions);
}
void share(const glm::vec3& displacement, const float* forces, std::size_t count, Shares& shares) {
    loops::share(displacement, forces, count, shares);
}
void move_by(const MoveTerms& terms, const Shares& shares, std::size_t count, float* positions) {
    loops::move_by(terms, shares, count, positions);
}

}  // namespace base

constexpr PullKernel base_kernel{"base",       &base::measure,     &base::measure_by,
                                 &base::force, &base::are_weights, &base::weigh,
                                 &base::move,  &base::share,       &base::move_by};

#if defined(__x86_64__)
namespace avx2 {

MOTUS_AVX2 Seen measure(const float* positions, std::size_t count, const glm::vec3& root, float reach,
                        float* distances) {
    return loops::measure(positions, count, root, reach, distances);
}
MOTUS_AVX2 Seen measure_by(const glm::mat3& metric, const float* positions, std::size_t count,
                           const glm::vec3& root, float reach, float* distances) {
    return loops::measure_by(metric, positions, count, root, reach, distances);
}
MOTUS_AVX2 void force(const ForceTerms& terms, float* values, std::size_t count) {
    loops::force(terms, values, count);
}
MOTUS_AVX2 bool are_weights(const float* weights, std::size_t count) {
    return loops::are_weights(weights, count);
}
void weigh(const float* weights, std::size_t count, float* forces) {
    loops::weigh(weights, count, forces);
}
MOTUS_AVX2 void move(const MoveTerms& terms, const float* forces, std::size_t count, float* positions) {
    loops::move<8>(terms, forces, count, positions);
}
MOTUS_AVX2 void share(const glm::vec3& displacement, const float* forces, std::size_t count, Shares& shares) {
    loops::share(displacement, forces, count, shares);
}
MOTUS_AVX2 void move_by(const MoveTerms& terms, const Shares& shares, std::size_t count, float* positions) {
    loops::move_by(terms, shares, count, positions);
}

}  // namespace avx2

constexpr PullKernel avx2_kernel{"AVX2",       &avx2::measure,     &avx2::measure_by,
                                 &avx2::force, &avx2::are_weights, &avx2::weigh,
                                 &avx2::move,  &avx2::share,       &avx2::move_by};

constexpr std::array kernels{base_kernel, avx2_kernel};
#else
constexpr std::array kernels{base_kernel};
#endif

[[nodiscard]] std::size_t runnable_kernels() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") ? 2 : 1;
#else
    return 1;
#endif
}

}  // namespace

std::span<const PullKernel> pull_kernels() {
    static const std::size_t count = runnable_kernels();
    return std::span(kernels).first(count);
}

}  // namespace motus
