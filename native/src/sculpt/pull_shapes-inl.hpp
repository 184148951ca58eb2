// Falloffs of vectors of distances, for pull_kernel.cpp: once for each of Highway's targets.
#if defined(MOTUS_SCULPT_PULL_SHAPES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SCULPT_PULL_SHAPES_INL_HPP
#undef MOTUS_SCULPT_PULL_SHAPES_INL_HPP
#else
#define MOTUS_SCULPT_PULL_SHAPES_INL_HPP
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "motus/core/lanes-inl.hpp"
#include "pull_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::sculpt::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

using Truths = hn::Mask<decltype(as_floats)>;

HWY_INLINE Integers integers(std::int32_t number) {
    return hn::Set(as_integers, number);
}

/// The larger of each number and `least`, which also stands for what is no number: Max takes its second then.
HWY_INLINE Floats at_least(float least, Floats all) {
    return hn::Max(all, floats(least));
}

/// e^x for x in [-87, 0]; relative error 2e-7. Cody and Waite's reduction, polynomial of Cephes's expf.
HWY_INLINE Floats exponential(Floats x) {
    const Floats to_whole = floats(12582912.0f);  // adding 1.5 * 2^23 leaves no bits below one
    const Floats whole = x * floats(1.44269504f) + to_whole;
    const Floats n = whole - to_whole;
    const Floats r = (x - n * floats(0.693359375f)) + n * floats(2.12194440e-4f);
    Floats p = r * floats(1.9875691500e-4f) + floats(1.3981999507e-3f);
    p = p * r + floats(8.3334519073e-3f);
    p = p * r + floats(4.1665795894e-2f);
    p = p * r + floats(1.6666665459e-1f);
    p = p * r + floats(5.0000001201e-1f);
    // The last bits of `whole` are those of n.
    const Integers power = hn::ShiftLeft<23>(hn::BitCast(as_integers, whole) + integers(127));
    return ((p * (r * r) + r) + floats(1.0f)) * hn::BitCast(as_floats, power);
}

/// ln x for normal x > 0; error 1e-7 of the larger of |ln x| and |x - 1|. Polynomial of Cephes's logf.
HWY_INLINE Floats logarithm(Floats x) {
    const Integers bits = hn::BitCast(as_integers, x);
    const Integers n = hn::ShiftRight<23>(bits - integers(0x3f3504f3));  // sqrt(1/2)
    // In [sqrt(1/2), sqrt(2)) - 1.
    const Floats m = hn::BitCast(as_floats, bits - hn::ShiftLeft<23>(n)) - floats(1.0f);
    const Floats e = hn::ConvertTo(as_floats, n);
    Floats p = m * floats(7.0376836292e-2f) - floats(1.1514610310e-1f);
    p = p * m + floats(1.1676998740e-1f);
    p = p * m - floats(1.2420140846e-1f);
    p = p * m + floats(1.4249322787e-1f);
    p = p * m - floats(1.6668057665e-1f);
    p = p * m + floats(2.0000714765e-1f);
    p = p * m - floats(2.4999993993e-1f);
    p = p * m + floats(3.3333331174e-1f);
    const Floats square = m * m;
    const Floats tail = (p * (square * m) - e * floats(2.12194440e-4f)) - floats(0.5f) * square;
    return (m + tail) + e * floats(0.693359375f);
}

/// The force of a classic profile, (1 - d^2 scale)^exponent, of d^2. is_bare: the exponent is 1.
template <bool is_bare>
struct ClassicShape {
    static constexpr bool of_squares = true;
    float scale, exponent;

    HWY_INLINE Floats operator()(Floats squares) const {
        const Floats base = floats(1.0f) - squares * floats(scale);
        if constexpr (is_bare) return at_least(0.0f, base);
        return exponential(at_least(-87.0f, logarithm(at_least(1e-30f, base)) * floats(exponent)));
    }
};

/// Shapes of t = 1 - d / R, in [0, 1].
template <Falloff falloff>
struct NearnessShape {
    static constexpr bool of_squares = false;
    float scale;

    HWY_INLINE Floats operator()(Floats distances) const {
        const Floats t = at_least(0.0f, floats(1.0f) - distances * floats(scale));
        if constexpr (falloff == Falloff::smooth) return t * t * (floats(3.0f) - floats(2.0f) * t);
        if constexpr (falloff == Falloff::root) return hn::Sqrt(t);
        if constexpr (falloff == Falloff::linear) return t;
        if constexpr (falloff == Falloff::sharp) return t * t;
    }
};

/// The sphere's force by q = d^2 / R^2: sqrt(1 - q), which is sqrt(2t - t^2).
struct SphereShape {
    static constexpr bool of_squares = true;
    float scale;

    HWY_INLINE Floats operator()(Floats squares) const {
        return hn::Sqrt(at_least(0.0f, floats(1.0f) - squares * floats(scale)));
    }
};

struct ConstantShape {
    static constexpr bool of_squares = true;

    HWY_INLINE Floats operator()(Floats /*squares*/) const { return floats(1.0f); }
};

/// The gaussian's force by q = d^2 / R^2: e^(-1.125 q), q in [0, 1], to the fourth: the polynomial (a minimax
/// one, error 4e-8) is 1 at 0.
struct GaussianShape {
    static constexpr bool of_squares = true;
    float scale;

    HWY_INLINE Floats operator()(Floats squares) const {
        constexpr float edge = 0.011108997f;  // e^-4.5
        const Floats q = squares * floats(scale);
        Floats p = q * floats(1.63675251e-3f) - floats(1.35827633e-2f);
        p = p * q + floats(6.58399463e-2f);
        p = p * q - floats(2.37012118e-1f);
        p = p * q + floats(6.32768452e-1f);
        p = p * q - floats(1.12499774f);
        p = p * q + floats(1.0f);
        const Floats square = p * p;
        return at_least(0.0f, (square * square - floats(edge)) * floats(1.0f / (1.0f - edge)));
    }
};

/// Looking samples up is no work for vectors: by GatherIndex it takes a third longer.
struct CurveShape {
    static constexpr bool of_squares = false;
    const float* samples;
    float scale, last, last_step;

    HWY_INLINE Floats operator()(Floats distances) const {
        const Floats at = at_least(0.0f, floats(1.0f) - distances * floats(scale)) * floats(last);
        const Floats step = hn::Floor(hn::Min(at, floats(last_step)));
        // The last bits of 2^23 + n are those of n; ConvertTo would also see to numbers beyond the integers.
        const Integers bits = hn::BitCast(as_integers, step + floats(0x1p23f)) - integers(0x4b000000);
        std::array<std::int32_t, lanes> steps{};
        hn::StoreU(bits, as_integers, steps.data());
        std::array<float, 2 * lanes> ends{};
        for (std::size_t lane = 0; lane < lanes; ++lane)
            std::copy_n(samples + steps[lane], 2, &ends[2 * lane]);
        Floats low, high;
        hn::LoadInterleaved2(as_floats, ends.data(), low, high);
        const Floats share = at - step;
        return low * (floats(1.0f) - share) + high * share;
    }
};

/// work(shape), where shape(values) is forces by distances, or by their squares where it is of_squares; right
/// if these are below the limit.
template <class Work>
HWY_INLINE void with_shape(const ForceTerms& terms, const Work& work) {
    switch (terms.falloff) {
        case Falloff::classic:
            if (terms.exponent == 1.0f) return work(ClassicShape<true>{terms.scale, terms.exponent});
            return work(ClassicShape<false>{terms.scale, terms.exponent});
        case Falloff::smooth:
            return work(NearnessShape<Falloff::smooth>{terms.scale});
        case Falloff::sphere:
            return work(SphereShape{terms.scale});
        case Falloff::root:
            return work(NearnessShape<Falloff::root>{terms.scale});
        case Falloff::linear:
            return work(NearnessShape<Falloff::linear>{terms.scale});
        case Falloff::sharp:
            return work(NearnessShape<Falloff::sharp>{terms.scale});
        case Falloff::constant:
            return work(ConstantShape{});
        case Falloff::gaussian:
            return work(GaussianShape{terms.scale});
        case Falloff::curve:
            return work(CurveShape{terms.samples, terms.scale, static_cast<float>(terms.last_sample),
                                   static_cast<float>(terms.last_sample - 1)});
    }
}

/// The shape within reach, 0 elsewhere; also where the distance is no number.
template <class Shape>
HWY_INLINE Floats forces_by(const Shape& shape, float limit, Floats values) {
    return hn::IfThenElseZero(values < floats(limit), shape(values));
}

}  // namespace
}  // namespace motus::sculpt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
