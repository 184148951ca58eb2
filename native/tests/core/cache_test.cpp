#include "motus/core/cache.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "allocations.hpp"
#include "motus/core/memory.hpp"
#include "motus/core/parallel.hpp"

using namespace motus;
using namespace motus::test;

namespace {

/// A hash that tells nothing apart: what is found must be found by content.
struct ConstantHash {
    std::size_t operator()(const std::string&) const { return 1; }
};
struct WordBytes {
    std::size_t operator()(const std::string& key, const std::string& value) const {
        return key.size() + value.size();
    }
};
using WordCache = Cache<std::string, std::string, ConstantHash, WordBytes>;

/// Counts how often a value is made.
struct Maker {
    int made = 0;
    std::shared_ptr<const std::string> operator()(const std::string& key) {
        ++made;
        return std::make_shared<const std::string>(key + "!");
    }
};

}  // namespace

TEST_CASE("the cache tells keys apart by content and makes each once", "[cache]") {
    WordCache cache(8);
    Maker maker;
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
    CHECK(*cache.get("b", std::ref(maker)) == "b!");
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
    CHECK(*cache.held("b") == "b!");
    CHECK(cache.held("c") == nullptr);
    CHECK(maker.made == 2);
    CHECK(cache.size() == 2);
}

TEST_CASE("a full cache drops what was used longest ago", "[cache]") {
    WordCache cache(2);
    Maker maker;
    (void)cache.get("a", std::ref(maker));
    (void)cache.get("b", std::ref(maker));
    (void)cache.get("a", std::ref(maker));
    (void)cache.get("c", std::ref(maker));
    CHECK(maker.made == 3);
    CHECK(cache.size() == 2);
    (void)cache.get("a", std::ref(maker));
    CHECK(maker.made == 3);
    (void)cache.get("b", std::ref(maker));
    CHECK(maker.made == 4);
}

TEST_CASE("the cache drops the entries that it is told to drop, with their bytes, and no others", "[cache]") {
    WordCache cache(8);
    Maker maker;
    for (const char* key : {"a1", "b1", "a2", "b2", "a3"}) (void)cache.get(key, std::ref(maker));
    const std::size_t before = cache.bytes();
    const auto handed_out = cache.held("a1");
    cache.erase_if([](const std::string& key) { return key.front() == 'a'; });
    CHECK(cache.size() == 2);
    CHECK(cache.bytes() == before - 3 * (2 + 3));
    CHECK(*handed_out == "a1!");
    for (const char* gone : {"a1", "a2", "a3"}) CHECK(cache.held(gone) == nullptr);
    for (const char* kept : {"b1", "b2"}) CHECK(cache.held(kept) != nullptr);
    CHECK(*cache.get("a2", std::ref(maker)) == "a2!");
    CHECK(maker.made == 6);
}

TEST_CASE("a value from the cache stays valid after the cache has dropped it", "[cache]") {
    WordCache cache(1);
    const auto held = cache.get("a", Maker{});
    cache.set_capacity(0);
    CHECK(cache.size() == 0);
    CHECK(*held == "a!");
}

TEST_CASE("a function that throws while it makes an entry leaves no entry behind", "[cache]") {
    WordCache cache(2);
    const auto failing = [](const std::string&) -> std::shared_ptr<const std::string> { throw 1; };
    CHECK_THROWS(cache.get("a", failing));
    CHECK(cache.size() == 0);
    CHECK(*cache.get("a", Maker{}) == "a!");
}

TEST_CASE("a cache whose entries weigh too much drops what was used longest ago", "[cache]") {
    CacheBudget budget(12);
    WordCache cache(100, budget);
    Maker maker;
    for (const char* key : {"a", "b", "c", "d"}) (void)cache.get(key, std::ref(maker));
    CHECK(cache.bytes() == 12);
    (void)cache.get("a", std::ref(maker));
    (void)cache.get("long", std::ref(maker));
    CHECK(maker.made == 5);
    CHECK(cache.size() == 2);
    CHECK(cache.bytes() == 12);
    (void)cache.get("a", std::ref(maker));
    CHECK(maker.made == 5);
    CHECK(*cache.get("longer than the cache", std::ref(maker)) == "longer than the cache!");
    CHECK(cache.size() == 0);
}

TEST_CASE("caches with one budget drop what was used longest ago in any of them", "[cache]") {
    CacheBudget budget(9);  // three words of a letter, each with its key
    WordCache first(100, budget);
    Maker maker;
    for (const char* key : {"a", "b"}) (void)first.get(key, std::ref(maker));
    {
        WordCache second(100, budget);
        (void)second.get("c", std::ref(maker));
        CHECK(budget.bytes() == 9);
        (void)first.get("a", std::ref(maker));
        (void)second.get("d", std::ref(maker));
        CHECK(first.held("b") == nullptr);
        CHECK(first.held("a") != nullptr);
        CHECK(second.size() == 2);
        CHECK(budget.bytes() == 9);
    }
    CHECK(budget.bytes() == 3);
}

TEST_CASE("a budget that is lowered drops entries at once, and one that is cleared drops all", "[cache]") {
    CacheBudget budget(100);
    WordCache first(100, budget), second(100, budget);
    Maker maker;
    for (const char* key : {"a", "b"}) (void)first.get(key, std::ref(maker));
    (void)second.get("c", std::ref(maker));
    (void)first.get("a", std::ref(maker));
    const std::size_t each = budget.bytes() / 3;
    budget.set_limit(3 * each - 1);
    CHECK(budget.bytes() == 2 * each);
    CHECK(first.held("b") == nullptr);
    CHECK(second.held("c") != nullptr);
    budget.clear();
    CHECK(budget.bytes() == 0);
    CHECK(first.size() + second.size() == 0);
    CHECK(budget.limit() == 3 * each - 1);
    (void)second.get("d", std::ref(maker));
    CHECK(second.size() == 1);
}

TEST_CASE("threads that fill caches of one budget leave no more than the budget", "[cache]") {
    CacheBudget budget(300);
    WordCache first(100'000, budget), second(100'000, budget);
    std::atomic<int> right{0};
    in_parts(
        20'000, 1,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::string key = std::to_string(i % 500);
                if (*(i % 2 == 0 ? first : second).get(key, Maker{}) == key + "!") ++right;
            }
        },
        4);
    CHECK(right == 20'000);
    CHECK(budget.bytes() <= 300);
    CHECK(budget.bytes() == first.bytes() + second.bytes());
}

TEST_CASE("many entries are not all weighed for each that is added", "[cache]") {
    static std::size_t asked = 0;
    struct CountedBytes {
        std::size_t operator()(std::size_t /*key*/, std::size_t /*value*/) const {
            ++asked;
            return 8;
        }
    };
    constexpr std::size_t count = 4000, held = 2000;
    CacheBudget budget(8 * held);
    Cache<std::size_t, std::size_t, std::hash<std::size_t>, CountedBytes> cache(2 * count, budget);
    for (std::size_t i = 0; i < count; ++i)
        CHECK(*cache.get(i, [](std::size_t key) { return std::make_shared<const std::size_t>(key); }) == i);
    CHECK(asked < 200 * count);
    CHECK(cache.size() == held);
    CHECK(cache.bytes() == 8 * held);
}

TEST_CASE("a cache that cannot allocate stays unchanged", "[cache]") {
    for (int allocations = 0;; ++allocations) {
        WordCache cache(1);
        (void)cache.get("a", Maker{});
        const auto made = std::make_shared<const std::string>("b!");
        const std::string key(100, 'b');  // too long to be kept without an allocation
        const auto make = [&made](const std::string&) { return made; };
        const bool succeeded = with_allocations(allocations, [&] { (void)cache.get(key, make); });
        CAPTURE(allocations);
        CHECK(cache.size() == 1);
        Maker maker;
        CHECK(*cache.get("a", std::ref(maker)) == "a!");
        CHECK(maker.made == (succeeded ? 1 : 0));
        CHECK(cache.get(key, make) == made);
        CHECK(cache.size() == 1);
        if (!succeeded) continue;
        CHECK(allocations >= 3);  // the entry, its key and the index
        break;
    }
}

TEST_CASE("many threads may use one cache", "[cache]") {
    WordCache cache(3);
    std::vector<std::thread> threads;
    std::vector<int> wrong(4, 0);
    for (int& count : wrong) {
        threads.emplace_back([&cache, &count] {
            for (int i = 0; i < 2000; ++i) {
                const std::string key = std::to_string(i * 7 % 5);
                if (*cache.get(key, Maker{}) != key + "!") ++count;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == std::vector<int>(4, 0));
    CHECK(cache.size() <= 3);
}

TEST_CASE("the process's caches have one budget, which can be read, set and cleared", "[cache]") {
    const std::size_t usual = cache_budget();
    CHECK(usual == std::size_t{1} << 30);
    clear_caches();
    CHECK(cached_bytes() == 0);
    {
        WordCache cache(8);
        (void)cache.get("a", Maker{});
        CHECK(cached_bytes() == 3);
        set_cache_budget(2);
        CHECK(cached_bytes() == 0);
        CHECK(cache_budget() == 2);
        set_cache_budget(usual);
        (void)cache.get("a", Maker{});
        CHECK(cached_bytes() == 3);
    }
    CHECK(cached_bytes() == 0);
}
