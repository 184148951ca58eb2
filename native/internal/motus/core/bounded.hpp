// Whether numbers stay below a limit, decided in one pass. For the bindings, which are compiled without
// vectorization.
#pragma once
#include <span>

namespace motus {

/// Whether each number is smaller in size than `limit`; NaN is not.
[[nodiscard]] bool are_below(std::span<const float> numbers, double limit);
[[nodiscard]] bool are_below(std::span<const double> numbers, double limit);

}  // namespace motus
