#include "motus/cache.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <thread>
#include <vector>

#include "curve_checks.hpp"
#include "motus/arc_length.hpp"

using namespace motus;
using namespace motus::checks;

namespace {

/// A hash that tells nothing apart: what is found must be found by content.
struct ConstantHash {
    std::size_t operator()(const std::string&) const { return 1; }
};
using WordCache = Cache<std::string, std::string, ConstantHash>;

/// Counts how often a value is made.
struct Maker {
    int made = 0;
    std::shared_ptr<const std::string> operator()(const std::string& key) {
        ++made;
        return std::make_shared<const std::string>(key + "!");
    }
};

/// Switches the process's cache off for its lifetime.
class CacheOff {
  public:
    CacheOff() : capacity_(arc_length_cache().capacity()) { arc_length_cache().set_capacity(0); }
    ~CacheOff() { arc_length_cache().set_capacity(capacity_); }
    CacheOff(const CacheOff&) = delete;
    CacheOff& operator=(const CacheOff&) = delete;

  private:
    std::size_t capacity_;
};

}  // namespace

TEST_CASE("the cache tells keys apart by content and makes each once", "[cache]") {
    WordCache cache(8);
    Maker maker;
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
    CHECK(*cache.get("b", std::ref(maker)) == "b!");
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
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

TEST_CASE("what was handed out outlives the cache's copy", "[cache]") {
    WordCache cache(1);
    const auto held = cache.get("a", Maker{});
    cache.set_capacity(0);
    CHECK(cache.size() == 0);
    CHECK(*held == "a!");
}

TEST_CASE("a maker that throws leaves nothing behind", "[cache]") {
    WordCache cache(2);
    const auto failing = [](const std::string&) -> std::shared_ptr<const std::string> { throw 1; };
    CHECK_THROWS(cache.get("a", failing));
    CHECK(cache.size() == 0);
    CHECK(*cache.get("a", Maker{}) == "a!");
}

TEST_CASE("arc lengths are the same with the cache and without", "[cache]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const auto cached = shared_arc_length(sample.curve);
        CHECK(shared_arc_length(sample.curve) == cached);
        const CacheOff off;
        const auto built = shared_arc_length(sample.curve);
        CHECK(built != cached);
        CHECK(built->length() == cached->length());
        for (int i = 0; i <= 50; ++i) {
            const double s = built->length() * i / 50.0;
            CHECK(built->t_at_length(s) == cached->t_at_length(s));
        }
    }
}

TEST_CASE("a curve that differs in one bit, in degree or in being cyclic has tables of its own", "[cache]") {
    std::vector<glm::dvec3> points = Random(1).points(12);
    const auto path = shared_arc_length(Curve::chain(3, points, false));
    CHECK(shared_arc_length(Curve::chain(3, points, true)) != path);
    CHECK(shared_arc_length(Curve::chain(2, points, false)) != path);
    points[5].y = std::nextafter(points[5].y, 2.0);
    CHECK(shared_arc_length(Curve::chain(3, points, false)) != path);
}

TEST_CASE("many threads on one cache", "[cache]") {
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
