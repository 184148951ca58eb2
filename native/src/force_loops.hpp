// Falloffs over a block of distances, in plain loops that the compiler turns into vectors. They take the
// instruction set of the function that they are inlined into. Private to pull_kernel.cpp.
#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pull_kernel.hpp"

namespace motus::loops {

/// e^x for x in [-87, 0]; relative error 2e-7. Cody and Waite's reduction, polynomial of Cephes's expf.
[[gnu::always_inline]] inline float exponential(float x) {
    constexpr float to_whole = 12582912.0f;  // adding 1.5 * 2^23 leaves no bits below one
    const float n = (x * 1.44269504f + to_whole) - to_whole;
    const float r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    float p = 1.9875691500e-4f;
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    const float value = (p * (r * r) + r) + 1.0f;
    return value * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

/// ln x for normal x > 0; error 1e-7 of the larger of |ln x| and |x - 1|. Polynomial of Cephes's logf.
[[gnu::always_inline]] inline float logarithm(float x) {
    constexpr std::int32_t root_of_half = 0x3f3504f3;
    const std::int32_t bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t n = (bits - root_of_half) >> 23;
    const float m = std::bit_cast<float>(bits - (n << 23)) - 1.0f;  // in [sqrt(1/2), sqrt(2)) - 1
    const float e = static_cast<float>(n);
    float p = 7.0376836292e-2f;
    p = p * m - 1.1514610310e-1f;
    p = p * m + 1.1676998740e-1f;
    p = p * m - 1.2420140846e-1f;
    p = p * m + 1.4249322787e-1f;
    p = p * m - 1.6668057665e-1f;
    p = p * m + 2.0000714765e-1f;
    p = p * m - 2.4999993993e-1f;
    p = p * m + 3.3333331174e-1f;
    const float square = m * m;
    const float tail = (p * (square * m) - e * 2.12194440e-4f) - 0.5f * square;
    return (m + tail) + e * 0.693359375f;
}

/// shape(distance) within reach, 0 elsewhere; also where the distance is not a number.
template <class Shape>
[[gnu::always_inline]] inline void shape_forces(float reach, float* __restrict values, std::size_t count,
                                                Shape&& shape) {
    for (std::size_t i = 0; i < count; ++i) {
        const float distance = values[i];
        const float inside = shape(distance);
        values[i] = distance < reach ? inside : 0.0f;
    }
}

/// The same by a shape of t = 1 - d / R, in [0, 1].
template <class Shape>
[[gnu::always_inline]] inline void shape_nearness(const ForceTerms& terms, float* __restrict values,
                                                  std::size_t count, Shape&& shape) {
    const float scale = terms.scale;
    shape_forces(
        terms.reach, values, count, [=](float distance) __attribute__((always_inline)) {
            const float t = 1.0f - distance * scale;
            return shape(t > 0.0f ? t : 0.0f);
        });
}

[[gnu::always_inline]] inline void classic_forces(const ForceTerms& terms, float* __restrict values,
                                                  std::size_t count) {
    const float scale = terms.scale;
    const float exponent = terms.exponent;
    if (exponent == 1.0f) {
        shape_forces(
            terms.reach, values, count, [=](float distance) __attribute__((always_inline)) {
                const float base = 1.0f - distance * distance * scale;
                return base > 0.0f ? base : 0.0f;
            });
        return;
    }
    shape_forces(
        terms.reach, values, count, [=](float distance) __attribute__((always_inline)) {
            constexpr float least = 1e-30f;
            const float base = 1.0f - distance * distance * scale;
            const float x = exponent * logarithm(base > least ? base : least);
            return exponential(x > -87.0f ? x : -87.0f);
        });
}

/// e^(-1.125 q), q in [0, 1], to the fourth: the polynomial (a minimax one, error 4e-8) is 1 at 0.
[[gnu::always_inline]] inline void gaussian_forces(const ForceTerms& terms, float* __restrict values,
                                                   std::size_t count) {
    constexpr float edge = 0.011108997f;  // e^-4.5
    const float scale = terms.scale;
    shape_forces(
        terms.reach, values, count, [=](float distance) __attribute__((always_inline)) {
            const float share = distance * scale;
            const float q = share * share;
            float p = 1.63675251e-3f;
            p = p * q - 1.35827633e-2f;
            p = p * q + 6.58399463e-2f;
            p = p * q - 2.37012118e-1f;
            p = p * q + 6.32768452e-1f;
            p = p * q - 1.12499774f;
            p = p * q + 1.0f;
            const float square = p * p;
            const float force = (square * square - edge) * (1.0f / (1.0f - edge));
            return force > 0.0f ? force : 0.0f;
        });
}

/// Looking samples up is no work for vectors; what comes before and after is.
[[gnu::always_inline]] inline void curve_forces(const ForceTerms& terms, float* __restrict values,
                                                std::size_t count) {
    PerVertex<std::int32_t> steps;
    PerVertex<float> before;
    PerVertex<float> after;
    const float last = static_cast<float>(terms.last_sample);
    const float last_step = static_cast<float>(terms.last_sample - 1);
    const float scale = terms.scale;
    for (std::size_t i = 0; i < count; ++i) {
        const float t = 1.0f - values[i] * scale;
        const float at = (t > 0.0f ? t : 0.0f) * last;
        steps[i] = static_cast<std::int32_t>(at < last_step ? at : last_step);
    }
    for (std::size_t i = 0; i < count; ++i) {
        before[i] = terms.samples[steps[i]];
        after[i] = terms.samples[steps[i] + 1];
    }
    for (std::size_t i = 0; i < count; ++i) {
        const float distance = values[i];
        const float t = 1.0f - distance * scale;
        const float share = (t > 0.0f ? t : 0.0f) * last - static_cast<float>(steps[i]);
        const float force = (before[i] * (1.0f - share) + after[i] * share) + 0.0f;  // not -0: see FreeThird
        values[i] = distance < terms.reach ? force : 0.0f;
    }
}

[[gnu::always_inline]] inline void force(const ForceTerms& terms, float* values, std::size_t count) {
    switch (terms.falloff) {
        case Falloff::classic:
            return classic_forces(terms, values, count);
        case Falloff::smooth:
            return shape_nearness(
                terms, values, count,
                [](float t) __attribute__((always_inline)) { return t * t * (3.0f - 2.0f * t); });
        case Falloff::sphere:
            return shape_nearness(
                terms, values, count,
                [](float t) __attribute__((always_inline)) { return std::sqrt(t * (2.0f - t)); });
        case Falloff::root:
            return shape_nearness(
                terms, values, count, [](float t) __attribute__((always_inline)) { return std::sqrt(t); });
        case Falloff::linear:
            return shape_nearness(
                terms, values, count, [](float t) __attribute__((always_inline)) { return t; });
        case Falloff::sharp:
            return shape_nearness(
                terms, values, count, [](float t) __attribute__((always_inline)) { return t * t; });
        case Falloff::constant:
            return shape_forces(
                terms.reach, values, count, [](float) __attribute__((always_inline)) { return 1.0f; });
        case Falloff::gaussian:
            return gaussian_forces(terms, values, count);
        case Falloff::curve:
            return curve_forces(terms, values, count);
    }
}

}  // namespace motus::loops
