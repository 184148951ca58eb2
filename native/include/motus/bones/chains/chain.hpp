// Inverse kinematics of chains of any length without joint limits: positions of the joints.
// One bend of the whole pose, an arc of a circle if it is straight, then Newton steps that turn the bones
// least.
//
// FABRIK (Aristidou and Lasenby 2011) is faster only for some 5 bones well within reach, 1.1 us against 1.6;
// it takes 6 times longer with 20 bones, and 150 times with 5 at 0.999 of the reach. Even for 5 bones it is
// not used: it changes the angle of one joint by 79 degrees while this solver changes none by more than 29,
// and if one solver handed over to the other the chain would jump by 0.4 of its length (medians;
// chain_bench.cpp).
//
// Costs: O(bones) an iteration. Allocates nothing. Any number of threads at once, each with joints of its
// own.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "motus/bones/reason.hpp"
#include "motus/config.hpp"

namespace motus::bones::chains {

inline constexpr std::size_t most_bones = 255;  ///< of one chain

struct SolverSettings {
    double tolerance = 1e-6;   ///< residual that counts as reached, as a fraction of the chain's length, >= 0
    int max_iterations = 100;  ///< >= 0
    std::optional<glm::dvec3>
        pole;               ///< point that the chain bends towards, seen across root-target: the mean of its
                            ///< joints' distances from that line. Blended out if its sine is below 0.1
    glm::dvec3 plane{0.0};  ///< normal to bend in if neither the pose nor the pole gives a plane (bend
                            ///< side: plane x (target - root)); blended in if the pose bends by less
                            ///< than 8 degrees, alone below 1. Zero: a fixed plane, for straight poses
};

/// Whether all coordinates are at most 1e300 in size; false for NaN.
[[nodiscard]] bool is_in_reach_of_doubles(const glm::dvec3& place);

/// Throws std::invalid_argument, naming the argument, if a number is not finite or outside its domain.
void check(const glm::dvec3& target, const SolverSettings& settings);

struct Convergence {
    double residual = 0.0;  ///< |tip - target|
    int iterations = 0;     ///< Newton steps; the first bend does not count
    Reason reason = Reason::reached;
};

/// Moves joints[1..] so that the last one comes to the target, keeping the root and every bone's length, from
/// the given pose (the animated one: the solution keeps its shape and its plane of bending as far as it can).
/// The pose is turned by the smallest rotation that points its tip at the target, then bent. A straight or
/// folded pose and a target on the root are fine; a target out of reach gives the nearest reachable point,
/// exactly straight or exactly folded. joints.size() in [2, most_bones + 1], else std::invalid_argument.
/// Continuous in the target, except for targets on the root or right behind it as the pose sees it, and in
/// the pose if the pose defines a plane. Deterministic; allocates nothing; never NaN for coordinates up to
/// 1e300. Throws std::invalid_argument, naming the argument and before anything is written, if a number is
/// not finite or outside its domain.
Convergence solve(std::span<glm::dvec3> joints, const glm::dvec3& target, const SolverSettings& settings);

}  // namespace motus::bones::chains
