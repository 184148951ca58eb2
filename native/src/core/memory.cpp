#include "motus/core/memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include "motus/core/cache_budget.hpp"

namespace motus {

void CacheBudget::join(Member& member) {
    const std::lock_guard lock(mutex_);
    members_.push_back(&member);
}

void CacheBudget::leave(Member& member) noexcept {
    const std::lock_guard lock(mutex_);
    std::erase(members_, &member);
}

void CacheBudget::drop_down_to(std::size_t bytes) noexcept {
    // The values are freed without a lock, as they may be large, and hold caches of their own.
    while (bytes_ > bytes && drop_oldest()) {
    }
}

std::shared_ptr<const void> CacheBudget::drop_oldest() noexcept {
    const std::lock_guard lock(mutex_);
    Member* chosen = nullptr;
    std::uint64_t first = never;
    for (Member* member : members_) {
        const std::uint64_t used = member->oldest();
        if (used >= first) continue;
        first = used;
        chosen = member;
    }
    return chosen == nullptr ? nullptr : chosen->drop_oldest();
}

CacheBudget& process_budget() {
    // Never destroyed: threads may still look up tables while the program exits.
    static auto& budget = *new CacheBudget(std::size_t{1} << 30U);
    return budget;
}

std::size_t cache_budget() noexcept {
    return process_budget().limit();
}

void set_cache_budget(std::size_t bytes) noexcept {
    process_budget().set_limit(bytes);
}

std::size_t cached_bytes() noexcept {
    return process_budget().bytes();
}

void clear_caches() noexcept {
    process_budget().clear();
}

}  // namespace motus
