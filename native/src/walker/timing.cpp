#include "timing.hpp"

#include <algorithm>
#include <cmath>

namespace motus::walker {
namespace {

/// How much less a moment is moved for each cycle that it is away from a set one.
constexpr double fading = 0.5;
/// Least share of what is planned for the time between two set moments.
constexpr double least_share = 0.25;

}  // namespace

bool Timing::set(double planned, double wanted) {
    const double shift = wanted - planned;
    if (set_.empty() && planned > 0.0) set_.push_back({0.0, 0.0});
    if (!set_.empty()) {
        const double between = planned - set_.back().planned;
        if (!(between > 0.0) || between + shift - set_.back().shift < least_share * between) return false;
    }
    set_.push_back({planned, shift});
    return true;
}

double Timing::shift(double planned) const {
    const auto after = std::ranges::lower_bound(set_, planned, {}, &Moment::planned);
    if (after != set_.end() && after->planned == planned) return after->shift;
    const bool has_before = after != set_.begin(), has_after = after != set_.end();
    double rate = fading;
    if (has_before && has_after) {
        const Moment& before = *(after - 1);
        rate = std::max(rate, std::abs(after->shift - before.shift) / (after->planned - before.planned));
    }
    // Between the bounds of both, as near to 0 as may be.
    double least = 0.0, most = 0.0;
    const auto narrow = [&](const Moment& moment, bool is_first) {
        const double room = rate * std::abs(planned - moment.planned);
        const double low = moment.shift - room, high = moment.shift + room;
        least = is_first ? low : std::max(least, low);
        most = is_first ? high : std::min(most, high);
    };
    if (has_before) narrow(*(after - 1), true);
    if (has_after) narrow(*after, !has_before);
    return std::max(least, std::min(0.0, most));
}

}  // namespace motus::walker
