#include "ik_world.hpp"

#include <algorithm>
#include <stdexcept>

namespace motus {

IkSettings within_domains(IkSettings settings) {
    settings.position_weight = std::clamp(settings.position_weight, 0.0, 1.0);
    settings.rotation_weight = std::clamp(settings.rotation_weight, 0.0, 1.0);
    settings.softness = std::clamp(settings.softness, 0.0, 1.0);
    settings.stretch = std::clamp(settings.stretch, 0.0, 1.0);
    settings.tolerance = std::clamp(settings.tolerance, 1e-15, 1.0);
    settings.iterations = std::clamp(settings.iterations, 0.0, 1e6);
    return settings;
}

void check_ik_rig(const IkPlan& plan, const RigView& rig) {
    const std::size_t bones = plan.parents().size();
    if (rig.parents.size() != bones || rig.rest.size() != 16 * bones || rig.poses.size() != 16 * bones ||
        rig.basis.size() != 16 * bones || rig.lengths.size() != bones || rig.inheritance.size() != bones)
        throw std::invalid_argument("rig: its arrays must have an entry for each bone of the plan");
}

}  // namespace motus
