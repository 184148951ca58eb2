#include "motus/sculpt/falloff.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "pull_kernel.hpp"

namespace motus::sculpt {
namespace {

constexpr std::size_t most_samples = 65536;

/// Whether a falloff is one of (d / R)^2.
bool is_of_squares(Falloff falloff) {
    return falloff == Falloff::sphere || falloff == Falloff::gaussian || falloff == Falloff::constant;
}

}  // namespace

float reach_of(const Profile& profile, float radius) {
    require(radius > 0.0f && std::isfinite(radius), "radius: must be > 0 and finite");
    return profile.falloff == Falloff::classic ? in_ieee_floats([radius] { return std::sqrt(radius); })
                                               : radius;
}

ForceTerms force_terms(const Profile& profile, float radius) {
    require(radius > 0.0f && std::isfinite(radius), "radius: must be > 0 and finite");
    ForceTerms terms;
    terms.falloff = profile.falloff;
    terms.limit = radius;
    // A radius so small that its reciprocal is infinite must not make 0 / R undefined.
    terms.scale = std::min(1.0f / radius, std::numeric_limits<float>::max());
    if (is_of_squares(profile.falloff)) {
        terms.of_squares = true;
        // Nor may its square leave the root out of reach.
        terms.limit = std::max(radius * radius, std::numeric_limits<float>::denorm_min());
        terms.scale = std::min(1.0f / terms.limit, std::numeric_limits<float>::max());
    }
    if (profile.falloff == Falloff::classic) {
        require(std::isfinite(profile.scale_factor), "scale_factor: must be finite");
        terms.of_squares = true;
        // The radius is the square of the reach, which may have been rounded down.
        const float reach = reach_of(profile, radius);
        terms.limit = std::min(radius, reach * reach);
        terms.scale = 1.0f / (radius + 1.0f);
        terms.exponent = 1.0f + std::abs(profile.scale_factor);
    }
    if (profile.falloff == Falloff::curve) {
        require(profile.curve.size() >= 2 && profile.curve.size() <= most_samples,
                "curve: must have 2 to 65536 samples");
        require(are_finite(profile.curve), "curve: every sample must be finite");
        terms.samples = profile.curve.data();
        terms.last_sample = static_cast<int>(profile.curve.size()) - 1;
    }
    return terms;
}

namespace {

/// Puts what `of` makes of each distance into `out`; returns whether one is NaN. That is seen by the bits,
/// which the compiler compares several at once, as it does not compare numbers.
template <class Of>
[[nodiscard]] bool put(std::span<const float> distances, std::span<float> out, const Of& of) {
    constexpr std::uint32_t all_but_the_sign = 0x7fffffff;
    constexpr std::int32_t infinity = 0x7f800000;
    std::int32_t is_any_nan = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float distance = distances[i];
        const auto size =
            static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(distance) & all_but_the_sign);
        is_any_nan |= size > infinity ? 1 : 0;
        out[i] = of(distance);
    }
    return is_any_nan != 0;
}

/// Of at most pull_block distances, which `out` may be. The kernel gives 0 for NaN, by which vertices that a
/// pull does not reach stay.
void fill_forces(const PullKernel& kernel, const ForceTerms& terms, std::span<const float> distances,
                 std::span<float> out) {
    const bool is_any_nan = terms.of_squares ? put(distances, out, [](float d) { return d * d; })
                                             : put(distances, out, [](float d) { return d; });
    if (!is_any_nan) {
        kernel.force(terms, out.data(), out.size());
        return;
    }
    std::array<bool, pull_block> is_nan{};
    std::ranges::transform(out, is_nan.begin(), [](float distance) { return std::isnan(distance); });
    kernel.force(terms, out.data(), out.size());
    for (std::size_t k = 0; k < out.size(); ++k)
        if (is_nan[k]) out[k] = std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

void forces(const Profile& profile, float radius, std::span<const float> distances, std::span<float> out) {
    require(distances.size() == out.size(), "out: must be as long as distances");
    in_ieee_floats([&] {
        const ForceTerms terms = force_terms(profile, radius);
        const PullKernel& kernel = pull_kernels().back();
        for (std::size_t i = 0; i < out.size(); i += pull_block) {
            const std::size_t count = std::min(pull_block, out.size() - i);
            fill_forces(kernel, terms, distances.subspan(i, count), out.subspan(i, count));
        }
    });
}

}  // namespace motus::sculpt
