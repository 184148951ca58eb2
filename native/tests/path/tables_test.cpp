// The caches of what is tabulated of curves and paths.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "curve/checks.hpp"
#include "frame_tables.hpp"
#include "motus/core/memory.hpp"
#include "motus/curve/arc_length.hpp"
#include "motus/curve/arc_length_cache.hpp"
#include "motus/path/frame_tables_cache.hpp"
#include "motus/path/frames.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;
using namespace motus::path;

namespace {

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

TEST_CASE("animated curves of many segments hold no more memory than the budget", "[cache]") {
    const std::size_t usual = cache_budget();
    constexpr std::size_t budget = std::size_t{24} << 20;
    set_cache_budget(budget);
    const std::size_t before = arc_length_cache().size();
    std::vector<glm::dvec3> points = RandomCurves(7).points(10'000);
    constexpr std::size_t shots = 8;
    std::vector<std::shared_ptr<const ArcLength>> used;
    for (std::size_t i = 0; i < shots; ++i) {
        points[0].x += 0.001;
        const auto path = shared_arc_length(Curve::chain(3, points, false));
        CHECK(cached_bytes() <= budget);
        CHECK(path->bytes() >= path->curve().control_points().size_bytes() + 8 * 2'500);
        used.push_back(path);
    }
    CHECK(arc_length_cache().size() < before + shots);
    for (const auto& path : used) (void)path->interval_count();
    FrameSettings settings;
    settings.mode = FrameMode::banking;
    settings.smoothing = 0.1;
    (void)shared_frames(shared_arc_length(Curve::chain(3, {points.data(), 4'000}, false)), settings);
    CHECK(arc_length_cache().bytes() + frame_tables_cache().bytes() <= budget);
    set_cache_budget(usual);
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
    CHECK(10 * ArcLengthBytes{}(path->curve(), *path) <= cache_budget());
    for (const FrameMode mode : {FrameMode::world_up, FrameMode::minimal, FrameMode::banking,
                                 FrameMode::curvature, FrameMode::tilt}) {
        const FrameTablesKey key{path->curve(), mode, 0.5};
        FrameSettings settings;
        settings.mode = mode;
        settings.smoothing = key.smoothing;
        const FrameTables tables(path, settings);
        CAPTURE(static_cast<int>(mode));
        CHECK(10 * FrameTablesBytes{}(key, tables) <= cache_budget());
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
