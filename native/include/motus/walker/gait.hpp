// In which order legs step: a phase for each leg and one duty factor, as in McGhee, "Some finite state
// aspects of legged locomotion" (1968). On one side insects step from the back to the front: Wilson, "Insect
// walking" (1966).
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace motus::walker {

/// Of legs in two rows, L1 the left one in front:
enum class Gait {
    tripod,    ///< neighbours alternate: L1 R2 L3 | R1 L2 R3
    tetrapod,  ///< the same, and all stand for a moment between: L1 R2 L3 R4 | R1 L2 R3 L4
    ripple,    ///< on each side from the back to the front, the sides about half a cycle apart
    wave,      ///< one after the other: the left ones from the back to the front, then the right ones
    trot,      ///< the front half of a side with the rear half of the other side
    pace,      ///< all left ones, all right ones
};

/// When each leg of a cycle swings: while the fraction of (phase + phases[i]) is below 1 - duty.
struct Pattern {
    std::vector<double> phases;  ///< of a cycle, [0, 1)
    double duty = 0.5;           ///< the part of a cycle for which a foot stands
};

inline constexpr std::size_t most_legs = 256;
/// Of a cycle; Pattern::duty.
inline constexpr double least_duty = 0.05, most_duty = 0.95;

/// rest: where feet stand when the body rests, in any order, in the space of forward and up. Legs are left or
/// right of the middle of all; those in the middle count to the side that has fewer. Throws
/// std::invalid_argument, naming the argument, where there are no legs or more than most_legs, a number is
/// not finite, or forward and up are parallel or zero.
[[nodiscard]] Pattern pattern_of(Gait gait, std::span<const glm::dvec3> rest, const glm::dvec3& forward,
                                 const glm::dvec3& up);

}  // namespace motus::walker
