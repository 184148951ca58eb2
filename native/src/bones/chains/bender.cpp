#include "bender.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "arc_bend.hpp"
#include "axes.hpp"

namespace motus::bones::chains {
namespace {

using std::numbers::pi;

constexpr double largest_turn = 0.7;  // rad, of a bone in one Newton step, about
constexpr int patience = 30;          // steps: usual are two or three, folded bones may creep for thousands

/// Directions in the arc with the given chord, and half the turn that it makes.
double lay_arc(const Bones& bones, double chord, PerBone<std::complex<double>>& directions) {
    const std::span<const double> lengths = bones.all_lengths();
    if (chord >= 1.0 - reach_rounding) {
        std::fill_n(directions.begin(), lengths.size(), 1.0);
        return 0.0;
    }
    if (chord <= bones.inner + reach_rounding && bones.inner > 0.0) {
        std::fill_n(directions.begin(), lengths.size(), -1.0);
        directions[static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin())] = 1.0;
        return pi;
    }
    const ArcBend arc(lengths, chord);
    arc.directions(lengths, directions);
    return arc.half_turn();
}

/// Vector whose part perpendicular to each bone is the turn of that bone: the least turns by which the tip
/// moves by `error`.
glm::dvec3 least_turn(const Bones& bones, const glm::dvec3& error) {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
    for (std::size_t i = 0; i < bones.count; ++i) {
        const glm::dvec3 u = bones.directions[i];
        const glm::dvec3 w = bones.lengths[i] * u;
        xx += w.x * u.x;
        xy += w.x * u.y;
        xz += w.x * u.z;
        yy += w.y * u.y;
        yz += w.y * u.z;
        zz += w.z * u.z;
    }
    // The sum of l (1 - u u^T) over the bones, whose lengths l add up to 1. For a straight chain 1 - xx = yy
    // + zz keeps its digits.
    const double damping = 1e-15;
    const glm::dmat3 mobility(yy + zz + damping, -xy, -xz, -xy, xx + zz + damping, -yz, -xz, -yz,
                              xx + yy + damping);
    return glm::inverse(mobility) * error;
}

}  // namespace

glm::dvec3 tip_of(const Bones& bones) {
    glm::dvec3 tip(0.0);
    for (std::size_t i = 0; i < bones.count; ++i) tip += bones.lengths[i] * bones.directions[i];
    return tip;
}

Bender::Bender(Bones& bones, double pose_chord, double chord)
    : bones_(bones), chord_(chord), pose_turn_(lay_arc(bones, pose_chord, pose_arc_)) {
    const double turn = lay_arc(bones, chord, arc_);
    if (bones.count == 2) {  // a triangle: no other shape has this chord
        for (std::size_t i = 0; i < 2; ++i) bones.directions[i] = {arc_[i].real(), arc_[i].imag(), 0.0};
    } else if (chord > pose_chord) {
        open(turn / pose_turn_);
    } else {
        bend(pose_chord);
    }
}

void Bender::open(double share) {
    for (std::size_t i = 0; i < bones_.count; ++i) {
        glm::dvec3& direction = bones_.directions[i];
        const double sine = std::hypot(direction.y, direction.z);
        if (sine < 1e-12 && direction.x > 0.0) continue;
        const double angle = share * std::atan2(sine, direction.x);
        const double size = std::sin(angle);
        if (sine < 1e-12) {  // straight back: to the side on which the arc has this bone
            direction = {std::cos(angle), std::copysign(size, arc_[i].imag()), 0.0};
        } else {
            direction = {std::cos(angle), direction.y / sine * size, direction.z / sine * size};
        }
    }
}

void Bender::bend(double pose_chord) {
    // If one bone is longer than all others together, every pose ends in the pose folded onto that bone.
    const double rest = chord_ - bones_.inner;
    const double way = bones_.inner > 0.0 ? (pose_chord - chord_) / (pose_chord - bones_.inner) : 0.0;
    const double away = way > 0.0 ? 1.0 - std::sqrt(rest / (rest + bones_.inner * way)) : 0.0;
    for (std::size_t i = 0; i < bones_.count; ++i) {
        glm::dvec3& direction = bones_.directions[i];
        const double re = arc_[i].real() * pose_arc_[i].real() + arc_[i].imag() * pose_arc_[i].imag();
        const double im = arc_[i].imag() * pose_arc_[i].real() - arc_[i].real() * pose_arc_[i].imag();
        direction = {direction.x * re - direction.y * im, direction.x * im + direction.y * re, direction.z};
        if (away > 0.0) blend_with_arc(i, away);
    }
}

void Bender::blend_with_arc(std::size_t bone, double share) {
    const glm::dvec3 wanted(arc_[bone].real(), arc_[bone].imag(), 0.0);
    const glm::dvec3 mixed = (1.0 - share) * bones_.directions[bone] + share * wanted;
    const double size = glm::length(mixed);
    bones_.directions[bone] = size > 1e-9 ? mixed / size : wanted;
}

bool Bender::descend(double tolerance, int last_iteration, int& iterations) {
    const glm::dvec3 target(chord_, 0.0, 0.0);
    PerBone<glm::dvec3> tried;
    glm::dvec3 error = target - tip_of(bones_);
    double residual = glm::length(error);
    double share = 1.0;
    while (residual > tolerance && iterations < last_iteration) {
        const glm::dvec3 turn = least_turn(bones_, error);
        const double size = glm::length(turn);
        if (!std::isfinite(size)) return false;
        const double step = std::min(share, largest_turn / size);
        glm::dvec3 tip(0.0);
        for (std::size_t i = 0; i < bones_.count; ++i) {
            const glm::dvec3 u = bones_.directions[i];
            const glm::dvec3 moved = u + step * across(turn, u);
            tried[i] = moved / glm::length(moved);
            tip += bones_.lengths[i] * tried[i];
        }
        ++iterations;
        const double now = glm::length(target - tip);
        if (now < residual) {
            error = target - tip;
            residual = now;
            std::copy_n(tried.begin(), bones_.count, bones_.directions.begin());
            share = 1.0;
        } else {
            share = 0.25 * step;
            if (share < 1e-3) return false;
        }
    }
    return residual <= tolerance;
}

bool Bender::finish(double tolerance, int max_iterations, int& iterations) {
    // If the Newton steps do not bring a pose to the target, the pose is led towards the arc, which reaches
    // the target without steps.
    for (const double share : {0.0, 0.5, 1.0}) {
        if (share > 0.0) {
            for (std::size_t i = 0; i < bones_.count; ++i) blend_with_arc(i, share);
        }
        const int last_iteration = std::min(max_iterations, iterations + patience);
        if (descend(tolerance, last_iteration, iterations)) return true;
        if (iterations >= max_iterations) return false;
    }
    return false;
}

}  // namespace motus::bones::chains
