// The order in which legs step.
#include <algorithm>

#include "motus/walker/gait.hpp"
#include "web.hpp"

namespace motus::web {

/// gait: a number of Gait. rest: where the feet stand, seen along +Y. out: the phase of each leg, then the
/// duty factor.
MOTUS_WEB(gait_pattern)(const double* rest, std::size_t count, int gait, double* out) {
    const walker::Pattern pattern = walker::pattern_of(
        static_cast<walker::Gait>(gait), points_of(rest, count), {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    *std::ranges::copy(pattern.phases, out).out = pattern.duty;
}

/// out: the way from touch to touch of a foot, m.
MOTUS_WEB(natural_stride)(double speed, double hip_height, double* out) {
    *out = walker::natural_stride(speed, hip_height);
}

}  // namespace motus::web
