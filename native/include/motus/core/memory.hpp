// How much memory the caches of the process may take; least recently used tables go first.
//
// Costs: O(kept tables). Several threads may call these functions at once.
#pragma once
#include <cstddef>

namespace motus {

/// Bytes that the tables which the library keeps for later questions may take together: arc length tables,
/// frames along curves, motions of pendulums and landings of flakes. 1 GiB at first. Several threads may call
/// this and the functions below at once. Results do not depend on what is kept, only the time they take.
[[nodiscard]] std::size_t cache_budget() noexcept;

/// Changes the budget. Tables that no longer have room are let go, those first that were used longest ago.
/// Who still uses one keeps it as long. A budget of 0 keeps nothing.
void set_cache_budget(std::size_t bytes) noexcept;

/// Bytes that all kept tables take now, at most cache_budget() but for tables that have grown since they were
/// last weighed, which happens when others are added.
[[nodiscard]] std::size_t cached_bytes() noexcept;

/// Lets all kept tables go.
void clear_caches() noexcept;

}  // namespace motus
