#include "steering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motus/core/sine.hpp"
#include "motus/noise/noise.hpp"

namespace motus::snow {
namespace {

/// The entries that kernel.hpp names.
[[nodiscard]] std::array<double, entries> rotation_of(double p, double q) {
    const auto [sx, cx] = sine_cosine(p);
    const auto [sy, cy] = sine_cosine(q);
    return {cy, sy, sx * sy, cx, -sx * cy, -cx * sy, sx, cx * cy};
}

/// Of an interval from 0 to 1: Gauss and Legendre's, exact for polynomials of degree 5.
constexpr double aside = 0.3872983346207417;  // sqrt(15) / 10
constexpr std::array<double, 3> places{0.5 - aside, 0.5, 0.5 + aside};
constexpr std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

}  // namespace

Steering::Steering(double max_angle, double frequency, std::uint64_t seed, double longest, double step,
                   std::size_t offsets) {
    const auto seed_x = static_cast<std::uint32_t>(2 * seed), seed_y = seed_x + 1;
    nodes_.resize(static_cast<std::size_t>(std::ceil(longest / step)) + 2 + offsets);
    std::array<double, entries> integral{};
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const auto time_at = [&](double part) { return frequency * step * (static_cast<double>(i) + part); };
        const auto rotation_at = [&](double part) {
            return rotation_of(-max_angle * noise::value(time_at(part), seed_x),
                               -max_angle * noise::value(time_at(part), seed_y));
        };
        Node& node = nodes_[i];
        node.integral = integral;
        node.slope = rotation_at(0.0);
        for (double& one : node.slope) one *= step;
        const double turns = -max_angle / (2.0 * std::numbers::pi);
        const double by_u = turns * frequency * step;
        node.angle = {turns * noise::value(time_at(0.0), seed_x), turns * noise::value(time_at(0.0), seed_y)};
        node.angle_slope = {by_u * noise::gradient(time_at(0.0), seed_x),
                            by_u * noise::gradient(time_at(0.0), seed_y)};
        for (std::size_t k = 0; k < places.size(); ++k) {
            const auto rotation = rotation_at(places[k]);
            for (std::size_t e = 0; e < entries; ++e) integral[e] += step * weights[k] * rotation[e];
        }
    }
    if (offsets > 0) make_own(step);
}

void Steering::make_own(double step) {
    // The integral of a rotation's entry is no larger than the time.
    const double longest = step * static_cast<double>(nodes_.size());
    double units = 0x1p30;  // a second
    while (units * longest >= 0x1p31) units *= 0.5;
    unit_ = static_cast<float>(1.0 / units);
    for (const Node& node : nodes_) {
        OwnNode& own = own_.emplace_back();
        for (std::size_t e = 0; e < entries; ++e) {
            own.integral[e] = static_cast<std::int32_t>(std::floor(units * node.integral[e] + 0.5));
            own.slope[e] = static_cast<float>(node.slope[e]);
        }
        OwnAngles& angles = own_angles_.emplace_back();
        for (std::size_t i = 0; i < 2; ++i) {
            angles.angle[i] = static_cast<float>(node.angle[i]);
            angles.slope[i] = static_cast<float>(node.angle_slope[i]);
        }
    }
    nodes_ = {};
}

void Steering::set(std::size_t node, Run& run) const {
    if (own_.empty()) {
        run.node = &nodes_[node];
        return;
    }
    run.own_origin = own_.data();
    run.own_node = &own_[node];
    run.own_angles = &own_angles_[node];
    run.unit = unit_;
}

}  // namespace motus::snow
