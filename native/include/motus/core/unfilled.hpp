// Arrays of a fixed size, of which a short content fills only the beginning.
#pragma once
#include <array>
#include <cstddef>

namespace motus {

/// An array whose elements are not set to anything before they are written: for a short content that would
/// take longer than all the work on it.
template <class T, std::size_t size>
struct Unfilled : std::array<T, size> {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
    Unfilled() {}
};

}  // namespace motus
