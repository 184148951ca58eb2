// Waves that make up turbulent air. Private to the library.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "kernel.hpp"

namespace motus::snow {

/// Waves of air that moves at `speed` m/s, root mean square, in eddies of about `size` m, each of which lasts
/// about as long as the air takes to go through it. The air moves across each wave, so that none gathers
/// anywhere. drift: velocity, m/s, that all flakes have. period: time after which all waves are where they
/// were, s, for which their frequencies are changed a little; 0 for none.
[[nodiscard]] std::array<Wave, wave_count> waves_of(double speed, double size, const glm::dvec3& drift,
                                                    std::uint64_t seed, double period = 0.0);

/// Where the wave is when a flake is born, in whole turns less the completed ones.
[[nodiscard]] float phase_at(const Wave& wave, double birth);

}  // namespace motus::snow
