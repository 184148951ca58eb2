#include "ik_world.hpp"

#include <algorithm>
#include <stdexcept>

#include "ik_bones.hpp"

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

void check_ik_rig(const IkPlan& plan, const IkInput& input) {
    if (input.bones.rows().size() != plan.rows().size())
        throw std::invalid_argument("bones: they must be the plan's");
    if (input.poses.size() != 16 * plan.parents().size())
        throw std::invalid_argument("poses: there must be one for each bone of the plan");
}

}  // namespace motus
