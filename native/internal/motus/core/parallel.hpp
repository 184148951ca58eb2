// Work on the elements of an array, shared among the processor's threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

#include "motus/core/executor.hpp"
#include "motus/core/ieee_floats.hpp"

namespace motus {

/// Calls work(first, last) for parts that together are [0, count), each once, on the threads of `executor`.
/// Parts have at least `grain` elements (all of them, if there are fewer); long ones begin at multiples of
/// 64. Which thread takes which part, and how many there are, is not determined: the result must not depend
/// on it. The floating-point mode is the standard one in all parts, whatever the threads of a host have.
/// Returns when all is done. An exception of `work` passes to the caller (one of them, if several threads
/// throw), and parts not yet begun are left out. A thread takes about 20 us to start: below some 50 us of
/// work, let the grain leave it to the caller's thread.
template <class Work>
void in_parts(std::size_t count, std::size_t grain, const Work& work, const Executor& executor = {}) {
    if (count == 0) return;
    // More parts than threads, so that a thread which the system delays does not delay the others.
    constexpr std::size_t parts_a_thread = 16, step = 64;
    const std::size_t most = std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain));
    const std::size_t threads = executor.threads();
    const std::size_t wanted = threads > 1 ? std::min(most, parts_a_thread * threads) : 1;
    std::size_t length = (count + wanted - 1) / wanted;
    if (length > step) length = (length + step - 1) / step * step;
    const std::size_t parts = (count + length - 1) / length;
    if (parts == 1) {
        in_ieee_floats([&] { work(std::size_t{0}, count); });
        return;
    }

    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto take_parts = [&] {
        try {
            in_ieee_floats([&] {
                for (std::size_t part = next++; part < parts; part = next++)
                    work(part * length, std::min(count, (part + 1) * length));
            });
        } catch (...) {
            next = parts;
            const std::lock_guard lock(failing);
            if (!failure) failure = std::current_exception();
        }
    };
    executor.run(parts, std::ref(take_parts));
    take_parts();  // does what a host has left undone
    if (failure) std::rethrow_exception(failure);
}

}  // namespace motus
