// One dab on a million vertices, compared with NumPy's array by array way and with a simple loop.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "motus/core/parallel.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/sculpt/pull.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::sculpt;

namespace {

constexpr int side = 1000;
constexpr std::size_t vertex_count = std::size_t{side} * side;

/// Milliseconds by the clock, since several threads work: the fastest of `runs`.
template <class Work>
double milliseconds(Work&& work, int runs = 60) {
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        best = std::min(best, taken.count());
    }
    return best;
}

/// A rough square, 1 by 1, around the origin.
std::vector<glm::vec3> ground() {
    std::vector<glm::vec3> points(vertex_count);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float u = static_cast<float>(x) / side - 0.5f, v = static_cast<float>(y) / side - 0.5f;
            points[static_cast<std::size_t>(y * side + x)] = {
                u, v, 0.01f * std::sin(40.0f * u) * std::cos(31.0f * v)};
        }
    }
    return points;
}

std::vector<glm::ivec3> triangles() {
    std::vector<glm::ivec3> result;
    for (int y = 0; y + 1 < side; ++y) {
        for (int x = 0; x + 1 < side; ++x) {
            const int at = y * side + x;
            result.push_back({at, at + 1, at + side});
            result.push_back({at + 1, at + side + 1, at + side});
        }
    }
    return result;
}

/// Pulls up and down in turn, so that the ground stays where it is.
struct Turns {
    Dab dab;
    explicit Turns(float radius, Falloff falloff = Falloff::smooth) {
        dab.root = {0.03f, -0.02f, 0.0f};
        dab.displacement = {0.0f, 0.0f, 0.001f};
        dab.radius = radius;
        dab.profile.falloff = falloff;
    }
    const Dab& next() {
        dab.displacement = -dab.displacement;
        return dab;
    }
};

/// As an array language does it: each operation over all vertices, its result in an array of its own.
void array_by_array(std::vector<glm::vec3>& points, const Dab& dab) {
    const std::size_t n = points.size();
    const auto make = [n](auto&& of) {
        std::vector<float> result(n);
        for (std::size_t i = 0; i < n; ++i) result[i] = of(i);
        return result;
    };
    std::vector<glm::vec3> away(n), squares(n), moves(n), moved(n);
    for (std::size_t i = 0; i < n; ++i) away[i] = points[i] - dab.root;
    for (std::size_t i = 0; i < n; ++i) squares[i] = away[i] * away[i];
    const auto square = make([&](std::size_t i) { return squares[i].x + squares[i].y + squares[i].z; });
    const auto distance = make([&](std::size_t i) { return std::sqrt(square[i]); });
    const auto share = make([&](std::size_t i) { return distance[i] / dab.radius; });
    const auto t = make([&](std::size_t i) { return std::max(1.0f - share[i], 0.0f); });
    const auto t2 = make([&](std::size_t i) { return t[i] * t[i]; });
    const auto slope = make([&](std::size_t i) { return 3.0f - 2.0f * t[i]; });
    const auto force = make([&](std::size_t i) { return t2[i] * slope[i]; });
    for (std::size_t i = 0; i < n; ++i) moves[i] = force[i] * dab.displacement;
    for (std::size_t i = 0; i < n; ++i) moved[i] = points[i] + moves[i];
    points.swap(moved);
}

/// The pull as a simple loop.
void plain_loop(std::vector<glm::vec3>& points, const Dab& dab) {
    for (glm::vec3& p : points) {
        const float distance = glm::distance(p, dab.root);
        if (distance >= dab.radius) continue;
        const float t = 1.0f - distance / dab.radius;
        p += t * t * (3.0f - 2.0f * t) * dab.displacement;
    }
}

/// Everything read and written, on all threads: no dab that moves all takes less.
void memory_alone(std::vector<glm::vec3>& points, float nothing) {
    float* const numbers = &points[0].x;
    in_parts(3 * points.size(), 1 << 18, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) numbers[i] += nothing;
        bench::keep(numbers[first]);
    });
}

void row(const bench::Table& table, const char* name, double taken, double naive) {
    table.row(name, {taken, naive / taken});
}

}  // namespace

int main() {
    std::vector<glm::vec3> points = ground();
    const std::vector<float> weights(vertex_count, 0.5f);
    const volatile float nothing = 0.0f;
    Turns all(2.0f);
    const bench::Table table("A dab in place on " + std::to_string(vertex_count) + " vertices, " +
                                 std::to_string(thread_count()) + " threads, best of 60",
                             {{"taken", "ms", 3}, {"of array by array", "x", 1}}, 46);

    const double naive = milliseconds([&] { array_by_array(points, all.next()); }, 10);
    row(table, "array by array, one thread", naive, naive);
    for (const float radius : {0.05f, 2.0f}) {
        Turns turns(radius);
        row(table, radius < 1.0f ? "plain loop, radius 5 %" : "plain loop, all within the radius",
            milliseconds([&] { plain_loop(points, turns.next()); }, 20), naive);
    }
    row(table, "memory alone", milliseconds([&] { memory_alone(points, nothing); }), naive);

    for (const float radius : {0.05f, 0.2f, 0.4f, 2.0f}) {
        Turns turns(radius);
        char name[64];
        std::snprintf(name, sizeof name, "pull, smooth, radius %g", static_cast<double>(radius));
        row(table, name, milliseconds([&] { pull(points, turns.next(), {}, points); }), naive);
    }
    const std::vector<float> curve{0.0f, 0.1f, 0.3f, 0.4f, 0.7f, 0.8f, 0.9f, 1.0f};
    const char* const names[] = {"classic, k = 0", "smooth",   "sphere",   "root", "linear",
                                 "sharp",          "constant", "gaussian", "curve"};
    for (int falloff = 0; falloff < 9; ++falloff) {
        Turns turns(4.0f, static_cast<Falloff>(falloff));
        turns.dab.profile.curve = curve;
        char name[64];
        std::snprintf(name, sizeof name, "pull, %s, all within the radius", names[falloff]);
        row(table, name, milliseconds([&] { pull(points, turns.next(), {}, points); }), naive);
    }
    Turns power(4.0f, Falloff::classic);
    power.dab.profile.scale_factor = 0.7f;
    row(table, "pull, classic, k = 0.7, all within the radius",
        milliseconds([&] { pull(points, power.next(), {}, points); }), naive);
    row(table, "pull, with weights", milliseconds([&] { pull(points, all.next(), weights, points); }), naive);
    Turns turned(2.0f);
    turned.dab.metric = glm::mat3(0.0f, 1.7f, 0.0f, -1.7f, 0.0f, 0.0f, 0.0f, 0.0f, 1.7f);
    row(table, "pull, turned and scaled", milliseconds([&] { pull(points, turned.next(), {}, points); }),
        naive);
    turned.dab.metric = glm::mat3(1.0f, 0.1f, 0.0f, 0.0f, 1.3f, 0.0f, 0.2f, 0.0f, 0.8f);
    row(table, "pull, sheared", milliseconds([&] { pull(points, turned.next(), {}, points); }), naive);
    Turns twice(2.0f);
    twice.dab.mirror = 1;
    row(table, "pull, mirrored", milliseconds([&] { pull(points, twice.next(), {}, points); }), naive);
    std::vector<glm::vec3> out(vertex_count);
    row(table, "pull, into another array", milliseconds([&] { pull(points, all.next(), {}, out); }), naive);

    const Picker picker(points, triangles());
    Turns near(0.05f);
    std::vector<std::uint32_t> found;
    row(table, "tree's search, radius 5 %",
        milliseconds([&] { found = picker.within(near.dab.root, near.dab.radius); }), naive);
    row(table, "pull_among, of what it found",
        milliseconds([&] { pull_among(points, near.next(), found, {}, points); }), naive);
    row(table, "both", milliseconds([&] {
            pull_among(points, near.next(), picker.within(near.dab.root, near.dab.radius), {}, points);
        }),
        naive);
    return 0;
}
