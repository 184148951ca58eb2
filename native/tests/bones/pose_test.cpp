#include "motus/bones/pose.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using std::numbers::pi;

namespace {

/// Z(z) Y(y) X(x): what order XYZ means to Blender.
glm::dquat from_euler(const glm::dvec3& euler) {
    return glm::angleAxis(euler.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(euler.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(euler.x, glm::dvec3(1, 0, 0));
}

}  // namespace

TEST_CASE("Euler angles give the rotation back", "[pose]") {
    test::Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const glm::dquat rotation = random.any_rotation();
        const glm::dquat again = from_euler(euler_xyz(rotation));
        CHECK(std::abs(glm::dot(rotation, again)) == Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("Euler angles are those of mathutils", "[pose]") {
    struct Known {
        glm::dquat rotation;
        glm::dvec3 euler;
    };
    const double h = std::sqrt(0.5);
    const std::vector<Known> known{
        {{1, 0, 0, 0}, {0, 0, 0}},
        {{h, h, 0, 0}, {pi / 2, 0, 0}},
        {{h, 0, h, 0}, {0, pi / 2, 0}},
        {{0, 0, 0, 1}, {0, 0, pi}},
        // to_euler('XYZ') of Blender 3.4, single precision
        {{-0.4063003, -0.3957257, 0.2307395, -0.7906204}, {-0.074455, -0.949692, 2.230469}},
        {{-0.0568386, -0.8943292, 0.4364350, 0.0804306}, {2.968085, 0.094390, -0.916223}},
        {{0.8877756, -0.3300123, 0.2606382, -0.1871208}, {-0.813347, 0.346143, -0.565769}},
        {{-0.4897642, 0.0963999, -0.8339602, -0.2352625}, {-0.628967, 2.101904, -0.137970}},
        {{0.2983704, 0.0246412, -0.1757373, 0.9378082}, {-0.324219, -0.151668, 2.550383}},
        {{0.0723468, -0.7298265, 0.1984451, -0.6501837}, {-1.947963, -1.168920, -1.375873}},
    };
    for (const Known& row : known) {
        const glm::dvec3 euler = euler_xyz(row.rotation);
        for (int axis = 0; axis < 3; ++axis) CHECK(euler[axis] == Approx(row.euler[axis]).margin(2e-6));
    }
}

TEST_CASE("Euler angles are right at 90 degrees about Y", "[pose]") {
    for (const double sign : {1.0, -1.0}) {
        const glm::dquat rotation = from_euler({0.3, sign * pi / 2.0, 0.4});
        const glm::dvec3 euler = euler_xyz(rotation);
        CHECK(euler.z == 0.0);
        CHECK(std::abs(glm::dot(rotation, from_euler(euler))) == Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("matrices are packed column by column", "[pose]") {
    const std::vector<glm::dvec3> locations{{1, 2, 3}, {-4, 5, 6}};
    const std::vector<glm::dquat> rotations{{1, 0, 0, 0}, glm::angleAxis(pi / 2.0, glm::dvec3(0, 0, 1))};
    std::array<float, 32> out{};
    pack_matrices(locations, rotations, out);
    const std::array<float, 32> expected{1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 1,  2, 3, 1,
                                         0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, -4, 5, 6, 1};
    for (std::size_t i = 0; i < out.size(); ++i) CHECK(out[i] == Approx(expected[i]).margin(1e-7));

    CHECK_THROWS_AS(pack_matrices(locations, {rotations.data(), 1}, out), std::invalid_argument);
    CHECK_THROWS_AS(pack_matrices(locations, rotations, {out.data(), 31}), std::invalid_argument);
}

TEST_CASE("matrices take scales along their axes", "[pose]") {
    const std::vector<glm::dvec3> locations{{1, 2, 3}};
    const std::vector<glm::dquat> rotations{glm::angleAxis(pi / 2.0, glm::dvec3(0, 0, 1))};
    const std::vector<glm::dvec3> scales{{2, 3, -4}, {1, 1, 1}};
    std::array<float, 16> out{};
    pack_matrices(locations, rotations, out, {scales.data(), 1});
    const std::array<float, 16> expected{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 1, 2, 3, 1};
    for (std::size_t i = 0; i < out.size(); ++i) CHECK(out[i] == Approx(expected[i]).margin(1e-6));
    CHECK_THROWS_AS(pack_matrices(locations, rotations, out, scales), std::invalid_argument);
}
