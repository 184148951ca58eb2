#include "movers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "flakes.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

/// A level sheet 0.25 m above its origin, which goes by a matrix at each quarter of a second.
template <class MatrixAt>
[[nodiscard]] Mover raft(const MatrixAt& matrix_at, double end = 4.0) {
    Mover mover{sheet(2.5F, 0.25F, 0.0F, 4), {}, {}};
    for (double time = 0.0; time <= end; time += 0.25) {
        mover.times.push_back(time);
        mover.matrices.push_back(matrix_at(time));
    }
    return mover;
}
[[nodiscard]] glm::dmat4 shifted(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}

}  // namespace

TEST_CASE("flakes land on what moves when both are there, and are carried along", "[snow]") {
    SnowSettings settings = falling(400.0);
    settings.lifetime = 9.0;
    settings.movers = {raft([](double time) { return shifted({time, 0.0, 0.5 * time}); })};
    const Snow snow(settings);
    // At 1.5 m/s down from 3 m, to 0.25 m + 0.5 m/s t, which the flake born at b meets at b + (2.75 - b / 2)
    // / 2.
    const Flakes before = flakes_at(snow, 3.0), now = flakes_at(snow, 3.7);
    std::size_t carried = 0;
    for (std::size_t i = 0; i < before.id.size(); ++i) {
        const double birth = static_cast<double>(before.id[i] + 1) / 400.0;
        const double landed = birth + (2.75 - 0.5 * birth) / 2.0;
        const glm::dvec3 was(before.position[i]), is(now.position[i]);
        if (landed > 2.999 || was.z < 1.7499) continue;
        ++carried;
        CHECK(was.z == Approx(0.25 + 0.5 * 3.0).margin(1e-5));
        CHECK(glm::length(is - was - glm::dvec3(0.7, 0.0, 0.35)) < 1e-5);
        CHECK(glm::length(glm::dvec3(now.velocity[i]) - glm::dvec3(1.0, 0.0, 0.5)) < 1e-6);
        // It came down where it was born, and went along from then on.
        const Flakes then = flakes_at(snow, landed);
        const auto row = static_cast<std::size_t>(before.id[i] - then.id.front());
        CHECK(was.x == Approx(static_cast<double>(then.position[row].x) + 3.0 - landed).margin(1e-4));
        if (carried > 40) break;
    }
    CHECK(carried > 40);
    CHECK(are_same(flakes_at(Snow(settings), 3.7, 3), now));
    CHECK(snow.touchdowns(4.0).empty());
    settings.collision = Collision::melt;
    settings.melt_time = 0.5;
    CHECK(flakes_at(Snow(settings), 3.7).id.size() < now.id.size());
}

TEST_CASE("what turns, turns the flakes on it", "[snow]") {
    SnowSettings settings = falling(400.0);
    settings.lifetime = 9.0;
    settings.tumble = 3.0;
    settings.movers = {raft(
        [](double time) { return glm::rotate(glm::dmat4(1.0), 0.3 * time, glm::dvec3(0.0, 0.0, 1.0)); })};
    const Snow snow(settings);
    constexpr double h = 1.0 / 512.0;
    const Flakes a = flakes_at(snow, 3.25 - h), b = flakes_at(snow, 3.25), c = flakes_at(snow, 3.25 + h),
                 late = flakes_at(snow, 4.25);
    std::size_t carried = 0;
    for (std::size_t i = 0; i < a.id.size(); ++i) {
        if (std::abs(a.position[i].z - 0.25F) > 1e-5F || b.position[i].z != a.position[i].z) continue;
        ++carried;
        // The velocity changes at a sample, where it is the next part's.
        const glm::dvec3 ahead = (glm::dvec3(c.position[i]) - glm::dvec3(b.position[i])) / h;
        CHECK(glm::length(ahead - glm::dvec3(b.velocity[i])) < 1e-3);
        // The raft stops at 4 s, after three quarters.
        const glm::dvec3 three = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.225, glm::dvec3(0.0, 0.0, 1.0))) *
                                 glm::dvec3(b.position[i]);
        CHECK(glm::length(glm::dvec3(late.position[i]) - three) < 1e-5);
        const glm::dquat q(b.rotation[i].x, b.rotation[i].y, b.rotation[i].z, b.rotation[i].w);
        const glm::dquat p(late.rotation[i].x, late.rotation[i].y, late.rotation[i].z, late.rotation[i].w);
        const glm::dquat turn = p * glm::conjugate(q);
        CHECK(2.0 * std::atan2(std::abs(turn.z), std::abs(turn.w)) == Approx(0.225).margin(1e-5));
    }
    CHECK(carried > 100);
}

TEST_CASE("what could move, but stands, is landed on as what stands", "[snow]") {
    SnowSettings settings = rich(2000.0);
    settings.bursts.clear();
    settings.collider = sheet(2.5F, 0.5F, 0.2F, 5);
    const Flakes wanted = flakes_at(Snow(settings), 3.0);
    settings.collider = nullptr;
    settings.movers = {{sheet(2.5F, 0.0F, 0.2F, 5), {0.0}, {shifted({0.0, 0.0, 0.5})}}};
    const Flakes found = flakes_at(Snow(settings), 3.0);
    REQUIRE(found.id == wanted.id);
    for (std::size_t i = 0; i < found.id.size(); ++i)
        CHECK(glm::length(found.position[i] - wanted.position[i]) < 1e-4F);
    // Of what stands and what moves flakes land on the first.
    settings.collider = sheet(6.0F, 0.6F, 0.2F, 5);
    const Flakes above = flakes_at(Snow(settings), 3.0);
    settings.movers.clear();
    CHECK(are_same(above, flakes_at(Snow(settings), 3.0)));
}

TEST_CASE("bad movers are refused with a sentence", "[snow]") {
    const auto refuses = [](const Mover& mover) {
        SnowSettings settings;
        settings.movers = {mover};
        CHECK_THROWS_WITH(Snow(settings), Catch::StartsWith("movers"));
    };
    const auto still = sheet(1.0F, 0.0F, 0.0F, 2);
    refuses({nullptr, {0.0}, {glm::dmat4(1.0)}});
    refuses({still, {}, {}});
    refuses({still, {0.0, 1.0}, {glm::dmat4(1.0)}});
    refuses({still, {0.0, 0.0}, {glm::dmat4(1.0), glm::dmat4(1.0)}});
    refuses({still, {std::numeric_limits<double>::quiet_NaN()}, {glm::dmat4(1.0)}});
    refuses({still, {0.0}, {glm::dmat4(std::numeric_limits<double>::infinity())}});
    // What is flat meets nothing.
    SnowSettings settings = falling(50.0);
    settings.movers = {{still, {0.0}, {glm::dmat4(0.0)}}};
    CHECK(flakes_at(Snow(settings), 3.0).id.size() > 10);
}
