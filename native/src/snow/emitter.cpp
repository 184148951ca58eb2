#include "emitter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "floats.hpp"
#include "motus/core/numeric.hpp"

namespace motus::snow {
namespace {

/// Keeps the matrix's Z, whatever its size, and of its X what is across that.
[[nodiscard]] glm::dmat3 rotation_of(const glm::dmat3& matrix) {
    const glm::dvec3 z = direction_of(matrix[2]).value_or(glm::dvec3(0.0, 0.0, 1.0));
    const auto across = [&](const glm::dvec3& v) {
        return direction_or(v - glm::dot(v, z) * z, glm::dvec3(0.0));
    };
    glm::dvec3 x = across(unit_vector(matrix[0]));
    if (x == glm::dvec3(0.0)) x = across(std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    return {x, glm::cross(z, x), z};
}

[[nodiscard]] Rows rows_of(const glm::dmat3& matrix) {
    Rows rows{};
    std::size_t at = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) rows[at++] = static_cast<float>(matrix[column][row]);
    return rows;
}

/// The angle in whole turns, by its half's sine and cosine, neither below 0. The system's arc tangent differs
/// between processors.
[[nodiscard]] double turn_of(double sine, double cosine) {
    // Three halvings bring the half angle below pi / 16, where the series takes few terms.
    double scale = 2.0;
    for (int halving = 0; halving < 3; ++halving) {
        const double half = std::sqrt(0.5 * (1.0 + cosine));
        sine /= 2.0 * half;
        cosine = half;
        scale *= 2.0;
    }
    const double t = sine / cosine;
    double sum = 0.0;
    for (int k = 12; k >= 0; --k) sum = (k % 2 == 0 ? 1.0 : -1.0) / (2 * k + 1) + t * t * sum;
    return scale * t * sum / (2.0 * std::numbers::pi);
}

}  // namespace

Emitter::Emitter(std::span<const double> times, std::span<const glm::dmat4> matrices)
    : times_(times.begin(), times.end()) {
    require(times.size() == matrices.size(), "emitter_matrices: must be as many as emitter_times");
    require(are_finite(times), "emitter_times: must be finite");
    require(std::ranges::adjacent_find(times, std::ranges::greater_equal{}) == times.end(),
            "emitter_times: must rise");
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < times.size(); ++i) {
        require(is_finite(matrices[i]), "emitter_matrices: must be finite");
        const glm::dmat3 linear(matrices[i]);
        const glm::dmat3 rotation = rotation_of(linear);
        poses.push_back({times[i], glm::dvec3(matrices[i][3]), glm::normalize(glm::quat_cast(rotation)),
                         glm::transpose(rotation) * linear});
    }
    if (poses.empty()) poses.emplace_back();

    parts_.push_back({still(poses.front())});
    for (std::size_t i = 1; i < poses.size(); ++i)
        parts_.push_back(
            {between(poses[i - 1], poses[i]), poses[i - 1].time, poses[i].time - poses[i - 1].time});
    parts_.push_back({still(poses.back())});
}

Glide Emitter::still(const Pose& pose) {
    Glide glide;
    const glm::dmat3 rotation = glm::mat3_cast(pose.rotation);
    glide.stretch = rows_of(rotation * pose.stretch);
    glide.rotation = rows_of(rotation);
    const glm::quat q(pose.rotation);
    glide.quaternion = {q.w, q.x, q.y, q.z};
    glide.location = floats_of(pose.location);
    return glide;
}

Glide Emitter::between(const Pose& a, const Pose& b) {
    if (a.location == b.location && a.rotation == b.rotation && a.stretch == b.stretch) return still(a);
    Glide glide = still(a);
    glide.is_moving = true;
    glide.stretch = rows_of(a.stretch);
    glide.stretch_change = rows_of(b.stretch - a.stretch);
    glide.location_change = floats_of(b.location - a.location);
    glide.velocity = floats_of((b.location - a.location) / (b.time - a.time));
    glm::dquat turn = glm::conjugate(a.rotation) * b.rotation;
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = length_of(axis);
    glide.axis = floats_of(unit_vector(axis));
    glide.turn = static_cast<float>(turn_of(sine, turn.w));
    return glide;
}

std::size_t Emitter::part_at(double time) const {
    if (times_.empty()) return 0;
    return static_cast<std::size_t>(std::ranges::upper_bound(times_, time) - times_.begin());
}

double Emitter::end_of(std::size_t part) const {
    return part < times_.size() ? times_[part] : std::numeric_limits<double>::infinity();
}

Glide Emitter::glide(std::size_t part, double birth, double earlier) const {
    const Part& from = parts_[part];
    Glide glide = from.glide;
    glide.w_start = static_cast<float>((birth - from.start) / from.length);
    glide.w_change = static_cast<float>(-earlier / from.length);
    return glide;
}

}  // namespace motus::snow
