#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "allocations.hpp"
#include "checks.hpp"
#include "motus/lattice/lattice.hpp"
#include "symmetric_function.hpp"

using namespace motus;
using namespace motus::test;
using namespace motus::lattice;
using namespace motus::lattice::checks;

namespace {

[[nodiscard]] double size_of(std::span<const glm::dvec3> vectors) {
    double sum = 0.0;
    for (const glm::dvec3& v : vectors) sum += glm::dot(v, v);
    return std::sqrt(sum);
}

}  // namespace

TEST_CASE("a pulled point arrives, by the smallest change", "[lattice]") {
    Dice dice(7);
    for (int trial = 0; trial < 200; ++trial) {
        const Lattice lattice = dice.lattice(5);
        const Part part{0, dice.place(lattice), 1.0, trial % 3 ? 1.0 : 0.4};
        const glm::dvec3 displacement = dice.in_cube(2.0);
        std::vector<glm::dvec3> out(point_count(lattice));
        const auto left = pull_lattice(lattice, {&part, 1}, {&displacement, 1}, {}, out);
        CHECK(glm::length(left[0]) < 1e-13);
        const Weights weights = weights_at(lattice, part.place);
        CHECK(glm::distance(part.influence * moved_by(weights, out), displacement) < 1e-13);
        // Any other change with the same effect is larger: take off what the place feels of a random one.
        std::vector<glm::dvec3> other(out.size());
        for (glm::dvec3& v : other) v = dice.in_cube(0.1);
        const double square =
            std::inner_product(weights.weights.begin(), weights.weights.end(), weights.weights.begin(), 0.0);
        const glm::dvec3 felt = moved_by(weights, other);
        for (std::size_t i = 0; i < weights.points.size(); ++i)
            other[weights.points[i]] -= weights.weights[i] / square * felt;
        for (std::size_t i = 0; i < out.size(); ++i) other[i] += out[i];
        CHECK(size_of(out) <= size_of(other) + 1e-12);
    }
}

TEST_CASE("several points of a lattice may be pulled or held at once", "[lattice]") {
    Dice dice(8);
    for (int trial = 0; trial < 60; ++trial) {
        Lattice lattice = dice.lattice(5);
        lattice.resolution = {4, 4, 4};
        std::vector<Part> parts;
        std::vector<glm::dvec3> displacements;
        for (std::size_t pull = 0; pull < 4; ++pull) {
            // In corners of the lattice of their own.
            const glm::dvec3 corner(pull & 1 ? 0.8 : 0.2, pull & 2 ? 0.8 : 0.2, dice.between(0.0, 1.0));
            parts.push_back({pull, lattice.origin + lattice.axes * corner});
            displacements.push_back(pull ? glm::dvec3(0.0) : dice.in_cube(1.0));
        }
        std::vector<glm::dvec3> out(point_count(lattice));
        const auto left = pull_lattice(lattice, parts, displacements, {}, out);
        for (std::size_t pull = 0; pull < 4; ++pull) {
            CHECK(glm::length(left[pull]) < 1e-12);
            CHECK(glm::distance(moved_by(weights_at(lattice, parts[pull].place), out), displacements[pull]) <
                  1e-12);
        }
    }
}

TEST_CASE("a point of a triangle is pulled by its corners", "[lattice]") {
    Dice dice(9);
    const Lattice lattice = dice.lattice(4);
    const std::vector<Part> parts{{0, dice.place(lattice), 0.5, 1.0},
                                  {0, dice.place(lattice), 0.3, 0.6},
                                  {0, dice.place(lattice), 0.2, 0.9}};
    const glm::dvec3 displacement(0.3, -0.2, 1.0);
    std::vector<glm::dvec3> out(point_count(lattice));
    (void)pull_lattice(lattice, parts, {&displacement, 1}, {}, out);
    glm::dvec3 moved(0.0);
    for (const Part& part : parts)
        moved += part.share * part.influence * moved_by(weights_at(lattice, part.place), out);
    CHECK(glm::distance(moved, displacement) < 1e-13);
}

TEST_CASE("opposite pulls on one place meet in the middle", "[lattice]") {
    Lattice lattice;
    lattice.resolution = {3, 3, 3};
    const std::vector<Part> parts{{0, glm::dvec3(0.4)}, {1, glm::dvec3(0.4)}};
    const std::vector<glm::dvec3> displacements{{1.0, 0.5, 0.0}, {-1.0, 0.5, 0.0}};
    std::vector<glm::dvec3> out(point_count(lattice));
    const auto left = pull_lattice(lattice, parts, displacements, {}, out);
    const glm::dvec3 moved = moved_by(weights_at(lattice, glm::dvec3(0.4)), out);
    CHECK(glm::distance(moved, glm::dvec3(0.0, 0.5, 0.0)) < 1e-12);
    CHECK(glm::distance(left[0], glm::dvec3(1.0, 0.0, 0.0)) < 1e-12);
}

TEST_CASE("pulls that a lattice cannot reach move its points by bounded amounts that change continuously",
          "[lattice]") {
    Lattice lattice;
    lattice.resolution = {4, 4, 4};
    const std::vector<glm::dvec3> apart{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
    std::vector<glm::dvec3> out(point_count(lattice)), last;
    const PullOptions options;
    // Two neighbours, nearer and nearer, that are pulled apart; and one vertex of less and less influence.
    for (double nearness = 0.5; nearness > 1e-9; nearness *= 0.9) {
        const std::vector<Part> pair{{0, glm::dvec3(0.3, 0.4, 0.5)},
                                     {1, glm::dvec3(0.3 + nearness, 0.4, 0.5)}};
        (void)pull_lattice(lattice, pair, apart, options, out);
        const double square = [&] {
            double least = std::numeric_limits<double>::infinity();
            for (const Part& part : pair) {
                const Weights weights = weights_at(lattice, part.place);
                least = std::min(least, std::inner_product(weights.weights.begin(), weights.weights.end(),
                                                           weights.weights.begin(), 0.0));
            }
            return least;
        }();
        REQUIRE(size_of(out) <= options.max_gain * size_of(apart) / std::sqrt(square));
        if (!last.empty()) {
            for (std::size_t i = 0; i < out.size(); ++i) last[i] -= out[i];
            REQUIRE(size_of(last) < 0.25 * options.max_gain * size_of(apart) / std::sqrt(square));
        }
        last = out;

        const Part weak{0, glm::dvec3(0.3, 0.4, 0.5), 1.0, nearness};
        (void)pull_lattice(lattice, {&weak, 1}, {apart.data(), 1}, options, out);
        REQUIRE(size_of(out) <= 1.001 * options.max_gain / std::sqrt(square));
    }
    CHECK(size_of(out) < 1e-3);  // a vertex that the lattice does not move at all moves no point either
}

TEST_CASE("vertices inside a lattice follow a pull of its surface", "[lattice]") {
    Dice dice(10);
    Lattice lattice;
    lattice.resolution = {5, 4, 3};
    lattice.basis.fill(Basis::linear);
    PullOptions options;
    options.outside_only = true;
    const Part part{0, glm::dvec3(0.45, 0.4, 0.55)};
    const glm::dvec3 displacement(0.2, 0.7, -0.1);
    std::vector<glm::dvec3> out(point_count(lattice));
    const auto left = pull_lattice(lattice, {&part, 1}, {&displacement, 1}, options, out);
    CHECK(glm::length(left[0]) < 1e-13);
    CHECK(glm::distance(moved_by(weights_at(lattice, part.place), out), displacement) < 1e-13);
    // Point (2, 1, 1), from the six points of the outside in line with it.
    const auto at = [&](int u, int v, int w) { return out[static_cast<std::size_t>(u + 5 * (v + 4 * w))]; };
    const glm::dvec3 wanted = (0.5 * (at(0, 1, 1) + at(4, 1, 1)) + (2.0 * at(2, 0, 1) + at(2, 3, 1)) / 3.0 +
                               0.5 * (at(2, 1, 0) + at(2, 1, 2))) /
                              3.0;
    CHECK(glm::distance(at(2, 1, 1), wanted) < 1e-14);
}

TEST_CASE("a thousand pulls take memory for what they move", "[lattice]") {
    Dice dice(11);
    Lattice lattice;
    lattice.resolution = {32, 32, 32};
    std::vector<Part> parts;
    std::vector<glm::dvec3> displacements;
    for (std::size_t pull = 0; pull < 300; ++pull) {
        parts.push_back({pull, dice.place(lattice)});
        displacements.push_back(dice.in_cube(1.0));
    }
    std::vector<glm::dvec3> out(point_count(lattice)), left;
    for (const bool outside : {false, true}) {
        PullOptions options;
        options.outside_only = outside;
        const std::size_t bytes = test::bytes_allocated_by(
            [&] { left = pull_lattice(lattice, parts, displacements, options, out); });
        CHECK(bytes <
              20'000'000);  // with whole rows 157 million, and 4 GB for a thousand in 64 * 64 * 64 points
        for (std::size_t pull = 0; pull < parts.size(); pull += 7) {
            const glm::dvec3 moved = moved_by(weights_at(lattice, parts[pull].place), out);
            CHECK(glm::distance(moved + left[pull], displacements[pull]) < 1e-12);
        }
    }
}

TEST_CASE("more pulls than lattice points are solved in the space of the points", "[lattice]") {
    Dice dice(12);
    Lattice lattice;
    lattice.resolution = {3, 2, 4};
    std::vector<Part> parts;
    std::vector<glm::dvec3> displacements;
    // Four times those of a field that the lattice can do, and one point pulled away from it.
    std::vector<glm::dvec3> field(point_count(lattice));
    for (glm::dvec3& v : field) v = dice.in_cube(1.0);
    for (std::size_t pull = 0; pull < 3 * max_pulls; ++pull) {
        parts.push_back({pull, dice.place(lattice)});
        displacements.push_back(moved_by(weights_at(lattice, parts[pull].place), field));
    }
    std::vector<glm::dvec3> out(point_count(lattice));
    for (const glm::dvec3& rest : pull_lattice(lattice, parts, displacements, {}, out))
        CHECK(glm::length(rest) < 1e-10);
    displacements[5] += glm::dvec3(1.0, 0.0, 0.0);
    const auto left = pull_lattice(lattice, parts, displacements, {}, out);
    CHECK(left[5].x > 0.9);
    // Least squares: what is left pulls no lattice point either way.
    std::vector<glm::dvec3> force(out.size(), glm::dvec3(0.0));
    for (std::size_t pull = 0; pull < parts.size(); ++pull) {
        const Weights weights = weights_at(lattice, parts[pull].place);
        for (std::size_t i = 0; i < weights.points.size(); ++i)
            force[weights.points[i]] += weights.weights[i] * left[pull];
    }
    CHECK(size_of(force) < 1e-9);
}

TEST_CASE("more pulls than can be solved are refused", "[lattice]") {
    Lattice lattice;
    lattice.resolution = {16, 16, 16};
    Dice dice(13);
    std::vector<Part> parts;
    for (std::size_t pull = 0; pull <= max_pulls; ++pull) parts.push_back({pull, dice.place(lattice)});
    const std::vector<glm::dvec3> displacements(parts.size(), glm::dvec3(0.0, 0.0, 1.0));
    std::vector<glm::dvec3> out(point_count(lattice));
    CHECK_THROWS_WITH(pull_lattice(lattice, parts, displacements, {}, out),
                      Catch::Contains("displacements: at most 1000"));
    lattice.resolution = {32, 32, 32};
    lattice.basis.fill(Basis::bernstein);
    out.resize(point_count(lattice));
    parts.resize(600);
    CHECK_THROWS_WITH(pull_lattice(lattice, parts, {displacements.data(), 600}, {}, out),
                      Catch::Contains("displacements: too many"));
}

TEST_CASE("a function of a symmetric matrix times vectors", "[lattice]") {
    Dice dice(14);
    for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{40}}) {
        // Sums of fewer outer products than its size: half of the eigenvalues are 0.
        std::vector<double> matrix(size * size, 0.0);
        for (std::size_t term = 0; term < (size + 1) / 2; ++term) {
            std::vector<double> v(size);
            for (double& value : v) value = dice.between(-1.0, 1.0);
            for (std::size_t i = 0; i < size; ++i)
                for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] += v[i] * v[j];
        }
        std::vector<glm::dvec3> columns(size);
        for (glm::dvec3& row : columns) row = dice.in_cube(1.0);
        const auto times = [&](const std::vector<glm::dvec3>& vectors) {
            std::vector<glm::dvec3> product(size, glm::dvec3(0.0));
            for (std::size_t i = 0; i < size; ++i)
                for (std::size_t j = 0; j < size; ++j) product[i] += matrix[i * size + j] * vectors[j];
            return product;
        };
        const auto largest_gap = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
            double gap = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) gap = std::max(gap, glm::distance(a[i], b[i]));
            return gap;
        };
        const double scale = static_cast<double>(size);
        CHECK(largest_gap(times_function(matrix, columns, [](double) { return 1.0; }), columns) <
              1e-14 * scale);
        CHECK(largest_gap(times_function(matrix, columns, [](double x) { return x; }), times(columns)) <
              1e-14 * scale * scale);
        const auto inverse = [](double x) { return x > 1e-6 ? 1.0 / x : 0.0; };
        // A A^+ A = A.
        CHECK(largest_gap(times(times_function(matrix, times(columns), inverse)), times(columns)) <
              1e-12 * scale * scale);
    }
}
