#include "motus/cache.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "allocations.hpp"
#include "curve_checks.hpp"
#include "frame_tables.hpp"
#include "motus/arc_length.hpp"
#include "motus/frames.hpp"

using namespace motus;
using namespace motus::checks;

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
constexpr std::size_t roomy = 1000;

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
    WordCache cache(8, roomy);
    Maker maker;
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
    CHECK(*cache.get("b", std::ref(maker)) == "b!");
    CHECK(*cache.get("a", std::ref(maker)) == "a!");
    CHECK(maker.made == 2);
    CHECK(cache.size() == 2);
}

TEST_CASE("a full cache drops what was used longest ago", "[cache]") {
    WordCache cache(2, roomy);
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
    WordCache cache(1, roomy);
    const auto held = cache.get("a", Maker{});
    cache.set_capacity(0);
    CHECK(cache.size() == 0);
    CHECK(*held == "a!");
}

TEST_CASE("a maker that throws leaves nothing behind", "[cache]") {
    WordCache cache(2, roomy);
    const auto failing = [](const std::string&) -> std::shared_ptr<const std::string> { throw 1; };
    CHECK_THROWS(cache.get("a", failing));
    CHECK(cache.size() == 0);
    CHECK(*cache.get("a", Maker{}) == "a!");
}

TEST_CASE("a cache whose entries weigh too much drops what was used longest ago", "[cache]") {
    WordCache cache(100, 12);
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

TEST_CASE("a cache that finds no memory is as it was", "[cache]") {
    for (int allocations = 0;; ++allocations) {
        WordCache cache(1, roomy);
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

TEST_CASE("animated curves of many segments hold no more memory than stated", "[cache]") {
    ArcLengthCache& paths = arc_length_cache();
    FrameTablesCache& frames = frame_tables_cache();
    const std::size_t most = std::size_t{512} << 20;
    const std::size_t before = paths.size();
    std::vector<glm::dvec3> points = RandomCurves(7).points(40'000);
    constexpr std::size_t shots = 8;
    std::vector<std::shared_ptr<const ArcLength>> used;
    for (std::size_t i = 0; i < shots; ++i) {
        points[0].x += 0.001;
        const auto path = shared_arc_length(Curve::chain(3, points, false));
        CHECK(paths.bytes() <= paths.byte_limit());
        CHECK(path->bytes() >= path->curve().control_points().size_bytes() + 8 * 10'000);
        used.push_back(path);
    }
    CHECK(paths.size() < before + shots);
    for (const auto& path : used) (void)path->interval_count();
    CHECK(paths.bytes() + frames.byte_limit() <= most);
    FrameSettings settings;
    settings.mode = FrameMode::banking;
    settings.smoothing = 0.1;
    (void)shared_frames(shared_arc_length(Curve::chain(3, {points.data(), 4'000}, false)), settings);
    CHECK(frames.bytes() <= frames.byte_limit());
}

TEST_CASE("the tables of a tangled curve of 10,000 segments have room in the caches", "[cache]") {
    constexpr std::size_t segments = 1'000;  // a tenth of them: what they take grows evenly
    RandomCurves random(8);
    std::vector<glm::dvec3> points{random.in_cube(1.0)};
    glm::dvec3 handle = random.in_cube(0.5);
    for (std::size_t i = 0; i < segments; ++i) {
        const glm::dvec3 from = points.back();
        const glm::dvec3 to = random.in_cube(1.0);
        const glm::dvec3 next_handle = random.in_cube(0.5);
        if (i > 0) points.push_back(from);
        points.insert(points.end(), {from + handle, to - next_handle, to});
        handle = next_handle;
    }
    const auto path = std::make_shared<const ArcLength>(Curve::chain(3, points, false));
    (void)path->interval_count();
    CHECK(10 * ArcLengthBytes{}(path->curve(), *path) <= arc_length_cache().byte_limit());
    for (const FrameMode mode : {FrameMode::world_up, FrameMode::minimal, FrameMode::banking,
                                 FrameMode::curvature, FrameMode::tilt}) {
        const FrameTablesKey key{path->curve(), mode, 0.5};
        const FrameTables tables(path, mode, key.smoothing);
        CAPTURE(static_cast<int>(mode));
        CHECK(10 * FrameTablesBytes{}(key, tables) <= frame_tables_cache().byte_limit());
    }
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
    std::vector<glm::dvec3> points = RandomCurves(1).points(12);
    const auto path = shared_arc_length(Curve::chain(3, points, false));
    CHECK(shared_arc_length(Curve::chain(3, points, true)) != path);
    CHECK(shared_arc_length(Curve::chain(2, points, false)) != path);
    points[5].y = std::nextafter(points[5].y, 2.0);
    CHECK(shared_arc_length(Curve::chain(3, points, false)) != path);
}

TEST_CASE("many threads on one cache", "[cache]") {
    WordCache cache(3, roomy);
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
