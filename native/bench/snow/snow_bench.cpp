// A million flakes at one time, beside a plain loop over the formulas of each.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "motus/mesh/refine.hpp"
#include "motus/noise/noise.hpp"
#include "motus/snow/cover.hpp"
#include "motus/snow/layer.hpp"
#include "motus/snow/marks.hpp"
#include "motus/snow/snow.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::snow;
using motus::bench::keep;

namespace {

/// Buffers of the fields that a renderer needs.
struct Buffers {
    explicit Buffers(std::size_t count) : position(count), size(count), age(count), color(count) {}
    [[nodiscard]] Fields fields() { return {.position = position, .size = size, .color = color, .age = age}; }

    std::vector<glm::vec3> position;
    std::vector<float> size, age;
    std::vector<glm::vec4> color;
};

/// Of several threads the time on the wall counts, of one the processor's.
template <class Work>
[[nodiscard]] double milliseconds(std::size_t threads, const Work& work) {
    if (threads == 1) return 1e-6 * bench::nanoseconds(work, 15);
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 15; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        best = std::min(best, taken.count());
    }
    return best;
}

void measure(const bench::Table& table, const char* name, const SnowSettings& settings, double time) {
    const Snow snow(settings);
    Buffers buffers(snow.living(time).count());
    std::array<double, 2> taken{};
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
        taken[threads - 1] = milliseconds(threads, [&] {
            snow.evaluate(snow.living(time, threads), buffers.fields(), threads);
            keep(buffers);
        });
    }
    table.row(name, {static_cast<double>(buffers.age.size()), taken[0], taken[1]});
}

/// What no way of finding flakes can be quicker than: their bytes are written, block by block as they are
/// found.
void measure_writing(const bench::Table& table) {
    constexpr std::size_t count = 1000000, block = 256;
    Buffers buffers(count);
    float number = 0.0F;
    const double taken = milliseconds(1, [&] {
        number += 1.0F;
        for (std::size_t first = 0; first < count; first += block) {
            const std::size_t last = std::min(count, first + block);
            for (std::size_t i = first; i < last; ++i) buffers.position[i] = glm::vec3(number);
            for (std::size_t i = first; i < last; ++i) buffers.size[i] = number;
            for (std::size_t i = first; i < last; ++i) buffers.color[i] = glm::vec4(number);
            for (std::size_t i = first; i < last; ++i) buffers.age[i] = number;
        }
        keep(buffers);
    });
    table.row("their bytes written alone", {static_cast<double>(count), taken});
}

/// What one writes down first: every flake by itself, its way by steps of 1/60 s.
void measure_naive(const bench::Table& table, const SnowSettings& settings, double time) {
    constexpr std::size_t count = 10000;
    Buffers buffers(count);
    const double naive = bench::nanoseconds(
        [&] {
            for (std::size_t i = 0; i < count; ++i) {
                const double age = settings.lifetime * static_cast<double>(i) / count;
                glm::dvec3 at(0.0), velocity(0.0);
                constexpr double h = 1.0 / 60.0;
                for (double now = 0.0; now < age; now += h) {
                    const double p = -settings.max_angle * noise::value(now, 0);
                    const double q = -settings.max_angle * noise::value(now, 1);
                    velocity += h * settings.drag * (settings.wind - velocity);
                    at += h * (velocity + settings.start_speed * glm::dvec3(std::sin(q),
                                                                            -std::sin(p) * std::cos(q),
                                                                            std::cos(p) * std::cos(q)));
                }
                buffers.position[i] = at;
                buffers.age[i] = static_cast<float>(age);
                buffers.size[i] = static_cast<float>(settings.start_size);
                buffers.color[i] = settings.start_color.front().color;
            }
            keep(buffers);
        },
        3);
    // Of a hundredth of the flakes: it takes long.
    table.row("the same by steps of 1/60 s", {1e6, 1e-6 * naive * 1e6 / static_cast<double>(count)});
    keep(time);
}

/// Hills of 2 * cells^2 triangles, 40 m wide.
[[nodiscard]] std::shared_ptr<const Collider> hills(int cells) {
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const glm::vec2 at = 40.0F * (glm::vec2(column, row) / static_cast<float>(cells) - 0.5F);
            positions.emplace_back(at, std::sin(at.x) * std::cos(0.7F * at.y));
            if (row == cells || column == cells) continue;
            const int corner = row * (cells + 1) + column;
            triangles.emplace_back(corner, corner + 1, corner + cells + 2);
            triangles.emplace_back(corner, corner + cells + 2, corner + cells + 1);
        }
    }
    return std::make_shared<const Collider>(positions, triangles);
}

void measure_landings(const bench::Table& table, SnowSettings settings) {
    const bench::Table other("Colliders and covers, one thread", {{"count", "", 0}, {"taken", "ms"}}, 34);
    constexpr int cells = 224;  // 100 352 triangles
    const double built = bench::nanoseconds([&] { keep(hills(cells)); }, 3);
    other.row("a collider is built, of triangles", {2.0 * cells * cells, 1e-6 * built});
    settings.cone_radius = 15.0;
    settings.start_speed = -4.0;
    settings.max_angle = 0.5;
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {glm::dmat4(1.0)};
    settings.emitter_matrices.front()[3] = {0.0, 0.0, 4.0, 1.0};
    settings.collider = hills(cells);
    settings.ground = -3.0;
    const double found = bench::nanoseconds(
        [&] {
            const Snow snow(settings);
            Buffers buffers(snow.living(100.0).count());
            snow.evaluate(snow.living(100.0), buffers.fields(), 1);
            keep(buffers);
        },
        1);
    other.row("where flakes land is found", {1e6, 1e-6 * found});
    measure(table, "with a collider and the ground", settings, 100.0);
    settings.rate = 2500.0;
    const Snow snow(settings);
    const CoverSettings until{.end = 40.0};
    std::vector<float> heights(settings.collider->positions().size());
    const Cover cover(snow, until);
    const double made = bench::nanoseconds([&] { keep(Cover(snow, until, 1)); }, 1);
    const double asked = bench::nanoseconds([&] { cover.heights(25.0, heights, 1); });
    other.row("a cover is made, of flakes", {1e5, 1e-6 * made});
    other.row("and asked for heights of vertices", {static_cast<double>(heights.size()), 1e-6 * asked});
}

/// A layer of 263 169 vertices around a roof.
void measure_layer(const char* title, const std::vector<glm::vec3>& positions,
                   const std::vector<glm::ivec3>& triangles) {
    std::vector<glm::vec3> all = positions;
    std::vector<glm::ivec3> sheltering = triangles;
    const auto first = static_cast<int>(all.size());
    for (const glm::vec2& corner : {glm::vec2(-5, -4), glm::vec2(4, -5), glm::vec2(5, 4), glm::vec2(-4, 5)})
        all.emplace_back(corner, 1.0F);
    sheltering.emplace_back(first, first + 1, first + 2);
    sheltering.emplace_back(first, first + 2, first + 3);
    const Collider shelter(all, sheltering);
    const glm::dvec3 up(0.0, 0.0, 1.0);
    const double made =
        bench::nanoseconds([&] { keep(SnowLayer(positions, triangles, up, &shelter, 1.5)); }, 3);
    const bench::Table table(title, {{"vertices", "", 0}, {"taken", "ms"}}, 34);
    const double count = static_cast<double>(positions.size());
    table.row("made", {count, 1e-6 * made});
    const SnowLayer layer(positions, triangles, up, &shelter, 1.5);
    for (const float roughness : {0.0F, 0.2F, 4.0F}) {
        std::vector<float> depths(positions.size());
        for (std::size_t i = 0; i < depths.size(); ++i) {
            const bool is_open = !shelter.below(glm::dvec3(positions[i]) + 1e-3 * up, up).has_value();
            const double noise = noise::value(3.7 * static_cast<double>(i), 0);
            depths[i] = is_open ? 0.1F * std::max(0.0F, 1.0F + roughness * static_cast<float>(noise)) : 0.0F;
        }
        const double shown = bench::nanoseconds([&] { keep(layer.at(depths, 0.004F, 1.2F)); });
        char name[40];
        std::snprintf(name, sizeof name, "its mesh, of roughness %.1f", static_cast<double>(roughness));
        table.row(name, {count, 1e-6 * shown});
    }
}

void measure_layers() {
    constexpr int cells = 512;
    constexpr float cell = 20.0F / static_cast<float>(cells);
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            positions.emplace_back(cell * static_cast<float>(column) - 10.0F,
                                   cell * static_cast<float>(row) - 10.0F, 0.0F);
            if (row == cells || column == cells) continue;
            const int corner = row * (cells + 1) + column;
            triangles.emplace_back(corner, corner + 1, corner + cells + 2);
            triangles.emplace_back(corner, corner + cells + 2, corner + cells + 1);
        }
    }
    measure_layer("A layer around a roof, one thread", positions, triangles);
    // Its vertices are numbered from coarse to fine, as those of every surface that the add-on refines.
    const mesh::Refined refined =
        mesh::refine(std::vector<glm::vec3>{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}},
                     std::vector<glm::ivec3>{{0, 1, 2}, {0, 2, 3}}, 1.8F * cell, 1000000);
    measure_layer("A layer of a refined surface around a roof, one thread", refined.positions,
                  refined.triangles);
}

/// What a ball of 0.5 m that rolls for 10 s leaves in a layer of 160 801 vertices, 0.05 m apart.
void measure_marks() {
    constexpr int cells = 400, around = 48, down = 24;
    std::vector<glm::vec3> positions, points;
    std::vector<glm::ivec3> triangles, faces;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            positions.emplace_back(0.05F * static_cast<float>(column) - 10.0F,
                                   0.05F * static_cast<float>(row) - 10.0F, 0.0F);
            if (row == cells || column == cells) continue;
            const int corner = row * (cells + 1) + column;
            triangles.emplace_back(corner, corner + 1, corner + cells + 2);
            triangles.emplace_back(corner, corner + cells + 2, corner + cells + 1);
        }
    }
    for (int row = 0; row <= down; ++row) {
        for (int column = 0; column < around; ++column) {
            const double polar = std::numbers::pi * row / down,
                         turn = 2.0 * std::numbers::pi * column / around;
            points.emplace_back(0.5 * std::sin(polar) * std::cos(turn),
                                0.5 * std::sin(polar) * std::sin(turn), 0.5 * std::cos(polar));
            if (row == down) continue;
            const int next = (column + 1) % around, at = row * around;
            faces.emplace_back(at + column, at + around + column, at + around + next);
            faces.emplace_back(at + column, at + around + next, at + next);
        }
    }
    snow::Mover ball{std::make_shared<const Collider>(points, faces), {}, {}};
    for (int i = 0; i <= 960; ++i) {
        const double time = i / 96.0;
        glm::dmat4 matrix(1.0);
        matrix[3] = glm::dvec4(1.8 * time - 9.0, 3.0 * std::sin(time), 0.52, 1.0);
        ball.times.push_back(time);
        ball.matrices.push_back(matrix);
    }
    const SnowLayer layer(positions, triangles, {0.0, 0.0, 1.0});
    const std::vector<double> times{0.0, 10.0};
    const std::vector<float> heights(2 * positions.size(), 0.1F);
    const bench::Table table("Marks of a ball that rolls 36 m, one thread",
                             {{"vertices", "", 0}, {"taken", "ms"}}, 34);
    const double made =
        bench::nanoseconds([&] { keep(snow::Marks(layer, {ball}, times, heights, {.step = 0.025}, 1)); }, 3);
    const snow::Marks marks(layer, {ball}, times, heights, {.step = 0.025}, 1);
    table.row("made", {static_cast<double>(marks.marked_count()), 1e-6 * made});
    std::vector<float> pressed(positions.size());
    const double asked =
        bench::nanoseconds([&] { marks.press(9.0, std::span(heights).first(pressed.size()), {}, pressed); });
    table.row("asked for what is pressed", {static_cast<double>(marks.marked_count()), 1e-6 * asked});
}

}  // namespace

int main() {
    const bench::Table table("Snow: position, size, colour and age into given buffers, best of several",
                             {{"flakes", "", 0}, {"one thread", "ms"}, {"two threads", "ms"}}, 36);
    SnowSettings settings;
    settings.rate = 500000.0;
    settings.snow = true;
    settings.drag = 1.0;
    settings.wind = {2.0, 0.5, 0.0};
    measure(table, "steering and wind", settings, 100.0);
    measure_writing(table);
    measure(table, "the same at 5000 s", settings, 5000.0);
    measure_naive(table, settings, 100.0);
    SnowSettings gusty = settings;
    gusty.gusts = 0.5;
    measure(table, "with gusts", gusty, 100.0);
    SnowSettings turbulent = settings;
    turbulent.turbulence = 0.5;
    measure(table, "with turbulence", turbulent, 100.0);
    SnowSettings random = settings;
    random.start_color = {{0.0F, {1.0F, 1.0F, 1.0F, 1.0F}}, {1.0F, {0.5F, 0.7F, 1.0F, 1.0F}}};
    random.cone_angle = 0.5;
    random.random_speed = random.random_orientation = random.random_size = random.random_color = true;
    measure(table, "all random but the lifetime", random, 100.0);
    random.random_lifetime = true;
    measure(table, "all random", random, 100.0);
    SnowSettings apart = settings;
    apart.snow_offsets = true;
    measure(table, "offsets into the noise", apart, 100.0);
    SnowSettings few = settings;
    few.rate = 50000.0;
    measure(table, "steering and wind, 50 000 a second", few, 100.0);
    few.rate = 500.0;
    few.lifetime = 10.0;
    measure(table, "steering and wind, 500 a second", few, 100.0);
    measure_landings(table, settings);
    measure_layers();
    measure_marks();
    const double made = bench::nanoseconds([&] { keep(Snow(settings)); });
    const bench::Table anew("Snow made anew", {{"taken", "ms", 3}}, 34);
    anew.row("steering and wind", {1e-6 * made});
    return 0;
}
