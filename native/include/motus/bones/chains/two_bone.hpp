// Inverse kinematics of two bones and a target, in closed form (analytic, two-bone IK).
// Angles by Kahan, "Miscalculating Area and Angles of a Needle-like Triangle" (2014), section 6; the soft
// reach by a finite power (see soft_reach).
//
// Costs: O(1) a chain, some 20 ns. Allocates nothing. Any number of threads at once, each with an `out` of
// its own.
#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "motus/bones/reason.hpp"
#include "motus/config.hpp"

namespace motus::bones::chains {

/// A chain of two bones. Any space, any unit of length.
struct TwoBone {
    glm::dvec3 root{0.0};
    glm::dvec3 target{0.0, 2.0, 0.0};
    glm::dvec3 pole{0.0, 1.0, 1.0};  ///< point that the elbow bends towards, seen across root-target
    double length1 = 1.0;            ///< root to elbow, >= 0
    double length2 = 1.0;            ///< elbow to tip, >= 0
    double softness = 0.0;           ///< length before the full reach at which the arm begins to slow, >= 0;
                                     ///< above length1 + length2 it is clamped to that
    double stretch = 0.0;            ///< share, 0 to 1, of the missing length that both bones stretch by
    /// Normal, of any length, of the plane to bend in if the pole gives none: the elbow is then on the
    /// side of plane x (target - root), whatever `bend`. Zero: some fixed normal across root-target, times
    /// `bend`. The pole fades out by smoothstep if, seen from the root, the sine of its angle to the line
    /// falls below pole_band; a pole nearer than length1 + length2 counts as that far away, so that a
    /// pole that passes by the root does not flip the elbow. A plane that is itself near the line gives way
    /// to the fixed normal in the same manner.
    glm::dvec3 plane{0.0, 0.0, 0.0};
    int bend = 1;  ///< 1: towards the pole; -1: away from it
};

inline constexpr double pole_band = 0.1;  ///< with a plane: the pole fades out below 6 degrees
inline constexpr double pole_band_no_plane =
    1e-3;  ///< without one: only so that rounding does not choose the side

struct TwoBoneSolution {
    glm::dvec3 elbow{0.0};
    glm::dvec3 tip{0.0};
    glm::dvec3 normal{1.0, 0.0, 0.0};  ///< unit, across the plane of the bend: normal x (target - root)
                                       ///< points to the elbow's side
    double scale = 1.0;                ///< of both bones, > 1 if they are stretched
    double residual = 0.0;             ///< distance from tip to target
    Reason reason = Reason::reached;   ///< reached: residual <= reach_tolerance * (length1 + length2 +
                                       ///< |target - root|)
};

inline constexpr double reach_tolerance = 1e-12;

/// Angle, rad, between the sides a and b of a triangle, opposite the side c; all >= 0 and finite. Kahan's
/// formula: full relative precision for needles. Sides that make no triangle give 0 (c too short) or pi (c
/// too long); pi/2 if a or b is 0 and the others are equal.
[[nodiscard]] double triangle_angle(double a, double b, double c);

/// Distance from the root at which the tip stands when the target is at `distance` >= 0. reach >= 0 = length
/// of the straight chain, softness ds, brought into [0, reach]. With da = reach - ds: d below da,
/// then reach - ds (1 - (d - da) / (n ds))^n up to da + n ds with n = 3, reach beyond: slope 1 at da,
/// straight exactly at reach + 2 ds. The curve and its slope never jump; its second derivative begins with a
/// step of -2 / (3 ds) at da and ends at 0, which is what keeps the knee's velocity from jumping when the leg
/// becomes straight.
[[nodiscard]] double soft_reach(double distance, double reach, double softness);

/// Where elbow and tip stand. Defined for every finite input with the domains above, zero lengths and
/// coincident points included; never NaN, and finite (what would overflow becomes the largest double). Throws
/// std::invalid_argument, naming the number, if one is not finite, or a length is below 0.
///
/// The target within reach and softness: the tip is the target itself, and the bones fit between root, elbow
/// and tip to 2e-15 of length1 + length2 in the space of the root. Adding the root rounds each coordinate of
/// the elbow by up to 1.1e-16 of its size: at 1 km from the origin 1e-13 m, whatever the solver does.
/// Out of reach: on the line to the target, exactly straight (too far) or exactly folded (too near).
/// Target on the root: the elbow is towards the pole (`bend` -1: away from it) and the second bone folds back
/// onto the first. Pole on the root as well: any direction in the plane.
[[nodiscard]] TwoBoneSolution solve_two_bone(const TwoBone& chain);

/// Solves many chains, with bit for bit the results of solve_two_bone. Allocates nothing. Throws
/// std::invalid_argument, before anything is written, if the sizes differ, and as solve_two_bone does.
void solve_two_bones(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out);

}  // namespace motus::bones::chains
