#include "motus/bones/chains/chain.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "axes.hpp"
#include "bender.hpp"
#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::chains {
namespace {

constexpr double closed = 1e-9;     // of the length: a tip nearer to the root shows no direction
constexpr double on_line = 1e-12;   // of the length: joints nearer to the line from root to tip have no side
constexpr double bulge_band = 0.1;  // of the joints' distances from that line, what is left in their mean
constexpr double fits = 1e100;      // coordinates up to here, and down to its inverse, may be squared

/// A power of two by which the joints are multiplied if their squares would over- or underflow.
double scale_for(std::span<const glm::dvec3> joints) {
    double largest = 0.0;
    for (const glm::dvec3& joint : joints) {
        const glm::dvec3 away = glm::abs(0.5 * joint - 0.5 * joints[0]);
        largest = std::max({largest, away.x, away.y, away.z});
    }
    if (largest == 0.0 || (largest < fits && largest > 1.0 / fits)) return 1.0;
    return std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
}

/// Reads the bones in units of the chain's whole length. Returns that length times `scale`; 0 if the chain
/// has none.
double read_bones(std::span<const glm::dvec3> joints, double scale, Bones& bones) {
    bones.count = joints.size() - 1;
    double total = 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < bones.count; ++i) {
        const glm::dvec3 link = scale * joints[i + 1] - scale * joints[i];
        const double length = glm::length(link);
        bones.lengths[i] = length;
        bones.directions[i] = length > 0.0 ? link / length : glm::dvec3(0.0, 1.0, 0.0);
        total += length;
        longest = std::max(longest, length);
    }
    if (total <= 0.0) return 0.0;
    for (std::size_t i = 0; i < bones.count; ++i) bones.lengths[i] /= total;
    bones.inner = std::max(0.0, 2.0 * longest / total - 1.0);
    return total;
}

/// How far the joints lie to the side of the line from root to tip, over the length of the chain.
struct Bulge {
    glm::dvec3 mean{0.0};
    double spread = 0.0;  // mean of the distances
};

Bulge bulge_of(const Bones& bones, const glm::dvec3& along) {
    Bulge bulge;
    glm::dvec3 joint(0.0);
    for (std::size_t i = 0; i + 1 < bones.count; ++i) {
        joint += bones.lengths[i] * bones.directions[i];
        const glm::dvec3 side = across(joint, along);
        const double weight = 0.5 * (bones.lengths[i] + bones.lengths[i + 1]);
        bulge.mean += weight * side;
        bulge.spread += weight * glm::length(side);
    }
    return bulge;
}

/// Direction of a pose whose tip lies on its root: perpendicular to its bulge, as it is for an arc that
/// closes to a circle.
glm::dvec3 direction_of_closed(const Bones& bones) {
    glm::dvec3 area(0.0), bulge(0.0), joint(0.0);
    for (std::size_t i = 0; i + 1 < bones.count; ++i) {
        const glm::dvec3 link = bones.lengths[i] * bones.directions[i];
        area += glm::cross(joint, link);
        joint += link;
        bulge += 0.5 * (bones.lengths[i] + bones.lengths[i + 1]) * joint;
    }
    const double size = glm::length(bulge);
    if (size <= closed) return bones.directions[0];
    // The arc turns from its bulge towards the root: against `area`.
    return glm::cross(bulge / size, normal_across(bulge / size, -area));
}

/// Turns the chain about the line from root to target until its bulge is on the side of the pole, a unit
/// vector.
void face_pole(Bones& bones, const Axes& axes, const glm::dvec3& pole) {
    const glm::dvec3 pole_side = across(pole, axes.along);
    const double weight = smooth_step(glm::length(pole_side) / pole_band);
    if (weight <= 0.0) return;

    const Bulge bulge = bulge_of(bones, axes.along);
    const double size = glm::length(bulge.mean);
    // If joints lie on all sides of the line, the plane of the bend is a better measure than the mean of the
    // joints.
    const double certainty = bulge.spread > on_line ? smooth_step(size / (bulge_band * bulge.spread)) : 0.0;
    // Made perpendicular once more: the smaller the bulge, the larger the rounding of its direction.
    const glm::dvec3 side = certainty > 0.0 ? blended_normal(axes.side, normal_across(axes.along, bulge.mean),
                                                             axes.along, certainty)
                                            : axes.side;
    const glm::dvec3 wanted = blended_normal(side, glm::normalize(pole_side), axes.along, weight);
    const double sine_of_turn = glm::dot(axes.along, glm::cross(side, wanted));
    const double cosine_of_turn = glm::dot(side, wanted);
    for (std::size_t i = 0; i < bones.count; ++i) {
        glm::dvec3& direction = bones.directions[i];
        const double part = glm::dot(direction, axes.along);
        const glm::dvec3 rest = direction - part * axes.along;
        direction = part * axes.along + cosine_of_turn * rest + sine_of_turn * glm::cross(axes.along, rest);
    }
}

/// The target and pole of a solve, relative to the root.
struct Task {
    glm::dvec3 along;  // towards the target; zero if it is on the root
    double distance;   // to the target, in units of the chain's length
    glm::dvec3 pole;   // towards the pole; zero without one
};

/// Lays all bones along a direction, straight or folded, whatever the pose is.
void lay_along(Bones& bones, const glm::dvec3& along, bool folded) {
    std::fill_n(bones.directions.begin(), bones.count, folded ? -along : along);
    const auto lengths = bones.all_lengths();
    const auto longest = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
    bones.directions[static_cast<std::size_t>(longest)] = along;
}

/// Brings the tip to the target; returns the number of iterations.
int bring_to_target(Bones& bones, Task task, const SolverSettings& settings) {
    const glm::dvec3 tip = tip_of(bones);
    const double pose_chord = glm::length(tip);
    const glm::dvec3 pose_along = pose_chord > closed ? tip / pose_chord : direction_of_closed(bones);
    const glm::dvec3 along = task.distance > 0.0 ? task.along : pose_along;
    // Without this, joints in one line would bend by the square root of a rounding error.
    if (std::abs(task.distance - pose_chord) <= reach_rounding) task.distance = pose_chord;
    if (task.distance >= 1.0 - reach_rounding ||
        (bones.inner > 0.0 && task.distance <= bones.inner + reach_rounding)) {
        lay_along(bones, along, task.distance < 0.5 * (bones.inner + 1.0));
        return 0;
    }

    // For two equal bones that bend by a small angle, the mean of the joints is an eighth of the angle off
    // the line.
    const glm::dvec3 bulge = bulge_of(bones, pose_along).mean;
    const double bend = 8.0 * glm::length(bulge);
    const bool has_plane = settings.plane != glm::dvec3(0.0);
    const double certainty = has_plane ? certainty_of_bend(bend) : smooth_step(1e5 * bend);
    const glm::dvec3 pose_normal = normal_across(pose_along, glm::cross(pose_along, bulge));
    const Swing swing(pose_along, along, pose_normal);
    const glm::dvec3 spare = has_plane
                                 ? normal_across(along, settings.plane)
                                 : normal_across(along, swing(normal_across(pose_along, glm::dvec3(0.0))));
    // Made perpendicular once more: near opposite directions the swing is only as exact as the sum of the
    // two.
    const glm::dvec3 carried = normal_across(along, swing(pose_normal));
    const Axes axes = Axes::of(along, blended_normal(spare, carried, along, certainty));

    for (std::size_t i = 0; i < bones.count; ++i) {
        const glm::dvec3 local = axes.to_local(swing(bones.directions[i]));
        bones.directions[i] = local / glm::length(local);
    }
    int iterations = 0;
    Bender bender(bones, std::min(pose_chord, 1.0), task.distance);
    bender.finish(settings.tolerance, settings.max_iterations, iterations);
    for (std::size_t i = 0; i < bones.count; ++i) bones.directions[i] = axes.to_world(bones.directions[i]);
    if (task.pole != glm::dvec3(0.0)) face_pole(bones, axes, task.pole);
    return iterations;
}

Reason reason_of(const Bones& bones, double distance) {
    if (distance >= 1.0) return Reason::too_far;
    if (distance <= bones.inner) return Reason::too_near;
    return Reason::iterations;
}

}  // namespace

bool is_in_reach_of_doubles(const glm::dvec3& place) {
    constexpr double largest = 1e300;
    return std::abs(place.x) <= largest && std::abs(place.y) <= largest && std::abs(place.z) <= largest;
}

void check(const glm::dvec3& target, const SolverSettings& settings) {
    require(is_in_reach_of_doubles(target), "target: must be finite, and 1e300 at most");
    require(settings.tolerance >= 0.0 && std::isfinite(settings.tolerance),
            "tolerance: must be at least 0 and finite");
    require(settings.max_iterations >= 0, "max_iterations: must be at least 0");
    require(!settings.pole || is_in_reach_of_doubles(*settings.pole),
            "pole: must be finite, and 1e300 at most");
    require(is_finite(settings.plane), "plane: must be finite");
}

Convergence solve(std::span<glm::dvec3> joints, const glm::dvec3& target, const SolverSettings& settings) {
    require(joints.size() >= 2 && joints.size() <= most_bones + 1,
            "joints: must be 2 or more, and 256 at most");
    require(std::ranges::all_of(joints, is_in_reach_of_doubles), "joints: must be finite, and 1e300 at most");
    check(target, settings);
    const glm::dvec3 root = joints[0];
    const glm::dvec3 half_way = 0.5 * target - 0.5 * root;  // the whole might overflow
    const double scale = scale_for(joints);
    Bones bones;
    const double length = read_bones(joints, scale, bones) / scale;
    Convergence report;
    Task task{unit_vector(half_way), 0.0, glm::dvec3(0.0)};
    if (length > 0.0) {
        task.distance = 2.0 * (glm::dot(task.along, half_way) / length);
        if (settings.pole) task.pole = unit_vector(0.5 * *settings.pole - 0.5 * root);
        report.iterations = bring_to_target(bones, task, settings);
        glm::dvec3 joint(0.0);
        for (std::size_t i = 0; i < bones.count; ++i) {
            joint += bones.lengths[i] * bones.directions[i];
            joints[i + 1] = root + length * joint;
        }
    }
    report.residual = length_of(joints.back() - target);
    const double rounding = 1e-15 * (length_of(root) + length_of(target));
    if (report.residual > settings.tolerance * length + rounding)
        report.reason = length > 0.0 ? reason_of(bones, task.distance) : Reason::too_far;
    return report;
}

}  // namespace motus::bones::chains
