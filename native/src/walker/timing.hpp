// How moments of a leg's steps that are set by hand move the moments around them. Private to the library.
#pragma once
#include <vector>

namespace motus::walker {

/// The moments at which a leg lifts and touches down, in cycles, some of which are set to different ones.
/// Moments before and after a set one are moved as little as may be: by half a cycle less for each cycle that
/// they are away from it. What is not between two set moments takes half as long as planned at least, so that
/// all stay in their order. The beginning, 0 cycles, stays.
class Timing {
  public:
    /// Sets a moment that is planned later than those set before. Returns whether that is possible: the time
    /// since the moment set before has to be a quarter of what is planned at least.
    [[nodiscard]] bool set(double planned, double wanted);
    /// By how much a moment is moved. O(log n) for n moments that are set.
    [[nodiscard]] double shift(double planned) const;
    [[nodiscard]] double moved(double planned) const { return planned + shift(planned); }

  private:
    struct Moment {
        double planned = 0.0;
        double shift = 0.0;
    };
    std::vector<Moment> set_;
};

}  // namespace motus::walker
