// Tabulated turns of a flake by its age, and their integral. Private to the library.
#pragma once
#include <cstddef>
#include <vector>

#include "kernel.hpp"

namespace motus::snow {

/// Rx(p) Ry(q) with angles p, q of `max_angle` times two noises of age times `frequency`.
class Steering {
  public:
    /// Offsets are whole steps, so that flakes with an offset lie between nodes as the others do.
    static constexpr std::size_t offset_count = 1U << 14U;
    static constexpr std::size_t most_nodes = 1U << 20U;

    /// Nodes for ages up to `longest` s, `step` s apart, and `offsets` more if flakes have some.
    Steering(double max_angle, double frequency, std::uint64_t seed, double longest, double step,
             std::size_t offsets);

    /// Sets where a run reads it whose flakes without offset are at a node.
    void set(std::size_t node, Run& run) const;

  private:
    void make_own(double step);

    std::vector<Node> nodes_;  ///< empty with offsets
    std::vector<OwnNode> own_;
    std::vector<OwnAngles> own_angles_;
    float unit_ = 1.0F;
};

}  // namespace motus::snow
