// Planning the steps of a shot, and looking them up.
#include <cmath>
#include <cstdio>
#include <vector>

#include "motus/walker/walker.hpp"
#include "stopwatch.hpp"
#include "table.hpp"
#include "walker/walkers.hpp"

using namespace motus::walker;
using motus::bench::keep;
using motus::bench::nanoseconds;

namespace {

constexpr double seconds = 250.0 / 24.0;

void bench_plans(const motus::bench::Table& table, const char* name, const Ground& ground,
                 const WalkSettings& settings) {
    const Way way = way_along(seconds, around);
    const double planned = nanoseconds([&] { keep(Walker(way, settings, &ground, 1)); });
    const Walker walker(way, settings, &ground, 1);
    std::size_t steps = 0;
    for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) steps += walker.steps(leg).size();
    const double frames = nanoseconds([&] {
        for (int frame = 0; frame < 250; ++frame) {
            for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) keep(walker.foot(leg, frame / 24.0));
            keep(walker.body(frame / 24.0));
        }
    });
    table.row(name, {static_cast<double>(steps), 1e-6 * planned, 1e-3 * frames / 250.0});
}

}  // namespace

int main() {
    const motus::bench::Table table("Walkers of eight legs on 250 frames, one thread",
                                    {{"steps", "", 0}, {"planned", "ms", 3}, {"a frame", "us", 3}}, 26);
    WalkSettings plain, with_hips;
    for (const glm::dvec3& place : eight_feet())
        with_hips.hips.push_back(0.3 * place + glm::dvec3(0.0, 0.0, 0.4));
    with_hips.lengths.assign(8, 1.4);
    const Ground level = plane(), hilly = hilly_ground();
    bench_plans(table, "a plane", level, plain);
    bench_plans(table, "12,800 triangles", hilly, plain);
    bench_plans(table, "the same, with hips", hilly, with_hips);
    const Land large = land(8.0, 707, hills);
    const double built =
        nanoseconds([&] { keep(Ground(large.positions, large.triangles, std::nullopt, 1)); }, 3);
    bench_plans(table, "a million triangles", ground_of(large), with_hips);
    const motus::bench::Table grounds("Grounds, one thread", {{"triangles", "", 0}, {"built", "ms", 0}}, 26);
    grounds.row("a million triangles", {static_cast<double>(large.triangles.size()), 1e-6 * built});
}
