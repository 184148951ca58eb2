#include "motus/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

using namespace motus;

TEST_CASE("parts cover every element once", "[parallel]") {
    for (const std::size_t count : {0, 1, 2, 63, 64, 65, 1000, 4096, 100003}) {
        for (const std::size_t grain : {0, 1, 7, 64, 5000}) {
            for (const std::size_t threads : {0, 1, 2, 3, 16}) {
                std::vector<std::atomic<int>> calls(count);
                in_parts(
                    count, grain,
                    [&](std::size_t first, std::size_t last) {
                        for (std::size_t i = first; i < last; ++i) ++calls[i];
                    },
                    threads);
                const bool once =
                    std::all_of(calls.begin(), calls.end(), [](const auto& times) { return times == 1; });
                CAPTURE(count, grain, threads);
                CHECK(once);
            }
        }
    }
}

TEST_CASE("parts have the standard float mode on threads of a host that takes small numbers for 0",
          "[parallel]") {
    if (FloatMode::flushing == 0) return;  // the library does not know this processor's mode
    const auto flushed = [](const std::function<void()>& work) {
        const FloatMode::Bits was = FloatMode::read();
        FloatMode::write(was | FloatMode::flushing);
        work();
        const bool is_kept = (FloatMode::read() & FloatMode::flushing) == FloatMode::flushing;
        FloatMode::write(was);
        return is_kept;
    };
    std::atomic<bool> is_kept = true;
    const Executor pool(3, [&](std::size_t times, const std::function<void()>& work) {
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < times; ++i)
            threads.emplace_back([&] {
                if (!flushed(work)) is_kept = false;
            });
        for (std::thread& thread : threads) thread.join();
    });
    for (const std::size_t count : {std::size_t{1}, std::size_t{100}, std::size_t{100000}}) {
        std::vector<float> halves(count, std::numeric_limits<float>::min());
        const auto halve = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) halves[i] *= 0.5F;
        };
        const bool all_kept = flushed([&] { in_parts(count, 1, halve, pool); });
        CHECK(all_kept);
        CHECK(is_kept);
        CHECK(std::ranges::all_of(
            halves, [](float half) { return half == 0.5F * std::numeric_limits<float>::min(); }));
        CHECK_THROWS_AS(in_parts(
                            count, 1, [](std::size_t, std::size_t) { throw std::runtime_error("no"); }, pool),
                        std::runtime_error);
    }
}

TEST_CASE("parts are not smaller than the grain, but for the last, and none is empty", "[parallel]") {
    for (const std::size_t count : {1, 99, 100, 101, 1000, 65536}) {
        std::mutex adding;
        std::vector<std::pair<std::size_t, std::size_t>> parts;
        in_parts(
            count, 100,
            [&](std::size_t first, std::size_t last) {
                const std::lock_guard lock(adding);
                parts.emplace_back(first, last);
            },
            8);
        for (const auto& [first, last] : parts) {
            CAPTURE(count, first, last);
            CHECK(first < last);
            CHECK((last - first >= 100 || last == count));
        }
        if (count < 200) CHECK(parts.size() == 1);
        if (count == 65536) CHECK(parts.size() > 8);
    }
}

TEST_CASE("work of one part runs in the calling thread, and no more threads work than requested",
          "[parallel]") {
    std::mutex adding;
    std::set<std::thread::id> workers;
    const auto work = [&](std::size_t /*first*/, std::size_t /*last*/) {
        const std::lock_guard lock(adding);
        workers.insert(std::this_thread::get_id());
    };
    in_parts(1000, 1000, work, 8);
    CHECK(workers == std::set{std::this_thread::get_id()});
    in_parts(100000, 1, work, 1);
    CHECK(workers.size() == 1);
    for (int run = 0; run < 50; ++run) {
        workers.clear();
        in_parts(100000, 1, work, 3);
        CHECK(workers.size() <= 3);
    }
}

TEST_CASE("an exception of the work passes to the caller, after all threads have ended", "[parallel]") {
    std::atomic<int> inside{0};
    const auto work = [&](std::size_t first, std::size_t /*last*/) {
        ++inside;
        std::this_thread::yield();
        --inside;
        if (first > 0) throw std::runtime_error("no");
    };
    for (int run = 0; run < 50; ++run) {
        CHECK_THROWS_AS(in_parts(10000, 1, work, 4), std::runtime_error);
        CHECK(inside == 0);
    }
    CHECK_THROWS_AS(in_parts(1, 1, [](std::size_t, std::size_t) { throw std::logic_error("no"); }),
                    std::logic_error);
}

TEST_CASE("work may be shared out again inside a part", "[parallel]") {
    std::atomic<std::size_t> sum{0};
    in_parts(
        10, 1,
        [&](std::size_t first, std::size_t last) {
            in_parts(
                100, 10, [&](std::size_t from, std::size_t to) { sum += (last - first) * (to - from); }, 2);
        },
        3);
    CHECK(sum == 1000);
}

TEST_CASE("a host's function runs the work, and no more of it at once than it was given", "[parallel]") {
    std::vector<std::size_t> asked;
    const Executor::Run run = [&](std::size_t times, const std::function<void()>& work) {
        asked.push_back(times);
        for (std::size_t i = 0; i < times; ++i) work();
    };
    const Executor executor(3, run);
    CHECK(executor.threads() == 3);
    std::vector<int> calls(100'000);
    const auto work = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++calls[i];
    };
    in_parts(calls.size(), 1, work, executor);
    CHECK(asked == std::vector<std::size_t>{3});
    in_parts(calls.size(), calls.size(), work, executor);
    CHECK(asked.size() == 1);
    CHECK(calls == std::vector<int>(calls.size(), 2));
}

TEST_CASE("what a host's function leaves undone is done by the caller's thread", "[parallel]") {
    const Executor idle(8, [](std::size_t /*times*/, const std::function<void()>& /*work*/) {});
    std::vector<int> calls(100'000);
    in_parts(
        calls.size(), 1,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) ++calls[i];
        },
        idle);
    CHECK(calls == std::vector<int>(calls.size(), 1));
}

TEST_CASE("an executor has at least one thread, and its host's function is there", "[parallel]") {
    CHECK(Executor(0).threads() == 1);
    CHECK(Executor().threads() == thread_count());
    CHECK_THROWS_WITH(Executor(2, {}), "run: must be a function");
}
