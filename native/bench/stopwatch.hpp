// Timing for the benchmarks: processor time of the calling thread, which other load on the machine stretches
// least, and the best of several runs.
#pragma once
#include <algorithm>
#include <ctime>
#include <limits>

namespace motus::bench {

/// Processor time of this thread, ns.
[[nodiscard]] inline double thread_time() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Nanoseconds of one call of `work`, the fastest of `runs`. Single-threaded work only.
template <class Work>
[[nodiscard]] double nanoseconds(Work&& work, int runs = 7) {
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < runs; ++run) {
        const double start = thread_time();
        work();
        best = std::min(best, thread_time() - start);
    }
    return best;
}

/// Makes the compiler believe that `value` is read.
template <class T>
inline void keep(const T& value) {
    asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace motus::bench
