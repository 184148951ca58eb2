// Who shares out the work that functions of the library do in parallel: a thread pool, or a job system.
//
// Costs: some 20 us for each thread that is started. Several threads may use one at once.
#pragma once
#include <cstddef>
#include <functional>

#include "motus/core/executor.hpp"

namespace motus {

/// Number of threads that the machine runs at once, at least 1.
[[nodiscard]] std::size_t thread_count() noexcept;

/// Calls a piece of work on several threads at once: threads of its own, or those of a host. A value; copies
/// share the host's function. Several threads may use one at once.
class Executor {
  public:
    /// The function of a host, such as a program with a pool of threads. It calls `work` at least once and at
    /// most `times` times, at the same time as far as it can, and returns when all calls have returned.
    /// `work` throws nothing.
    using Run = std::function<void(std::size_t times, const std::function<void()>& work)>;

    /// At most `threads` threads, of which the caller's is one; 0 is 1. The others start when there is work
    /// and end with it, which takes about 20 us a thread. Where the system gives no more threads, fewer work.
    Executor(std::size_t threads = thread_count()) noexcept : threads_(threads == 0 ? 1 : threads) {}

    /// The host's threads, at most `threads` of them at once. Throws std::invalid_argument if `run` is empty.
    Executor(std::size_t threads, Run run);

    /// Most threads that work at once, at least 1.
    [[nodiscard]] std::size_t threads() const noexcept { return threads_; }

    /// Calls `work`, which throws nothing, at least once and at most min(times, threads()) times, and returns
    /// when all calls have returned. If that is one call, the caller's thread makes it.
    void run(std::size_t times, const std::function<void()>& work) const;

  private:
    std::size_t threads_;
    Run run_;  ///< empty for threads of the library's own
};

}  // namespace motus
