#include "motus/core/bounded.hpp"

#include <cmath>

namespace motus {
namespace {

/// Looks at all numbers, without a way out, since a loop that may end early is not vectorized.
template <class Number>
[[nodiscard]] bool are_all_below(std::span<const Number> numbers, Number limit) {
    unsigned reached = 0;
    for (const Number number : numbers) reached |= static_cast<unsigned>(!(std::abs(number) < limit));
    return reached == 0;
}

}  // namespace

bool are_below(std::span<const float> numbers, double limit) {
    return are_all_below(numbers, static_cast<float>(limit));
}

bool are_below(std::span<const double> numbers, double limit) {
    return are_all_below(numbers, limit);
}

}  // namespace motus
