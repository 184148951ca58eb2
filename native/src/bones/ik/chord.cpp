#include <cmath>
#include <glm/geometric.hpp>

#include "aim.hpp"
#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/turns.hpp"

namespace motus::bones::ik {
namespace {

/// The axis about which the second bone bends against the first, as the pose carries it. A mirrored pose
/// mirrors the bend, so that the axis has to be reversed.
glm::dvec3 hinge_of(const Pose& pose, double hinge_angle) {
    const glm::dmat3& axes = pose.posed(0).axes;
    const glm::dvec3 hinge = axes * glm::dvec3(std::cos(hinge_angle), 0.0, -std::sin(hinge_angle));
    return handedness(axes) * hinge;
}

}  // namespace

Chord chord_of(const Pose& pose, std::size_t count, double hinge_angle) {
    const std::span<const glm::dvec3> joints = pose.joints();
    glm::dvec3 area(0.0);  // sum of the cross products of all pairs of bones, later x earlier
    double length = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 bone = joints[i + 1] - joints[i];
        const double square = glm::dot(bone, bone);
        squares += square;
        length += std::sqrt(square);
        area += glm::cross(bone, joints[i] - joints[0]);
    }
    const double pairs =
        0.5 * (length * length - squares);  // the value of `area` if all bones are at right angles

    Chord chord;
    const glm::dvec3 line = joints[count] - joints[0];
    constexpr double closed = 1e-9;
    const glm::dvec3 first = direction_or(joints[1] - joints[0], chord.along);
    chord.along =
        glm::dot(line, line) > closed * closed * length * length ? direction_or(line, first) : first;

    const glm::dvec3 across = area - glm::dot(area, chord.along) * chord.along;
    const double size = glm::length(across);
    const double weight = count > 1 && size > 0.0 ? chains::certainty_of_bend(size / pairs) : 0.0;
    if (weight >= 1.0) {
        chord.normal = across / size;
        return chord;
    }
    chord.normal = chains::normal_across(chord.along, hinge_of(pose, hinge_angle));
    if (weight > 0.0) chord.normal = chains::blended_normal(chord.normal, across / size, chord.along, weight);
    return chord;
}

}  // namespace motus::bones::ik
