// Random chains of two bones, and checks of their solutions.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/chains/two_bone.hpp"
#include "motus/core/numeric.hpp"
#include "random.hpp"

namespace motus::bones::chains::checks {

class RandomTwoBones : public test::Random {
  public:
    using Random::Random;

    /// Lengths from 0.1 to 2, near the origin, the target within reach.
    [[nodiscard]] TwoBone reachable() {
        TwoBone chain;
        chain.length1 = between(0.1, 2.0);
        chain.length2 = between(0.1, 2.0);
        const double shortest = std::abs(chain.length1 - chain.length2);
        const double longest = chain.length1 + chain.length2;
        chain.root = at_distance(0.0, 1.0);
        const double span = longest - shortest;
        chain.target = chain.root + at_distance(shortest + 1e-9 * span, longest - 1e-9 * span);
        chain.pole = at_distance(0.0, 5.0);
        chain.bend = between(0.0, 1.0) < 0.5 ? 1 : -1;
        return chain;
    }

    /// Numbers of every size that a double can have, zeros and repeated ones included.
    [[nodiscard]] TwoBone wild() {
        TwoBone chain;
        chain.root = wild_point(glm::dvec3(0.0));
        chain.target = wild_point(chain.root);
        chain.pole = wild_point(between(0.0, 1.0) < 0.5 ? chain.root : chain.target);
        chain.plane = wild_point(glm::dvec3(0.0));
        chain.length1 = std::abs(wild_number());
        chain.length2 = between(0.0, 1.0) < 0.3 ? chain.length1 : std::abs(wild_number());
        chain.softness = between(0.0, 1.0) < 0.5 ? 0.0 : std::abs(wild_number());
        chain.stretch = std::clamp(between(-1.0, 2.0), 0.0, 1.0);
        chain.bend = between(0.0, 1.0) < 0.5 ? 1 : -1;
        return chain;
    }

  private:
    [[nodiscard]] double wild_number() {
        const double kind = between(0.0, 1.0);
        if (kind < 0.1) return 0.0;
        if (kind < 0.2) return between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
        if (kind < 0.5) return between(-2.0, 2.0);
        if (kind < 0.6) return std::bit_cast<double>(std::uint64_t{1} + (bits() & 0xFFFFFU));
        if (kind < 0.65) return 1.7976931348623157e308;
        double value = std::nan("");
        while (!std::isfinite(value)) value = std::bit_cast<double>(bits());
        return value;
    }

    [[nodiscard]] glm::dvec3 wild_point(const glm::dvec3& other) {
        const double kind = between(0.0, 1.0);
        if (kind < 0.2) return other;
        const glm::dvec3 point{wild_number(), wild_number(), wild_number()};
        if (kind < 0.4) return {point.x, other.y, other.z};
        return point;
    }
};

/// How far the bones' lengths, once stretched, are from those between the joints.
[[nodiscard]] inline double length_error(const TwoBone& chain, const TwoBoneSolution& at) {
    return std::max(std::abs(glm::distance(chain.root, at.elbow) - chain.length1 * at.scale),
                    std::abs(glm::distance(at.elbow, at.tip) - chain.length2 * at.scale));
}

/// v without its part along a unit vector.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& line) {
    return v - glm::dot(v, line) * line;
}

[[nodiscard]] inline bool same_bits(const TwoBoneSolution& a, const TwoBoneSolution& b) {
    return a.elbow == b.elbow && a.tip == b.tip && a.normal == b.normal && a.scale == b.scale &&
           a.residual == b.residual && a.reason == b.reason;
}

}  // namespace motus::bones::chains::checks
