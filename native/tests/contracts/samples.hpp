// Good arguments that several topics share.
#pragma once
#include <memory>

#include "motus/curve/arc_length.hpp"
#include "motus/curve/bezier.hpp"
#include "motus/curve/curve.hpp"

namespace motus::contracts {

[[nodiscard]] inline std::vector<glm::dvec3> sample_points() {
    return {{0.0, 0.0, 0.0}, {1.0, 0.5, 0.2},  {2.0, -0.5, 0.4}, {3.0, 0.0, 0.0},
            {3.0, 0.0, 0.0}, {4.0, 0.5, -0.3}, {5.0, 1.5, 0.0},  {5.0, 3.0, 0.5}};
}
/// Two cubic segments.
[[nodiscard]] inline const curve::Curve& sample_curve() {
    static const curve::Curve made = curve::Curve::chain(3, sample_points(), false);
    return made;
}
[[nodiscard]] inline const std::shared_ptr<const curve::ArcLength>& sample_path() {
    static const auto made = std::make_shared<const curve::ArcLength>(sample_curve());
    return made;
}
[[nodiscard]] inline auto points_of(const curve::Curve& curve) {
    return std::vector<glm::dvec3>(curve.control_points().begin(), curve.control_points().end());
}

/// Throws if what a check of a moved-from object finds is not so.
inline void expect(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}
/// Expects that a call throws std::invalid_argument.
template <class Call>
void expect_refusal(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument&) {
        return;
    }
    throw std::logic_error("is not refused");
}

}  // namespace motus::contracts
