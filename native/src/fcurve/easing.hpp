// What lies between two keys whose interpolation goes by a name: Penner, "Programming Macromedia Flash MX"
// (2002), ch. 7, in Blender's order of operations.
#pragma once
#include "motus/fcurve/fcurve.hpp"

namespace motus::fcurve {

/// From one key to the next.
struct Way {
    float time;      ///< frames since the first key
    float begin;     ///< its value
    float change;    ///< to the value of the second key
    float duration;  ///< frames between the two
};

/// Value of a way after a key that is eased: its interpolation is none of constant, linear and bezier.
[[nodiscard]] float eased(const Key& key, const Way& way);

}  // namespace motus::fcurve
