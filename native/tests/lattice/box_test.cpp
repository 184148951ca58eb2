#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/matrix.hpp>

#include "checks.hpp"
#include "motus/lattice/lattice.hpp"

using namespace motus;
using namespace motus::lattice;
using namespace motus::lattice::checks;

TEST_CASE("a turned cuboid is found again", "[lattice]") {
    Dice dice(11);
    for (int trial = 0; trial < 40; ++trial) {
        const glm::dmat3 turn = glm::mat3_cast(dice.any_rotation());
        const glm::dvec3 half{dice.between(0.2, 1.0), dice.between(1.2, 2.0), dice.between(2.2, 4.0)},
            middle = dice.in_cube(5.0);
        std::vector<glm::vec3> points;
        for (int corner = 0; corner < 8; ++corner)
            points.emplace_back(middle + turn * (half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                                                   corner & 4 ? 1 : -1)));
        for (int i = 0; i < 500; ++i) points.emplace_back(middle + turn * (half * dice.in_cube(1.0)));
        const OrientedBox box = small_box(points, glm::dmat3(1.0));
        glm::dvec3 found = 0.5 * box.size;
        std::array<double, 3> sorted{found.x, found.y, found.z};
        std::sort(sorted.begin(), sorted.end());
        CHECK(sorted[0] == Approx(half.x).epsilon(1e-5));
        CHECK(sorted[1] == Approx(half.y).epsilon(1e-5));
        CHECK(sorted[2] == Approx(half.z).epsilon(1e-5));
        CHECK(glm::distance(box.center, middle) < 1e-5);
        CHECK(glm::determinant(box.axes) == Approx(1.0));
    }
}

TEST_CASE("a box holds its points, is never larger than the plain one, and keeps axes that are right",
          "[lattice]") {
    Dice dice(12);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<glm::vec3> points(static_cast<std::size_t>(dice.whole(1, 40)));
        for (glm::vec3& point : points)
            point = dice.in_cube(1.0) * glm::dvec3(1.0, trial % 2 ? 0.0 : 0.5, trial % 5 ? 1.0 : 0.0);
        const glm::dmat3 axes = glm::mat3_cast(dice.any_rotation());
        const OrientedBox plain = box_along(points, axes), small = small_box(points, axes);
        CHECK(small.size.x * small.size.y * small.size.z <=
              plain.size.x * plain.size.y * plain.size.z + 1e-9);
        for (const glm::vec3& point : points) {
            const glm::dvec3 at = (glm::dvec3(point) - small.center) * small.axes;
            CHECK(std::abs(at.x) <= 0.5 * small.size.x + 1e-9);
            CHECK(std::abs(at.y) <= 0.5 * small.size.y + 1e-9);
            CHECK(std::abs(at.z) <= 0.5 * small.size.z + 1e-9);
        }
    }
    const std::vector<glm::vec3> cube{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0},
                                      {0, 0, 3}, {1, 0, 3}, {0, 2, 3}, {1, 2, 3}};
    CHECK(small_box(cube, glm::dmat3(1.0)).axes == glm::dmat3(1.0));
    CHECK(small_box({}, glm::dmat3(1.0)).size == glm::dvec3(0.0));
    // A rectangle that stands askew, without thickness.
    const std::vector<glm::vec3> flat{{0, 0, 0}, {1, 1, 0}, {-2, 2, 0}, {-1, 3, 0}};
    const OrientedBox box = small_box(flat, glm::dmat3(1.0));
    CHECK(box.size.x * box.size.y == Approx(4.0).epsilon(1e-6));
    CHECK(box.size.z == Approx(0.0).margin(1e-9));
}
