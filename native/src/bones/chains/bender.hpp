// A chain brought to its target in the plane that it bends in. Private to the library.
#pragma once
#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "motus/bones/chains/chain.hpp"
#include "per_bone.hpp"

namespace motus::bones::chains {

/// A chain of bones from a root at the origin; the unit of length is the whole length of the chain.
struct Bones {
    std::size_t count = 0;
    double inner = 0.0;              ///< nearest that the tip can come to the root
    PerBone<double> lengths;         ///< their sum is 1
    PerBone<glm::dvec3> directions;  ///< unit

    [[nodiscard]] std::span<const double> all_lengths() const { return {lengths.data(), count}; }
};

/// Position of the tip, from the root.
[[nodiscard]] glm::dvec3 tip_of(const Bones& bones);

/// Room for rounding at both ends of the reach, as a share of the chain's length.
inline constexpr double reach_rounding = 1e-14;

/// Bends bones so that the tip stands on the first axis at the distance `chord` from the root, which is
/// neither out of reach nor too near. Their directions are given and changed in the axes of the solution: the
/// pose's tip on the first one at the distance `pose_chord`, the bend towards the second.
///
/// The start is one bend of the whole pose: to come nearer each bone turns as it would if the chain were an
/// arc; to go farther each bone's angle with the line to the tip shrinks in one proportion. A straight pose
/// makes an exact arc; other poses are brought on the target by Newton steps that turn the bones least.
class Bender {
  public:
    Bender(Bones& bones, double pose_chord, double chord);

    /// tolerance as a share of the chain's length. False if the iterations do not suffice.
    bool finish(double tolerance, int max_iterations, int& iterations);

  private:
    void bend(double pose_chord);
    void open(double share);
    void blend_with_arc(std::size_t bone, double share);
    bool descend(double tolerance, int last_iteration, int& iterations);

    Bones& bones_;
    double chord_;
    PerBone<std::complex<double>> pose_arc_;  // the bones' directions in the arc with the pose's chord
    PerBone<std::complex<double>> arc_;       // and in the one that reaches the target
    double pose_turn_;                        // half the turn of the former
};

}  // namespace motus::bones::chains
