// Snow that lies (accumulation): how deep it is on each vertex of what flakes land on, at any time.
//
// Costs: O(flakes log flakes) to make, 10 us a flake if its landing is not known yet; O(vertices (log
// flakes + rounds)) for the heights, O(flakes + vertices) to and from bytes. All allocate. Immutable: any
// number of threads may share one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motus/core/executor.hpp"
#include "motus/snow/snow.hpp"

namespace motus::snow {

struct Holding;  ///< which vertices snow lies on; private to the library

struct CoverSettings {
    double end = 0.0;            ///< s; flakes that land later are left out
    double flake_volume = 1e-4;  ///< m^3 of lying snow that a flake stands for, > 0
    /// Angle of slopes up to which all flakes lie where they land, [0, pi / 2), rad. The steeper the more of
    /// them slide down, as far as the slope lets them lie, and fall from edges to what is below; all do where
    /// the slope's tangent is 1.5 times as large.
    double repose = 0.9;
    /// Rounds in which neighbouring vertices even out half of what they differ, 0 to most_rounds; not with
    /// those that are too steep, nor from what is under something to what is not.
    int smoothing = 4;

    static constexpr int most_rounds = 1000;
};

/// Tangent of the steepest slope on which any flake lies, for CoverSettings::repose.
[[nodiscard]] double steepest_slope(double repose);

/// Immutable, so that several threads may ask at once. While it is made it takes some 200 bytes a flake that
/// is born until the end, and then 32.
class Cover {
  public:
    /// Throws std::invalid_argument, naming the argument, where the snow has no collider or a setting is
    /// outside its domain; else as Snow::touchdowns().
    Cover(const Snow& snow, const CoverSettings& settings, const Executor& executor = {});

    /// Vertices of the collider.
    [[nodiscard]] std::size_t vertex_count() const noexcept { return areas_.size(); }
    /// m^2: a third of the triangles around each vertex, and less where snow ends within them.
    [[nodiscard]] std::span<const double> areas() const noexcept { return areas_; }

    /// How deep the snow is on each vertex, m, across the surface: the heights times the areas add up to the
    /// volume. Throws std::invalid_argument where the time is not finite, or there is not a height for each
    /// vertex.
    void heights(double time, std::span<float> out, const Executor& executor = {}) const;

    /// Of the flakes that have landed and lie on the collider, m^3: without those that fell from it.
    [[nodiscard]] double volume(double time) const;

    /// All that the cover is, for restored() in another process: for files. A machine of another byte order
    /// does not read it.
    [[nodiscard]] std::vector<std::byte> bytes() const;
    /// The cover that bytes() was asked of. Throws std::invalid_argument, naming data, where these are not
    /// the bytes of a cover: whatever they are, all questions have answers afterwards.
    [[nodiscard]] static Cover restored(std::span<const std::byte> data);

  private:
    Cover() = default;
    /// A flake and what lies on a vertex since.
    struct Event {
        std::uint32_t flake = 0;  ///< of times_
        float height = 0.0F;
    };
    struct Deposit;
    void deposit(std::span<const Deposit> deposits, double volume);
    void link_neighbours(const Collider& collider, const Holding& holding);
    [[nodiscard]] std::size_t lying(double time) const;

    double flake_volume_ = 0.0;
    int rounds_ = 0;
    std::vector<double> times_;  ///< of landing, of flakes that lie
    std::vector<double> areas_;
    std::vector<std::size_t> starts_;  ///< of each vertex's events, and the end of the last's
    std::vector<Event> events_;
    std::vector<std::size_t> link_starts_;
    std::vector<std::uint32_t> links_;  ///< neighbours that each vertex evens out with,
    std::vector<float> shares_;         ///< and by how much of the difference in a round
};

}  // namespace motus::snow
