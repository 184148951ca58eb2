#include "world.hpp"

#include <algorithm>
#include <stdexcept>

#include "bones.hpp"

namespace motus::bones::ik {

bool has_finite_numbers(const ChainSettings& s) {
    return are_finite(s.position_weight, s.rotation_weight, s.softness, s.stretch, s.volume, s.pole_angle,
                      s.hinge_angle, s.tolerance);
}

bool has_finite_numbers(const ChainDiagnostics& r) {
    return are_finite(r.residual, r.angle, r.distance, r.reach) && is_finite(r.tip);
}

ChainSettings within_domains(ChainSettings settings) {
    settings.position_weight = std::clamp(settings.position_weight, 0.0, 1.0);
    settings.rotation_weight = std::clamp(settings.rotation_weight, 0.0, 1.0);
    settings.softness = std::clamp(settings.softness, 0.0, 1.0);
    settings.stretch = std::clamp(settings.stretch, 0.0, 1.0);
    settings.volume = std::clamp(settings.volume, 0.0, 1.0);
    settings.tolerance = std::clamp(settings.tolerance, 1e-15, 1.0);
    settings.max_iterations = std::clamp(settings.max_iterations, 0, 1'000'000);
    return settings;
}

void check_rig(const ChainPlan& plan, const ChainInput& input) {
    if (!input.bones.is_of(plan)) throw std::invalid_argument("bones: must be of the same plan");
    if (input.poses.size() != 16 * plan.parents().size())
        throw std::invalid_argument("poses: there must be one for each bone of the plan");
}

}  // namespace motus::bones::ik
