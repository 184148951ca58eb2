#include "motus/stereo/scene_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <vector>

#include "motus/core/numeric.hpp"

namespace motus::stereo {
namespace {

/// The value of which `share` of the values are smaller. Orders the values.
[[nodiscard]] double quantile(std::span<double> values, double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto index = static_cast<std::size_t>(place);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), middle, values.end());
    const double part = place - static_cast<double>(index);
    if (part == 0.0) return *middle;
    const double next = *std::min_element(middle + 1, values.end());
    return *middle + part * (next - *middle);
}

/// The samples within `ahead` of an index.
[[nodiscard]] std::span<const double> around(std::span<const double> values, std::size_t index,
                                             std::size_t ahead) {
    const std::size_t first = index > ahead ? index - ahead : 0;
    const std::size_t last = std::min(index + ahead + 1, values.size());
    return values.subspan(first, last - first);
}

}  // namespace

std::optional<Range> depth_range(std::span<const double> depths, double low, double high) {
    require(low >= 0.0 && low < 1.0, "low: must be from 0 to 1");
    require(high > low && high <= 1.0, "high: must be above low, and 1 at most");
    std::vector<double> found;
    found.reserve(depths.size());
    std::ranges::copy_if(depths, std::back_inserter(found),
                         [](double depth) { return depth > 0.0 && std::isfinite(depth); });
    if (found.empty()) return std::nullopt;
    const double nearest = quantile(found, low);
    return Range{nearest, quantile(found, high)};
}

Window window_violations(const Eyes& eyes, std::span<const Sample> samples, double tolerance) {
    require(tolerance >= 0.0 && std::isfinite(tolerance), "tolerance: must be at least 0 and finite");
    check(eyes);
    Window window;
    for (const Sample& sample : samples) {
        if (!(sample.depth > 0.0) || std::isnan(sample.x)) continue;
        // Nearer than parallax() allows, a point is at the edge of what it allows.
        const double found = -parallax(eyes, std::max(sample.depth, 1e-30));
        if (found <= tolerance) continue;
        // In front of the screen the left eye sees a point further right than the right eye does.
        const double in_left = sample.x + 0.5 * found, in_right = sample.x - 0.5 * found;
        if (in_right < -0.5 && in_left >= -0.5) window.left = std::max(window.left, found);
        if (in_left > 0.5 && in_right <= 0.5) window.right = std::max(window.right, found);
    }
    return window;
}

void smooth(std::span<const double> values, std::size_t ahead, Side side, std::span<double> out) {
    require(out.size() == values.size(), "out: must have as many numbers as values");
    require(ahead <= most_ahead, "ahead: must be at most 10000");
    constexpr double most = 1e300;  // sums of differences do not overflow
    require(std::ranges::all_of(values, [](double value) { return std::abs(value) <= most; }),
            "values: must be 1e300 at most in size");
    ahead = std::min(ahead, values.size());
    // The least of all values in reach is below each of them, and so is any mean of such numbers in reach.
    std::vector<double> bound(values.begin(), values.end());
    if (side != Side::either) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto near = around(values, i, ahead);
            bound[i] =
                side == Side::below ? *std::ranges::min_element(near) : *std::ranges::max_element(near);
        }
    }
    std::vector<double> weights(ahead + 1);
    for (std::size_t i = 0; i <= ahead; ++i)
        weights[i] =
            0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(ahead + 1));
    for (std::size_t i = 0; i < values.size(); ++i) {
        // Differences from the middle: constant values stay as they are.
        double sum = 0.0, total = weights[0];
        for (std::size_t j = 1; j <= ahead; ++j) {
            // Beyond an end the value at the end counts: the curve has no lag there either.
            const double before = i >= j ? bound[i - j] : bound.front();
            const double behind = i + j < bound.size() ? bound[i + j] : bound.back();
            sum += weights[j] * ((before - bound[i]) + (behind - bound[i]));
            total += 2.0 * weights[j];
        }
        out[i] = bound[i] + sum / total;
    }
}

}  // namespace motus::stereo
