// Lattices: deforming a million positions, one pull, a box.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "motus/lattice/lattice.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::lattice;

namespace {

constexpr std::size_t position_count = 1'000'000;

/// Milliseconds of the clock on the wall: the work is shared among threads.
template <class Work>
[[nodiscard]] double milliseconds(Work&& work, int runs = 7) {
    double best = 1e300;
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        best = std::min(
            best,
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

/// A wavy ball in the unit cube.
[[nodiscard]] std::vector<glm::vec3> ball() {
    std::vector<glm::vec3> result;
    result.reserve(position_count);
    for (std::size_t i = 0; i < position_count; ++i) {
        const double z = 2.0 * (static_cast<double>(i) + 0.5) / position_count - 1.0,
                     turn = 2.4 * static_cast<double>(i);
        const double r = std::sqrt(1.0 - z * z), size = 0.45 + 0.05 * std::sin(9.0 * turn);
        result.emplace_back(0.5 + size * r * std::cos(turn), 0.5 + size * r * std::sin(turn), 0.5 + size * z);
    }
    return result;
}

void row(const bench::Table& table, const char* name, Basis basis, int resolution,
         std::span<const glm::vec3> positions) {
    Lattice lattice;
    lattice.resolution.fill(resolution);
    lattice.basis.fill(basis);
    std::vector<glm::vec3> displacements(point_count(lattice)), out(positions.size());
    for (std::size_t i = 0; i < displacements.size(); ++i)
        displacements[i] = glm::vec3(std::sin(1.0f * static_cast<float>(i)), 0.1f, 0.2f);
    const double deforming = milliseconds([&] {
        deform(lattice, displacements, {}, positions, out);
        bench::keep(out);
    });
    const std::vector<Part> parts{{0, {0.3, 0.4, 0.9}}, {1, {0.7, 0.4, 0.9}}};
    const std::vector<glm::dvec3> pulls{{0.0, 0.0, 0.2}, {0.0, 0.0, 0.0}};
    std::vector<glm::dvec3> moves(point_count(lattice));
    const double pulling = bench::nanoseconds(
        [&] {
            const auto left = pull_lattice(lattice, parts, pulls, {}, moves);
            bench::keep(left);
        },
        50);
    table.row(name + (", " + std::to_string(resolution)) + "^3", {deforming, pulling / 1e3});
}

}  // namespace

int main() {
    const std::vector<glm::vec3> positions = ball();
    const bench::Table table("Lattices: a million positions, all threads; two pulls at once, one thread",
                             {{"deform", "ms", 1}, {"pull", "us", 1}}, 30);
    row(table, "linear", Basis::linear, 4, positions);
    row(table, "cardinal", Basis::cardinal, 4, positions);
    row(table, "B-spline", Basis::bspline, 4, positions);
    row(table, "B-spline", Basis::bspline, 16, positions);
    row(table, "Bernstein", Basis::bernstein, 4, positions);
    row(table, "Bernstein", Basis::bernstein, 8, positions);
    Lattice large;
    large.resolution = {16, 16, 16};
    std::vector<Part> parts;
    std::vector<glm::dvec3> pulls;
    for (std::size_t i = 0; i < max_pulls; ++i) {
        const auto along = static_cast<double>(i) / static_cast<double>(max_pulls);
        parts.push_back({i, {along, std::fmod(31.7 * along, 1.0), std::fmod(97.3 * along, 1.0)}});
        pulls.push_back({0.0, 0.0, std::sin(40.0 * along)});
    }
    std::vector<glm::dvec3> moves(point_count(large));
    const double many = milliseconds(
        [&] {
            const auto left = pull_lattice(large, parts, pulls, {}, moves);
            bench::keep(left);
        },
        1);
    const bench::Table other("Many pulls, and a box", {{"taken", "ms", 1}}, 30);
    other.row(std::to_string(max_pulls) + " pulls at once, B-spline, 16^3", {many});
    const double fitting = milliseconds(
        [&] {
            const OrientedBox box = small_box(positions, glm::dmat3(1.0));
            bench::keep(box);
        },
        3);
    other.row("small box around a million", {fitting});
    return 0;
}
