#include "motus/core/executor.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace motus {
namespace {

/// Threads that are waited for when the group ends. The standard libraries of some compilers have no jthread.
class Threads {
  public:
    explicit Threads(std::size_t most) { threads_.reserve(most); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
    Threads(Threads&&) = delete;
    Threads& operator=(Threads&&) = delete;
    ~Threads() {
        for (std::thread& thread : threads_) thread.join();
    }

    /// Starts a thread that calls `work`; false if the system gives none.
    [[nodiscard]] bool start(const std::function<void()>& work) {
        try {
            threads_.emplace_back(std::ref(work));
            return true;
        } catch (const std::system_error&) {
            return false;
        }
    }

  private:
    std::vector<std::thread> threads_;
};

}  // namespace

std::size_t thread_count() noexcept {
    static const std::size_t count = std::max(1U, std::thread::hardware_concurrency());
    return count;
}

Executor::Executor(std::size_t threads, Run run)
    : threads_(std::max<std::size_t>(threads, 1)), run_(std::move(run)) {
    if (!run_) throw std::invalid_argument("run: must be a function");
}

void Executor::run(std::size_t times, const std::function<void()>& work) const {
    const std::size_t calls = std::min(times, threads_);
    if (calls > 1 && run_) {
        run_(calls, work);
        return;
    }
    Threads helpers(calls > 1 ? calls - 1 : 0);
    for (std::size_t started = 1; started < calls && helpers.start(work);) ++started;
    work();
}

}  // namespace motus
