// Bytes that several caches share.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace motus {

/// A number of bytes that several caches may take together. If they take more, the entries that were used
/// longest ago are dropped, whichever cache they are in. Its members, the caches, are to end before it.
class CacheBudget {
  public:
    /// A cache that takes part. What a member calls here takes no lock of the budget's but in join() and
    /// leave(), so that a member may have locked itself.
    class Member {
      public:
        explicit Member(CacheBudget& budget) noexcept : budget_(budget) {}
        Member(const Member&) = delete;
        Member& operator=(const Member&) = delete;
        Member(Member&&) = delete;
        Member& operator=(Member&&) = delete;

        /// When the entry that was used longest ago was used, as now() told then; `never` without entries.
        [[nodiscard]] virtual std::uint64_t oldest() = 0;
        /// Drops that entry and returns its value, which the caller frees; null without entries.
        [[nodiscard]] virtual std::shared_ptr<const void> drop_oldest() noexcept = 0;

      protected:
        ~Member() = default;

        void join() { budget_.join(*this); }
        void leave() noexcept {
            take(0);
            budget_.leave(*this);
        }
        /// Notes how many bytes the member takes from now on.
        void take(std::size_t bytes) noexcept { budget_.bytes_ += bytes - taken_.exchange(bytes); }
        [[nodiscard]] std::size_t taken() const noexcept { return taken_; }
        [[nodiscard]] std::uint64_t now() noexcept { return ++budget_.clock_; }
        [[nodiscard]] CacheBudget& budget() const noexcept { return budget_; }

      private:
        CacheBudget& budget_;
        std::atomic<std::size_t> taken_{0};
    };

    static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

    explicit CacheBudget(std::size_t limit) noexcept : limit_(limit) {}

    [[nodiscard]] std::size_t limit() const noexcept { return limit_; }
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
    void set_limit(std::size_t limit) noexcept {
        limit_ = limit;
        enforce();
    }
    /// Drops entries until the others fit. No member may be locked by the caller.
    void enforce() noexcept {
        if (bytes_ > limit_) drop_down_to(limit_);
    }
    void clear() noexcept { drop_down_to(0); }

  private:
    void join(Member& member);
    void leave(Member& member) noexcept;
    void drop_down_to(std::size_t bytes) noexcept;
    [[nodiscard]] std::shared_ptr<const void> drop_oldest() noexcept;

    std::atomic<std::size_t> limit_, bytes_{0};
    std::atomic<std::uint64_t> clock_{0};
    std::mutex mutex_;
    std::vector<Member*> members_;
};

/// The budget of the library's own caches, which motus/core/memory.hpp reads and sets. It never ends.
[[nodiscard]] CacheBudget& process_budget();

}  // namespace motus
