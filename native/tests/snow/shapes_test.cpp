#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "flakes.hpp"
#include "motus/snow/snow.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("plain flakes fly straight from the square", "[snow]") {
    SnowSettings settings;
    settings.rate = 10000.0;
    settings.cone_radius = 2.0;
    const Flakes now = flakes_at(Snow(settings), 50.0);
    REQUIRE(now.age.size() == 20000);
    double mean = 0.0, square = 0.0;
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double birth = static_cast<double>(now.id[i] + 1) / 10000.0;
        CHECK(now.age[i] == Approx(50.0 - birth).margin(1e-7));
        CHECK(std::abs(now.position[i].x) <= 2.0F);
        CHECK(std::abs(now.position[i].y) <= 2.0F);
        CHECK(now.position[i].z == Approx(5.0 * (50.0 - birth)).margin(1e-5));
        CHECK(now.velocity[i] == glm::vec3(0.0F, 0.0F, 5.0F));
        CHECK(now.size[i] == 1.0F);
        CHECK(now.color[i] == glm::vec4(1.0F));
        CHECK(now.rotation[i] == glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
        mean += now.position[i].x / 20000.0;
        square += now.position[i].x * now.position[i].x / 20000.0;
    }
    CHECK(std::abs(mean) < 0.04);
    CHECK(square == Approx(4.0 / 3.0).epsilon(0.03));
}

TEST_CASE("shapes are filled evenly", "[snow]") {
    SnowSettings settings;
    settings.rate = 20000.0;
    settings.start_speed = 0.0;
    settings.cone_radius = 1.5;
    settings.cone_angle = 0.5;
    // Mean square of the distance from the Z axis, over r^2, and of z.
    struct Expected {
        Shape shape;
        double level, height;
    };
    for (const Expected& one : {Expected{Shape::disc, 0.5, 0.0}, Expected{Shape::box, 2.0 / 3.0, 1.0 / 3.0},
                                Expected{Shape::sphere, 0.4, 0.2}, Expected{Shape::cone, 0.5, 0.0}}) {
        settings.shape = one.shape;
        const Flakes now = flakes_at(Snow(settings), 10.0);
        double level = 0.0, height = 0.0;
        glm::dvec3 mean(0.0);
        const auto count = static_cast<double>(now.age.size());
        for (const glm::vec3& at : now.position) {
            const glm::dvec3 p = glm::dvec3(at) / 1.5;
            level += (p.x * p.x + p.y * p.y) / count;
            height += p.z * p.z / count;
            mean += p / count;
        }
        CAPTURE(static_cast<int>(one.shape));
        CHECK(level == Approx(one.level).epsilon(0.02));
        CHECK(height == Approx(one.height).epsilon(0.02).margin(1e-12));
        CHECK(glm::length(mean) < 0.02);
    }
}

TEST_CASE("a surface is covered evenly, and left along its normals", "[snow]") {
    test::Random random(6);
    SnowSettings settings;
    settings.rate = 100000.0;
    settings.lifetime = 1.0;
    settings.shape = Shape::surface;
    // Triangles of very different areas, each at a height of its own, two of them without area.
    std::vector<double> areas;
    double whole = 0.0;
    for (int i = 0; i < 12; ++i) {
        const auto height = static_cast<float>(i);
        const float width = i % 5 == 3 ? 0.0F : std::pow(2.0F, random.between(-4.0F, 2.0F));
        for (const glm::vec3& corner :
             {glm::vec3(0.0F, 0.0F, height), glm::vec3(width, 0.0F, height), glm::vec3(0.0F, 2.0F, height)})
            settings.surface_positions.push_back(corner);
        settings.surface_triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        areas.push_back(static_cast<double>(width));
        whole += areas.back();
    }
    settings.start_speed = 0.0;
    std::vector<double> found(areas.size());
    const Flakes now = flakes_at(Snow(settings), 3.0);
    glm::dvec3 mean(0.0);
    for (const glm::vec3& at : now.position) {
        const auto triangle = static_cast<std::size_t>(std::lround(at.z));
        found.at(triangle) += 1e-5;
        CHECK(at.x >= 0.0F);
        CHECK(at.y >= 0.0F);
        CHECK(static_cast<double>(at.x) / areas.at(triangle) + static_cast<double>(at.y) / 2.0 < 1.00001);
        mean += 1e-5 * glm::dvec3(static_cast<double>(at.x) / areas.at(triangle), at.y, 0.0);
    }
    for (std::size_t i = 0; i < areas.size(); ++i) CHECK(found[i] == Approx(areas[i] / whole).margin(0.006));
    CHECK(mean.x == Approx(1.0 / 3.0).epsilon(0.01));
    CHECK(mean.y == Approx(2.0 / 3.0).epsilon(0.01));

    settings.start_speed = 2.0;
    for (const glm::vec3& velocity : flakes_at(Snow(settings), 3.0).velocity)
        CHECK(velocity == glm::vec3(0.0F, 0.0F, 2.0F));
}

TEST_CASE("a camera's frustum is filled evenly, and left downwards", "[snow]") {
    SnowSettings settings;
    settings.rate = 100000.0;
    settings.lifetime = 1.0;
    settings.start_speed = 0.0;
    settings.shape = Shape::frustum;
    settings.frustum_angles = {0.7, 0.4};
    settings.frustum_far = 12.0;
    const glm::dvec2 wide = glm::tan(settings.frustum_angles);
    const glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 1.5)) *
                            glm::rotate(glm::dmat4(1.0), 1.2, glm::dvec3(1.0, 0.3, -0.2));
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {pose};
    for (const double nearest : {0.0, 0.1, 4.0, 11.5}) {
        settings.frustum_near = nearest;
        CAPTURE(nearest);
        const Flakes now = flakes_at(Snow(settings), 3.0);
        // By the volume up to a distance, and across each picture.
        const double low = std::pow(nearest / 12.0, 3.0);
        std::array<double, 8> shares{};
        glm::dvec2 mean(0.0), square(0.0);
        for (const glm::vec3& at : now.position) {
            const glm::dvec3 seen(glm::inverse(pose) * glm::dvec4(glm::dvec3(at), 1.0));
            const double distance = -seen.z;
            CHECK(distance >= nearest - 1e-5);
            CHECK(distance <= 12.00001);
            const double part = (std::pow(distance / 12.0, 3.0) - low) / (1.0 - low);
            shares.at(static_cast<std::size_t>(std::clamp(8.0 * part, 0.0, 7.0))) += 1e-5;
            const glm::dvec2 aside = glm::dvec2(seen) / (distance * wide);
            if (distance > 0.01) CHECK(std::max(std::abs(aside.x), std::abs(aside.y)) < 1.001);
            mean += 1e-5 * aside;
            square += 1e-5 * aside * aside;
        }
        for (const double share : shares) CHECK(share == Approx(0.125).margin(0.004));
        for (int axis = 0; axis < 2; ++axis) {
            CHECK(std::abs(mean[axis]) < 0.01);
            CHECK(square[axis] == Approx(1.0 / 3.0).epsilon(0.02));
        }
    }
    settings.start_speed = 2.0;
    for (const bool is_moving : {false, true}) {
        if (is_moving) {
            settings.emitter_times.push_back(5.0);
            settings.emitter_matrices.emplace_back(1.0);
        }
        const Flakes now = flakes_at(Snow(settings), 3.0);
        for (std::size_t i = 0; i < now.id.size(); i += 100) {
            CHECK(now.velocity[i] == glm::vec3(0.0F, 0.0F, -2.0F));
            CHECK(now.rotation[i] == glm::vec4(0.0F, 1.0F, 0.0F, 0.0F));
        }
    }
}

TEST_CASE("flakes stay where the emitter was when they were born", "[snow]") {
    SnowSettings settings;
    settings.rate = 100.0;
    settings.start_speed = 0.0;
    settings.cone_radius = 0.0;
    settings.lifetime = 10.0;
    settings.emitter_times = {1.0, 3.0};
    settings.emitter_matrices = {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 0.0, 0.0))};
    const Flakes now = flakes_at(Snow(settings), 5.0);
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double birth = static_cast<double>(now.id[i] + 1) / 100.0;
        CHECK(now.position[i].x == Approx(std::clamp(2.0 * (birth - 1.0), 0.0, 4.0)).margin(1e-5));
    }
}

TEST_CASE("flakes leave with a share of the emitter's velocity", "[snow]") {
    SnowSettings settings;
    settings.rate = 100.0;
    settings.start_speed = 3.0;
    settings.cone_radius = 0.0;
    settings.lifetime = 10.0;
    settings.emitter_times = {1.0, 3.0};
    settings.emitter_matrices = {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 0.0, 0.0))};
    settings.inherited = 0.5;
    const Flakes now = flakes_at(Snow(settings), 5.0);
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double birth = static_cast<double>(now.id[i] + 1) / 100.0;
        const double speed = birth > 1.005 && birth < 2.995 ? 1.0 : 0.0;
        if (std::abs(birth - 1.0) < 0.005 || std::abs(birth - 3.0) < 0.005) continue;
        CHECK(now.velocity[i].x == Approx(speed).margin(1e-6));
        CHECK(now.velocity[i].z == Approx(3.0));
        const double born = std::clamp(2.0 * (birth - 1.0), 0.0, 4.0);
        CHECK(now.position[i].x == Approx(born + speed * (5.0 - birth)).margin(1e-4));
    }
    // At any frame, and none of it where there is none.
    CHECK(are_same(flakes_at(Snow(settings), 5.0), now));
    settings.inherited = 0.0;
    for (const glm::vec3& velocity : flakes_at(Snow(settings), 5.0).velocity) CHECK(velocity.x == 0.0F);
}
