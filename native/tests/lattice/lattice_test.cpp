#include "motus/lattice/lattice.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/matrix.hpp>
#include <numeric>
#include <stdexcept>

#include "checks.hpp"
#include "deform_kernel.hpp"

using namespace motus;
using namespace motus::lattice;
using namespace motus::lattice::checks;

TEST_CASE("weights of lattice points add up to one", "[lattice]") {
    Dice dice(1);
    for (int trial = 0; trial < 300; ++trial) {
        const Lattice lattice = dice.lattice();
        const Weights weights =
            weights_at(lattice, trial % 2 ? dice.place(lattice) : lattice.origin + dice.in_cube(20.0));
        CHECK(std::accumulate(weights.weights.begin(), weights.weights.end(), 0.0) ==
              Approx(1.0).epsilon(1e-14));
        CHECK(std::is_sorted(weights.points.begin(), weights.points.end()));
        CHECK(weights.points.back() < point_count(lattice));
    }
}

TEST_CASE("Bernstein lattices are Sederberg and Parry's formula", "[lattice]") {
    Dice dice(2);
    const auto bernstein = [](int n, int i, double t) {
        return std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0)) *
               std::pow(t, i) * std::pow(1.0 - t, n - i);
    };
    for (int trial = 0; trial < 20; ++trial) {
        Lattice lattice = dice.lattice(12);
        lattice.basis.fill(Basis::bernstein);
        const glm::dvec3 at = 0.5 * dice.in_cube() + 0.5;
        const Weights weights = weights_at(lattice, lattice.origin + lattice.axes * at);
        const auto [nu, nv, nw] = lattice.resolution;
        std::vector<double> found(point_count(lattice), 0.0);
        for (std::size_t i = 0; i < weights.points.size(); ++i) found[weights.points[i]] = weights.weights[i];
        std::size_t index = 0;
        for (int w = 0; w < nw; ++w) {
            for (int v = 0; v < nv; ++v) {
                for (int u = 0; u < nu; ++u, ++index)
                    CHECK(found[index] == Approx(bernstein(nu - 1, u, at.x) * bernstein(nv - 1, v, at.y) *
                                                 bernstein(nw - 1, w, at.z))
                                              .margin(1e-12));
            }
        }
    }
}

TEST_CASE("interpolating lattice bases pass through the points, approximating ones do not", "[lattice]") {
    Lattice lattice;
    lattice.resolution = {5, 1, 1};
    lattice.axes[0] *= 4.0;
    const auto at_point_2 = [&](Basis basis) {
        lattice.basis.fill(basis);
        return weights_at(lattice, {2.0, 0.0, 0.0});
    };
    for (const Basis basis : {Basis::linear, Basis::cardinal, Basis::catmull_rom}) {
        const Weights weights = at_point_2(basis);
        CHECK(weights.points == std::vector<std::uint32_t>{2});
        CHECK(weights.weights[0] == 1.0);
    }
    const Weights weights = at_point_2(Basis::bspline);
    CHECK(weights.points == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(weights.weights[1] == Approx(2.0 / 3.0));

    // Tangents at a point: half, and 0.71, of the way between its neighbours.
    constexpr double h = 1e-6;
    for (const auto& [basis, tension] : {std::pair(Basis::catmull_rom, 0.5), {Basis::cardinal, 0.71}}) {
        lattice.basis.fill(basis);
        const Weights after = weights_at(lattice, {2.0 + h, 0.0, 0.0});
        const Weights before = weights_at(lattice, {2.0 - h, 0.0, 0.0});
        std::array<double, 5> slope{};
        for (std::size_t i = 0; i < after.points.size(); ++i)
            slope[after.points[i]] += after.weights[i] / (2.0 * h);
        for (std::size_t i = 0; i < before.points.size(); ++i)
            slope[before.points[i]] -= before.weights[i] / (2.0 * h);
        CHECK(slope[3] == Approx(tension).epsilon(1e-5));
        CHECK(slope[1] == Approx(-tension).epsilon(1e-5));
        CHECK(slope[2] == Approx(0.0).margin(1e-5));
    }
}

TEST_CASE("weights are continuous across cells and beyond the ends", "[lattice]") {
    for (const Basis basis : all_bases) {
        Lattice lattice;
        lattice.resolution = {6, 3, 1};
        lattice.basis.fill(basis);
        std::vector<double> last;
        constexpr double step = 1e-4;
        for (double x = -1.5; x < 2.5; x += step) {
            const Weights weights = weights_at(lattice, {x, 0.3, 0.0});
            std::vector<double> now(point_count(lattice), 0.0);
            for (std::size_t i = 0; i < weights.points.size(); ++i)
                now[weights.points[i]] = weights.weights[i];
            double jump = 0.0;
            for (std::size_t i = 0; i < last.size(); ++i) jump = std::max(jump, std::abs(now[i] - last[i]));
            REQUIRE(jump < 10.0 * step);
            last = now;
        }
    }
}

TEST_CASE("a lattice at rest, shifted or turned takes along what is in it", "[lattice]") {
    Dice dice(4);
    for (int trial = 0; trial < 60; ++trial) {
        Lattice lattice = dice.lattice();
        // Bases that reproduce what is linear within the lattice; the cubic ones do so away from its ends
        // only.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lattice.basis[axis] = trial % 2 ? Basis::linear : Basis::bernstein;
            lattice.resolution[axis] = std::max(2, lattice.resolution[axis]);
        }
        const glm::dmat3 turn = glm::mat3_cast(dice.any_rotation());
        const glm::dvec3 shift = dice.in_cube(2.0);
        std::vector<glm::vec3> displacements;
        for (const glm::dvec3& point : rest_points(lattice))
            displacements.emplace_back(turn * point + shift - point);
        std::vector<glm::vec3> positions(50), out(50);
        for (glm::vec3& position : positions) position = dice.place(lattice);
        deform(lattice, displacements, {}, positions, out);
        for (std::size_t i = 0; i < out.size(); ++i)
            CHECK(glm::distance(glm::dvec3(out[i]), turn * glm::dvec3(positions[i]) + shift) < 1e-5);
    }
}

TEST_CASE("deform is the weighted sum, with the influence", "[lattice]") {
    Dice dice(5);
    for (int trial = 0; trial < 40; ++trial) {
        const Lattice lattice = dice.lattice();
        const std::size_t points = point_count(lattice);
        std::vector<glm::vec3> displacements(points);
        std::vector<glm::dvec3> exact(points);
        std::vector<float> point_weights(points);
        for (std::size_t i = 0; i < points; ++i) {
            displacements[i] = dice.in_cube(1.0);
            exact[i] = displacements[i];
            point_weights[i] = static_cast<float>(dice.between(0.0, 1.0));
        }
        std::vector<glm::vec3> positions(30), out(30);
        std::vector<float> factors(30);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            positions[i] = lattice.origin + dice.in_cube(6.0);
            factors[i] = i % 5 ? static_cast<float>(dice.between(0.0, 1.0)) : 0.0f;
        }
        deform(lattice, displacements, {factors, point_weights}, positions, out);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const Weights weights = weights_at(lattice, positions[i]);
            double faded = 0.0;
            for (std::size_t k = 0; k < weights.points.size(); ++k)
                faded += weights.weights[k] * static_cast<double>(point_weights[weights.points[k]]);
            const double factor = factors[i];
            const glm::dvec3 wanted =
                glm::dvec3(positions[i]) + factor * factor * faded * moved_by(weights, exact);
            CHECK(glm::distance(glm::dvec3(out[i]), wanted) < 3e-6);
            if (factors[i] == 0.0f) CHECK(out[i] == positions[i]);
        }
        std::vector<glm::vec3> in_place = positions;
        deform(lattice, displacements, {factors, point_weights}, in_place, in_place);
        CHECK(in_place == out);
    }
}

TEST_CASE("a lattice deforms many positions to the same bits as few", "[lattice]") {
    Dice dice(6);
    Lattice lattice = dice.lattice();
    lattice.resolution = {4, 5, 3};
    std::vector<glm::vec3> displacements(point_count(lattice)), positions(50'000), out(50'000);
    for (glm::vec3& displacement : displacements) displacement = dice.in_cube(1.0);
    for (glm::vec3& position : positions) position = dice.place(lattice);
    deform(lattice, displacements, {}, positions, out);
    for (std::size_t i = 0; i < positions.size(); i += 997) {
        glm::vec3 alone(0.0f);
        deform(lattice, displacements, {}, {&positions[i], 1}, {&alone, 1});
        REQUIRE(alone == out[i]);
    }
}

TEST_CASE("all instruction sets deform with the same bits", "[lattice]") {
    Dice dice(25);
    for (int round = 0; round < 60; ++round) {
        const Lattice lattice = dice.lattice();
        const Grid grid(lattice);
        std::vector<WeightedMove> moves(point_count(lattice));
        for (WeightedMove& one : moves) one = {dice.in_cube(2.0f), dice.between(0.0f, 1.0f)};
        std::vector<glm::vec3> positions(40);
        std::vector<float> factors(positions.size());
        for (glm::vec3& position : positions) position = glm::vec3(dice.place(lattice));
        for (float& factor : factors) factor = static_cast<float>(dice.whole(0, 2)) * 0.7f;
        const auto deformed = [&](const DeformKernel& kernel) {
            std::vector<glm::vec3> out(positions.size());
            kernel.deform({.grid = grid,
                           .moves = moves,
                           .fades = round % 2 == 0,
                           .factors = factors,
                           .positions = positions,
                           .out = out},
                          0, out.size());
            return out;
        };
        const std::vector<glm::vec3> expected = deformed(deform_kernels().front());
        for (const DeformKernel& kernel : deform_kernels()) {
            INFO(kernel.name);
            CHECK(deformed(kernel) == expected);
        }
    }
}

TEST_CASE("lattice settings outside their domain are refused", "[lattice]") {
    Lattice lattice;
    lattice.resolution = {0, 2, 2};
    CHECK_THROWS_AS(rest_points(lattice), std::invalid_argument);
    lattice.resolution = {2, 65, 2};
    CHECK_THROWS_AS(weights_at(lattice, glm::dvec3(0.0)), std::invalid_argument);
    lattice.resolution = {2, 2, 2};
    for (const glm::dvec3 axis : {glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(NAN, 0.0, 1.0)}) {
        lattice.axes[2] = axis;
        CHECK_THROWS_AS(rest_points(lattice), std::invalid_argument);
    }
    lattice.axes[2] = {0.0, 0.0, 1e-30};  // small is not flat
    CHECK(rest_points(lattice).size() == 8);
    std::vector<glm::dvec3> out(8);
    const Part astray{1, glm::dvec3(0.0)};
    const glm::dvec3 displacement(1.0);
    CHECK_THROWS_AS(pull_lattice(lattice, {&astray, 1}, {&displacement, 1}, {}, out), std::invalid_argument);
    CHECK(pull_lattice(lattice, {}, {}, {}, out).empty());
    CHECK(out == std::vector<glm::dvec3>(8, glm::dvec3(0.0)));
}
