// What all flakes of a snow have in common, and the loops over them. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "air.hpp"
#include "emitter.hpp"
#include "kernel.hpp"
#include "motus/core/unfilled.hpp"
#include "motus/snow/births.hpp"
#include "motus/snow/snow.hpp"
#include "steering.hpp"

namespace motus::snow {

inline constexpr double lifetime_range = 1.0;  ///< s, of a random lifetime
inline constexpr std::size_t padding = 16;     ///< loops run over whole vectors

struct FlightModel {
    explicit FlightModel(SnowSettings settings);
    ~FlightModel() = default;
    // `kind` points into its own arrays.
    FlightModel(const FlightModel&) = delete;
    FlightModel& operator=(const FlightModel&) = delete;
    FlightModel(FlightModel&&) = delete;
    FlightModel& operator=(FlightModel&&) = delete;

    [[nodiscard]] double longest() const { return lifetime + (random_lifetime ? lifetime_range : 0.0); }

    double lifetime;
    bool random_lifetime;
    Births births;
    Emitter emitter;
    Air air;
    double step;                          ///< between the nodes of what depends on the age, s
    std::vector<Relaxation> relaxations;  ///< at the first nodes, of which short lives need no others
    double look_step;                     ///< between the times at which a flake's way is looked at, s
    Kind kind;
    std::vector<Facet> facets;
    std::vector<float> places, scales;
    std::vector<std::array<float, 4>> changes;
    std::optional<Steering> steering;
    const Kernel* kernel = &kernels().back();
};

/// The air's and the way's cubics over one interval of ages, kept for the runs that follow in it.
class Interval {
  public:
    explicit Interval(const FlightModel& model) : model_(model), step_(model.step) {}

    /// Sets what the run has of them at this time.
    void set(double time, double index, Run& run);

  private:
    [[nodiscard]] Air::State node(double time, double index) const;

    const FlightModel& model_;
    double step_;
    double time_ = 0.0;
    double index_ = -1.0;
    Air::State start_;  ///< of the air at node `index_`, which is the end of the interval that follows
    std::array<Cubic, 3> drift_{}, velocity_{};
    Cubic way_, way_rate_;
};

/// Fills rows of flakes. For one thread at a time.
class Flight {
  public:
    explicit Flight(const FlightModel& model);

    /// Of flakes of falling ages at a time, with their numbers' lower words, both of which go on to the next
    /// multiple of `padding`, into the rows from `index` on.
    void fill(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
              std::size_t count, const Fields& out, std::size_t index);

    /// Where such flakes were born.
    void fill_births(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
                     std::size_t count, const Fields& out);

  private:
    /// Calls fly() for each run of them, which gives it the air and the steering, and fills it.
    template <class Fly>
    void in_runs(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
                 std::size_t count, const Fields& out, std::size_t index, const Fly& fly);

    const FlightModel& model_;
    Interval interval_;
    Kind standing_;  ///< of flakes that nothing moves
    Run run_;
    Scratch scratch_;
};

}  // namespace motus::snow
