// The order in which legs step: a phase for each leg and one duty factor, as in McGhee, "Some finite state
// aspects of legged locomotion" (1968). Insects step from the back to the front on each side: Wilson, "Insect
// walking" (1966). Symmetrical gaits of quadrupeds, such as walk, trot and pace: Hildebrand, "Symmetrical
// gaits of horses" (1965). Gallops are transverse, both leading feet on one side: Biancardi, Minetti,
// "Biomechanical determinants of transverse and rotary gallop in cursorial mammals" (2012). The phases of
// canter and gallop are round numbers in the order of these feet: measured ones differ from speed to speed.
// Length of strides: Alexander, "Estimates of speeds of dinosaurs" (1976).
//
// Costs: O(n log n). Allocates the result and some memory for its work. Any number of threads at once.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"

namespace motus::walker {

/// The order of steps of legs in two rows; L1 is the left front leg, R1 the right one:
enum class Gait {
    tripod,    ///< neighbours alternate: L1 R2 L3 | R1 L2 R3
    tetrapod,  ///< neighbours alternate, and all stand for a moment in between: L1 R2 L3 R4 | R1 L2 R3 L4
    ripple,    ///< on each side from the back to the front, the sides about half a cycle apart
    wave,      ///< one after the other: the left ones from the back to the front, then the right ones
    trot,      ///< the front half of a side with the rear half of the other side
    pace,      ///< all left legs, then all right legs
    walk,      ///< on each side from the back to the front, half a cycle apart: hind, fore, other hind, other
               ///< fore
    run,       ///< as in a trot, with all feet in the air in between
    canter,    ///< three beats, the left side leads: a hind leg, a diagonal together, a fore leg
    gallop,    ///< four beats, the left side leads: both hind legs, both fore legs, and all in the air
    hop,       ///< all legs together
};

/// When each leg swings: while the fraction of (cycle + phases[i]) is below 1 - duty.
struct Pattern {
    std::vector<double> phases;  ///< of a cycle, [0, 1)
    double duty = 0.5;           ///< the part of a cycle during which a foot stands
};

inline constexpr std::size_t most_legs = 256;
/// The part of a cycle during which a foot stands: Pattern::duty.
inline constexpr double least_duty = 0.05, most_duty = 0.95;

/// rest: where feet stand when the body rests, in any order, in the space of forward and up. Legs are left or
/// right of the middle of all; those in the middle count to the side that has fewer. Throws
/// std::invalid_argument, naming the argument, if there are no legs or more than most_legs, a number is
/// not finite, or forward and up are parallel or zero.
[[nodiscard]] Pattern pattern_of(Gait gait, std::span<const glm::dvec3> rest, const glm::dvec3& forward,
                                 const glm::dvec3& up);

/// How far a body goes from a touch of a foot to the next touch of the same foot, m, as animals of all sizes
/// have it: 2.3 h F^0.3 with the Froude number F = v^2 / (g h), of at least 0.001, and g = 9.81 m/s^2.
/// speed: v, m/s, and hip_height: h, m, both from 0 to 1e12, else std::invalid_argument.
[[nodiscard]] double natural_stride(double speed, double hip_height);

}  // namespace motus::walker
