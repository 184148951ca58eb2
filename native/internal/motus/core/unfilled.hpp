// Arrays of a fixed size of which only the beginning may be in use.
#pragma once
#include <array>
#include <cstddef>

namespace motus {

/// An array whose elements are not initialised: if few of them are used, setting all would take longer than
/// the work on these few.
template <class T, std::size_t size>
struct Unfilled : std::array<T, size> {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
    Unfilled() {}
};

}  // namespace motus
