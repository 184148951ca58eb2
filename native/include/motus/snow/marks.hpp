// Marks in lying snow (displacement by rigid bodies): how much of it bodies that move have pressed down or
// swept away, at any time.
//
// With the height H(t) of the snow that has fallen on a vertex, and the clearance c(s) under what is above it
// at a time s, the depth is H(t) - max(0, max over s <= t of H(s) - c(s)): Skorokhod, "Stochastic equations
// for diffusion processes in a bounded region" (1961). So what falls later fills the marks.
//
// Costs: O(steps of the movers * vertices beneath them * log triangles) to make, O(marked vertices) to ask.
// Both allocate. Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motus/core/executor.hpp"
#include "motus/core/leaves_zero.hpp"
#include "motus/snow/layer.hpp"
#include "motus/snow/snow.hpp"

namespace motus::snow {

struct MarksSettings {
    double packed = 0.0;  ///< m, >= 0: snow that stays, packed, under what presses
    /// m, > 0: no point of a mover goes farther between two looks, unless it goes 64 times as far from one of
    /// its samples to the next.
    double step = 0.05;
};

/// Of a stretch of time: marks of stretches that follow each other add up, each raising what the others have
/// pressed. Immutable, so that several threads may ask at once. What is moved from has no vertices.
class Marks {
  public:
    /// `times`, rising: the stretch is from the first to the last. `heights`, m, >= 0: at each time how deep
    /// snow would lie on each vertex without movers; between times they go evenly. Movers are held before
    /// their first time and after their last. What is inside a mover has a clearance of 0, for which its
    /// triangles' normals have to point outwards. Throws std::invalid_argument, naming movers, times,
    /// heights, packed or step, where they are none of that, and movers where they would be looked at more
    /// than 10,000,000 times.
    Marks(const SnowLayer& layer, const std::vector<Mover>& movers, std::span<const double> times,
          std::span<const float> heights, const MarksSettings& settings, const Executor& executor = {});

    /// Vertices of the layer.
    [[nodiscard]] std::size_t vertex_count() const noexcept { return vertex_count_; }
    /// How many vertices something has pressed on.
    [[nodiscard]] std::size_t marked_count() const noexcept { return vertices_.size(); }

    /// Raises `pressed`, m, one for each vertex, to what movers have pressed away until `time`. `depths`: the
    /// heights at that time. `shares`: of the heights that lie there, [0, 1], for all times; empty where that
    /// is all: what is pressed away is as much of the whole height. Throws std::invalid_argument where the
    /// time or a depth is not finite, a share is not from 0 to 1, or there is not one for each vertex.
    void press(double time, std::span<const float> depths, std::span<const float> shares,
               std::span<float> pressed) const;

  private:
    /// From `start` to `end` the snow on a vertex was as deep as the clearance.
    struct Event {
        double start = 0.0;
        double end = 0.0;
        float height = 0.0F;  ///< that had fallen until the end
        float clearance = 0.0F;
    };
    class Maker;

    LeavesZero<std::size_t> vertex_count_;
    std::vector<std::uint32_t> vertices_;  ///< that are marked, rising
    std::vector<std::size_t> starts_;      ///< of their events, and the end of the last's
    std::vector<Event> events_;            ///< by their starts
};

}  // namespace motus::snow
