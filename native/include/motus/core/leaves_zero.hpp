// A number that is 0 after it was moved from, so that a class whose lists are then empty has no count of them
// left, though it is moved member by member.
//
// Costs: O(1). Allocates nothing.
#pragma once
#include <utility>

namespace motus {

/// Moves like a list: what was moved from is 0.
template <class Number>
class LeavesZero {
  public:
    constexpr LeavesZero(Number value = Number{}) noexcept : value_(value) {}
    ~LeavesZero() = default;
    LeavesZero(const LeavesZero&) noexcept = default;
    LeavesZero& operator=(const LeavesZero&) noexcept = default;
    constexpr LeavesZero(LeavesZero&& other) noexcept : value_(std::exchange(other.value_, Number{})) {}
    constexpr LeavesZero& operator=(LeavesZero&& other) noexcept {
        value_ = std::exchange(other.value_, Number{});
        return *this;
    }
    constexpr operator Number() const noexcept { return value_; }

  private:
    Number value_;
};

}  // namespace motus
