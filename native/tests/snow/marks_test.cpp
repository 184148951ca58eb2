#include "motus/snow/marks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "motus/core/numeric.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

constexpr int cells = 80;
constexpr float half_width = 2.0F;  // so that vertices are 0.05 m apart
constexpr std::size_t count = (cells + 1) * (cells + 1);
const glm::dvec3 upwards(0.0, 0.0, 1.0);

struct Meadow {
    Points positions;
    Triangles triangles;
    Meadow() { add_sheet(half_width, 0.0F, 0.0F, cells, positions, triangles); }
};
[[nodiscard]] const Points& feet() {
    static const Meadow meadow;
    return meadow.positions;
}

[[nodiscard]] const SnowLayer& layer() {
    static const Meadow meadow;
    static const SnowLayer found(meadow.positions, meadow.triangles, upwards);
    return found;
}

/// A closed box.
struct Box {
    glm::vec3 half{1.0F};
    glm::vec3 middle{0.0F};
};
[[nodiscard]] std::shared_ptr<const Collider> boxes(const std::vector<Box>& all) {
    const Triangles faces{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    Points positions;
    Triangles triangles;
    for (const Box& one : all) {
        for (const glm::ivec3& face : faces) triangles.push_back(face + static_cast<int>(positions.size()));
        for (unsigned corner = 0; corner < 8; ++corner)
            positions.push_back(one.middle + one.half * glm::vec3((corner & 1U) != 0 ? 1.0F : -1.0F,
                                                                  (corner & 2U) != 0 ? 1.0F : -1.0F,
                                                                  (corner & 4U) != 0 ? 1.0F : -1.0F));
    }
    return std::make_shared<const Collider>(positions, triangles);
}
[[nodiscard]] std::shared_ptr<const Collider> box(const glm::vec3& half) {
    return boxes({{half}});
}

[[nodiscard]] std::shared_ptr<const Collider> ball(float radius) {
    constexpr int around = 96, down = 48;
    Points positions;
    Triangles triangles;
    for (int row = 0; row <= down; ++row) {
        for (int column = 0; column < around; ++column) {
            const double polar = std::numbers::pi * row / down,
                         turn = 2.0 * std::numbers::pi * column / around;
            const double out = row % down == 0 ? 0.0 : std::sin(polar);
            positions.emplace_back(static_cast<double>(radius) *
                                   glm::dvec3(out * std::cos(turn), out * std::sin(turn), std::cos(polar)));
            if (row == down) continue;
            const int next = (column + 1) % around, at = row * around;
            triangles.emplace_back(at + column, at + around + column, at + around + next);
            triangles.emplace_back(at + column, at + around + next, at + next);
        }
    }
    return std::make_shared<const Collider>(positions, triangles);
}

[[nodiscard]] glm::dmat4 shifted(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}

/// Snow that grows from `start` by `rate` m/s, at each of the times.
[[nodiscard]] float fallen(double time, double rate, double start) {
    return static_cast<float>(start + rate * time);
}
[[nodiscard]] std::vector<float> growing(const std::vector<double>& times, double rate, double start) {
    std::vector<float> heights;
    for (const double time : times) heights.insert(heights.end(), count, fallen(time, rate, start));
    return heights;
}

/// What is pressed away at a time, on all vertices.
[[nodiscard]] std::vector<float> pressed(const Marks& marks, double time, float depth,
                                         const std::vector<float>& shares = {}) {
    std::vector<float> found(marks.vertex_count());
    marks.press(time, std::vector<float>(marks.vertex_count(), depth), shares, found);
    return found;
}

}  // namespace

TEST_CASE("a plough leaves a trench of exact depth, which later snow fills", "[snow]") {
    // Half a metre wide, its lower side 0.04 m above the ground, along X through all of the meadow.
    const Mover plough{
        box({0.1F, 0.26F, 0.2F}), {1.0, 3.0}, {shifted({-3.0, 0.0, 0.24}), shifted({3.0, 0.0, 0.24})}};
    const std::vector<double> times{0.0, 2.0, 10.0};
    const Marks marks(layer(), {plough}, times, growing(times, 0.01, 0.1), {.step = 0.02});
    for (const double time : {4.0, 1.5, 10.0, 2.2}) {
        const float depth = fallen(time, 0.01, 0.1);
        const std::vector<float> gone = pressed(marks, time, depth);
        std::size_t marked = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 at(feet()[i]);
            // The hind edge passed there when the middle was 0.1 m farther.
            const double last = 1.0 + (at.x + 3.0 + 0.1) / 3.0, first = 1.0 + (at.x + 3.0 - 0.1) / 3.0;
            if (std::abs(at.y) > 0.26 || first > time) {
                CHECK(gone[i] == 0.0F);
                continue;
            }
            ++marked;
            const double passed = std::min(last, time);
            // The last look there was 1/32 s before, at most.
            CHECK(static_cast<double>(gone[i]) == Approx(0.1 + 0.01 * passed - 0.04).margin(3.5e-4));
        }
        CHECK((marked > 0) == (time > 1.3));
    }
    CHECK(pressed(marks, 0.9, 0.109F) == std::vector<float>(count));
}

TEST_CASE("a ball that is dropped and lifted leaves a bowl", "[snow]") {
    const Mover dropped{ball(0.5F),
                        {0.0, 1.0, 2.0},
                        {shifted({0.0, 0.0, 3.0}), shifted({0.0, 0.0, 0.55}), shifted({0.0, 0.0, 3.0})}};
    const std::vector<double> times{0.0, 5.0};
    const Marks marks(layer(), {dropped}, times, growing(times, 0.0, 0.2), {});
    const std::vector<float> gone = pressed(marks, 5.0, 0.2F);
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = length_of(glm::dvec3(feet()[i]));
        const double clearance = distance < 0.5 ? 0.55 - std::sqrt(0.25 - distance * distance)
                                                : std::numeric_limits<double>::infinity();
        CHECK(static_cast<double>(gone[i]) == Approx(std::max(0.0, 0.2 - clearance)).margin(1.5e-3));
    }
    // On the way down it has pressed less, and on the way up nothing more.
    CHECK(pressed(marks, 0.95, 0.2F)[count / 2] < gone[count / 2]);
    CHECK(pressed(marks, 1.5, 0.2F) == gone);
}

TEST_CASE("what rests on snow keeps it as it is, until it is taken away", "[snow]") {
    const Mover crate{box({0.31F, 0.31F, 0.2F}),
                      {2.0, 4.0, 8.0, 9.0},
                      {shifted({0.0, 0.0, 2.0}), shifted({0.0, 0.0, 0.25}), shifted({0.0, 0.0, 0.25}),
                       shifted({0.0, 0.0, 2.0})}};
    // Between the times at which the heights are known, too.
    const std::vector<double> times{0.0, 10.0};
    const Marks marks(layer(), {crate}, times, growing(times, 0.02, 0.1), {});
    const std::size_t middle = count / 2;
    for (const double time : {4.0, 4.3, 6.7, 8.0})
        CHECK(fallen(time, 0.02, 0.1) - pressed(marks, time, fallen(time, 0.02, 0.1))[middle] ==
              Approx(0.05F).margin(1e-6));
    // What fell after it was lifted lies on what it had left.
    CHECK(pressed(marks, 9.5, fallen(9.5, 0.02, 0.1))[middle] == Approx(0.1 + 0.16 - 0.05).margin(2e-5));
    // Half of the snow is not as deep as the crate stands, before 8 s.
    const std::vector<float> half(count, 0.3F);
    CHECK(pressed(marks, 6.0, fallen(6.0, 0.02, 0.1), half)[middle] ==
          Approx(0.1 + 0.12 - 0.05 / 0.3).margin(1e-6));
    CHECK(pressed(marks, 4.0, fallen(4.0, 0.02, 0.1), std::vector<float>(count, 0.1F))[middle] == 0.0F);
}

TEST_CASE("stretches of the time together are the whole of it, on any number of threads", "[snow]") {
    Mover roller{ball(0.4F), {}, {}};
    for (double time = 0.0; time <= 4.0; time += 0.25) {
        roller.times.push_back(time);
        roller.matrices.push_back(shifted({time - 2.0, 0.5 * std::sin(2.0 * time), 0.42}));
    }
    const Mover crate{box({0.2F, 0.3F, 0.2F}), {0.0}, {shifted({-1.2, 0.4, 0.22})}};
    const std::vector<Mover> movers{roller, crate};
    const std::vector<double> times{0.0, 1.5, 4.0}, early{0.0, 1.5}, late{1.5, 4.0};
    const Marks whole(layer(), movers, times, growing(times, 0.02, 0.05), {}, 1);
    const Marks again(layer(), movers, times, growing(times, 0.02, 0.05), {}, 3);
    const Marks first(layer(), movers, early, growing(early, 0.02, 0.05), {});
    const Marks second(layer(), movers, late, growing(late, 0.02, 0.05), {});
    CHECK(whole.marked_count() > 200);
    for (const double time : {3.0, 0.7, 1.5, 9.0}) {
        const float depth = fallen(std::min(time, 4.0), 0.02, 0.05);
        const std::vector<float> found = pressed(whole, time, depth);
        CHECK(found == pressed(again, time, depth));
        std::vector<float> parts = pressed(first, time, depth);
        second.press(time, std::vector<float>(count, depth), {}, parts);
        for (std::size_t i = 0; i < count; ++i) CHECK(parts[i] == Approx(found[i]).margin(1e-4));
    }
}

TEST_CASE("snow is pressed by what is above it, and by what it is inside of", "[snow]") {
    const auto at_rest = [&](const std::shared_ptr<const Collider>& what, const glm::dmat4& place,
                             const MarksSettings& settings = {}) {
        const std::vector<double> times{0.0, 1.0};
        return pressed(Marks(layer(), {{what, {0.0}, {place}}}, times, growing(times, 0.0, 0.1), settings),
                       0.5, 0.1F);
    };
    const auto most = [](const std::vector<float>& found) { return *std::ranges::max_element(found); };
    const auto crate = box({0.3F, 0.3F, 0.3F});
    // Half in the ground, on it, just in the snow, above it, and under the ground.
    for (const auto& [height, wanted] :
         {std::pair(0.0, 0.1), {0.3, 0.1}, {0.375, 0.025}, {0.41, 0.0}, {-0.4, 0.0}}) {
        CHECK(static_cast<double>(most(at_rest(crate, shifted({0.0, 0.0, height})))) ==
              Approx(wanted).margin(1e-6));
        // What is mirrored has the same inside.
        glm::dmat4 mirrored = shifted({0.0, 0.0, height});
        mirrored[0] = -mirrored[0];
        CHECK(static_cast<double>(most(at_rest(crate, mirrored))) == Approx(wanted).margin(1e-6));
    }
    // A sole without a back, either side down.
    for (const double up : {1.0, -1.0}) {
        glm::dmat4 sole = shifted({0.0, 0.0, 0.03});
        sole[2][2] = sole[0][0] = up;
        CHECK(static_cast<double>(most(at_rest(sheet(0.3F, 0.0F, 0.0F, 1), sole))) ==
              Approx(0.07).margin(1e-6));
    }
    CHECK(most(at_rest(crate, shifted({0.0, 0.0, 0.3}), {.packed = 0.02})) == Approx(0.08F).margin(1e-6));
    CHECK(most(at_rest(crate, shifted({0.0, 0.0, 0.3}), {.packed = 0.2})) == 0.0F);
    // As large as it is, and of no extent.
    CHECK(std::ranges::count_if(at_rest(crate, shifted({0.0, 0.0, 0.3})),
                                [](float gone) { return gone > 0.0F; }) == 13 * 13);
    CHECK(most(at_rest(crate, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)))) == 0.0F);
}

TEST_CASE("shells that overlap press as each of them does", "[snow]") {
    const auto at_rest = [&](const std::vector<Box>& all) {
        const std::vector<double> times{0.0, 1.0};
        const Mover mover{boxes(all), {0.0}, {shifted({})}};
        return pressed(Marks(layer(), {mover}, times, growing(times, 0.0, 0.3), {}), 0.5, 0.3F);
    };
    // A leg through the ground, a wider shoe that begins within it, a root of the leg whose top is within it,
    // and a cuff within the shoe.
    const std::vector<Box> shells{{{0.22F, 0.22F, 0.41F}, {0.0F, 0.0F, 0.19F}},
                                  {{0.33F, 0.33F, 0.3F}, {0.01F, 0.0F, 0.45F}},
                                  {{0.27F, 0.16F, 0.3F}, {0.0F, 0.02F, -0.37F}},
                                  {{0.115F, 0.28F, 0.2F}, {0.02F, 0.01F, 0.43F}}};
    for (unsigned chosen = 1; chosen < 16; ++chosen) {
        std::vector<Box> all;
        std::vector<float> wanted(count);
        for (std::size_t one = 0; one < shells.size(); ++one) {
            if ((chosen >> one & 1U) == 0) continue;
            all.push_back(shells[one]);
            const std::vector<float> alone = at_rest({shells[one]});
            for (std::size_t i = 0; i < count; ++i) wanted[i] = std::max(wanted[i], alone[i]);
        }
        const std::vector<float> found = at_rest(all);
        for (std::size_t i = 0; i < count; ++i) REQUIRE(found[i] == Approx(wanted[i]).margin(1e-6));
    }
}

TEST_CASE("a mover leaves its marks whenever others have their samples", "[snow]") {
    Mover roller{ball(0.4F), {}, {}}, far{box({0.1F, 0.1F, 0.1F}), {}, {}};
    for (int i = 0; i <= 16; ++i) {
        const double time = 0.25 * i;
        roller.times.push_back(time);
        roller.matrices.push_back(shifted({time - 2.0, 0.5 * std::sin(2.0 * time), 0.42}));
        far.times.push_back(time + 0.1);
        far.matrices.push_back(shifted({50.0 + 3.0 * time, 0.0, 0.0}));
    }
    const std::vector<double> times{0.0, 4.0};
    const Marks alone(layer(), {roller}, times, growing(times, 0.02, 0.05), {});
    const Marks both(layer(), {far, roller}, times, growing(times, 0.02, 0.05), {});
    CHECK(alone.marked_count() > 200);
    for (const double time : {0.6, 2.3, 4.0})
        CHECK(pressed(both, time, fallen(time, 0.02, 0.05)) ==
              pressed(alone, time, fallen(time, 0.02, 0.05)));
}

TEST_CASE("movers that would be looked at without end are refused", "[snow]") {
    Mover shaking{box({0.1F, 0.1F, 0.1F}), {}, {}};
    const int samples = 160'000;
    for (int i = 0; i < samples; ++i) {
        shaking.times.push_back(static_cast<double>(i) / samples);
        shaking.matrices.push_back(shifted({i % 2 == 0 ? 0.5 : -0.5, 0.0, 0.1}));
    }
    const std::vector<double> times{0.0, 1.0};
    CHECK_THROWS_WITH(Marks(layer(), {shaking}, times, growing(times, 0.0, 0.1), {.step = 1e-3}),
                      Catch::StartsWith("movers: must be fewer"));
}

TEST_CASE("what is fast leaves no gaps", "[snow]") {
    const Mover arrow{
        box({0.1F, 0.1F, 0.1F}), {1.0, 1.05}, {shifted({-1.9, 0.3, 0.1}), shifted({1.9, -0.2, 0.1})}};
    const std::vector<double> times{0.0, 2.0};
    const Marks marks(layer(), {arrow}, times, growing(times, 0.0, 0.1), {.step = 0.05});
    const std::vector<float> gone = pressed(marks, 2.0, 0.1F);
    for (std::size_t i = 0; i < count; ++i) {
        const double across = std::abs(static_cast<double>(feet()[i].y) - 0.3 +
                                       0.5 * (static_cast<double>(feet()[i].x) + 1.9) / 3.8);
        if (std::abs(feet()[i].x) < 1.9F && across < 0.09) CHECK(gone[i] == Approx(0.1F));
        if (across > 0.115) CHECK(gone[i] == 0.0F);
    }
}

TEST_CASE("a layer shows the share of the snow that is left", "[snow]") {
    std::vector<float> left(count, 1.0F);
    left[count / 2] = 0.25F;
    const SnowLayer::Mesh whole = layer().at(std::vector<float>(count, 0.2F), 0.01F, 1.0F);
    const SnowLayer::Mesh marked = layer().at(std::vector<float>(count, 0.2F), 0.01F, 1.0F, left);
    REQUIRE(marked.depths.size() == whole.depths.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < whole.depths.size(); ++i) {
        if (whole.depths[i] == marked.depths[i]) continue;
        ++differ;
        CHECK(marked.depths[i] == Approx(0.25F * whole.depths[i]));
    }
    CHECK(differ == 1);
}

TEST_CASE("bad marks are refused with a sentence", "[snow]") {
    const Mover crate{box({0.3F, 0.3F, 0.3F}), {0.0}, {shifted({0.0, 0.0, 0.3})}};
    const std::vector<double> times{0.0, 1.0};
    const std::vector<float> heights = growing(times, 0.0, 0.1);
    const auto refuses = [&](const Mover& mover, const std::vector<double>& at,
                             const std::vector<float>& rows, const MarksSettings& settings,
                             const char* name) {
        CHECK_THROWS_WITH(Marks(layer(), {mover}, at, rows, settings), Catch::StartsWith(name));
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refuses({nullptr, {0.0}, {shifted({})}}, times, heights, {}, "movers");
    refuses({crate.collider, {0.0, 0.0}, {shifted({}), shifted({})}}, times, heights, {}, "movers");
    refuses(crate, {}, {}, {}, "times");
    refuses(crate, {1.0, 1.0}, heights, {}, "times");
    refuses(crate, {0.0, nan}, heights, {}, "times");
    refuses(crate, {0.0}, heights, {}, "heights");
    refuses(crate, times, std::vector<float>(heights.size(), -0.1F), {}, "heights");
    refuses(crate, times, heights, {.packed = -1.0}, "packed");
    refuses(crate, times, heights, {.step = 0.0}, "step");
    const Marks marks(layer(), {crate}, times, heights, {});
    std::vector<float> found(count);
    CHECK_THROWS_WITH(marks.press(nan, found, {}, found), Catch::StartsWith("time"));
    CHECK_THROWS_WITH(marks.press(0.0, {}, {}, found), Catch::StartsWith("depths"));
    CHECK_THROWS_WITH(marks.press(0.0, found, std::vector<float>(3), found), Catch::StartsWith("shares"));
    CHECK_THROWS_WITH(marks.press(0.0, found, {}, std::span(found).first(3)), Catch::StartsWith("pressed"));
    for (const double share : {-1e-6, 1.0 + 1e-6, nan})
        CHECK_THROWS_WITH(
            marks.press(0.0, found, std::vector<float>(count, static_cast<float>(share)), found),
            Catch::StartsWith("shares: must be from 0 to 1"));
}
