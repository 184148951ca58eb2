// How strongly a pull acts at a distance.
#include <algorithm>
#include <vector>

#include "motus/sculpt/falloff.hpp"
#include "web.hpp"

namespace motus::web {

/// falloff: a number of Falloff, not that of `curve`. out: the force at each distance.
MOTUS_WEB(pull_forces)
(const double* distances, std::size_t count, double radius, int falloff, double scale_factor, double* out) {
    std::vector<float> forces(count);
    std::ranges::transform(std::span(distances, count), forces.begin(),
                           [](double distance) { return static_cast<float>(distance); });
    sculpt::Profile profile;
    profile.falloff = static_cast<sculpt::Falloff>(falloff);
    profile.scale_factor = static_cast<float>(scale_factor);
    sculpt::forces(profile, static_cast<float>(radius), forces, forces);
    std::ranges::copy(forces, out);
}

}  // namespace motus::web
