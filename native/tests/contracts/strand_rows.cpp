#include <numbers>

#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/strand/motion.hpp"

namespace motus::contracts {
namespace {

using namespace strand;

/// What the spans of strand::Inputs show.
struct Shot {
    std::vector<double> times{0.0, 0.1, 0.2};
    std::vector<glm::dvec3> poses, gravity{{0.0, 0.0, -9.81}},
        air{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
    std::vector<Obstacle> obstacles{{Obstacle::Shape::capsule, 0.1, 0.5}, {Obstacle::Shape::plane, 0.0, 0.5}};
    std::vector<glm::dvec3> obstacle_places, pin_places;
    std::vector<PlacedSurface> surfaces{
        {std::make_shared<const Surface>(sample_positions(), sample_triangles(), 1), 0.01, 0.5}};
    std::vector<glm::dmat4> surface_matrices{3, glm::dmat4(1.0)};
    std::vector<std::size_t> pinned{2}, resets{2};
    std::vector<double> pin_weights{0.5, 0.7, 1.0};
    std::vector<glm::dvec3> sides{9, glm::dvec3(0.0, 1.0, 0.0)};
    double friction = 0.5;

    Shot() {
        for (int k = 0; k < 3; ++k) {
            for (const double x : {0.0, 0.4, 0.8}) poses.emplace_back(x, 0.1 * k, 1.0);
            for (const double z : {0.7, 0.9, -0.5, 0.5}) obstacle_places.emplace_back(0.4, 0.1, z);
            pin_places.emplace_back(0.7, 0.0, 1.0);
        }
    }
    [[nodiscard]] Inputs inputs() const {
        return {times,       poses,
                gravity,     air,
                obstacles,   obstacle_places,
                surfaces,    surface_matrices,
                pinned,      pin_places,
                pin_weights, resets,
                sides,       true,
                friction};
    }
};

[[nodiscard]] std::vector<Link> sample_links() {
    Link link{.frequency = 2.0,
              .drag = 1.0,
              .bend_frequency = 3.0,
              .bend = 1.0,
              .thickness = 0.02,
              .side_bend = 0.5};
    std::vector<Link> links(3, link);
    for (int i = 0; i < 3; ++i) links[static_cast<std::size_t>(i)].parent = i - 1;
    return links;
}

/// Solved as far as it goes at once, so that long ones take no longer.
[[nodiscard]] std::tuple<std::vector<glm::dvec3>, double> solved(Motion motion) {
    motion.solve(200);
    std::vector<glm::dvec3> found(motion.size());
    motion.places(0.15, found);
    return {found, motion.gap()};
}

void add_making(Table& table) {
    const Shot shot;
    const Domain near = up_to(1e9).open();
    const auto rows = as_many_as("`times`, times what they are of");
    const char* cost = "O(links times)";
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const std::vector<Link>& links) {
            Shot given;
            given.pinned.clear();
            given.pin_places.clear();
            given.pin_weights.clear();
            given.poses.clear();
            given.sides.clear();
            for (std::size_t i = 0; i < 3 * links.size(); ++i)
                given.poses.emplace_back(0.3 * static_cast<double>(i), 0.0, 1.0);
            return solved(Motion(links, given.inputs()));
        },
        of(sample_links(),
           each("parent", &Link::parent,
                numbers("-1, or the index of a link before", [](double x) { return x >= -1.0 && x < 3.0; })
                    .open()),
           each("mass", &Link::mass, numbers("> 0, ≤ 1e12", [](double x) { return x > 0.0 && x <= 1e12; })),
           each("frequency", &Link::frequency, from(0.0, 60.0).in_words("0 to an eighth of the rate")),
           each("damping", &Link::damping, from(0.0, 100.0)), each("response", &Link::response, up_to(100.0)),
           each("drag", &Link::drag, from(0.0, 1000.0)), each("stretch", &Link::stretch, from(0.0, 1e6)),
           each("bend_frequency", &Link::bend_frequency,
                from(0.0, 60.0).in_words("0 to an eighth of the rate")),
           each("bend", &Link::bend, from(0.0, std::numbers::pi).in_words("0 to π")),
           each("thickness", &Link::thickness, from(0.0, 1e6)),
           each("side_bend", &Link::side_bend, from(0.0, std::numbers::pi).in_words("0 to π")),
           each("gravity_factor", &Link::gravity_factor, up_to(1000.0))))
        .costs(cost)
        .allocates(Memory::scratch)
        .adds("4e10 links times steps, and 1 GB of what is kept, at most");
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const auto& times, const auto& poses, const auto& gravity, const auto& air, const auto& resets) {
            Shot given;
            given.times = times;
            given.poses = poses;
            given.gravity = gravity;
            given.air = air;
            given.resets = resets;
            if (times.size() != 3) given.sides.clear();
            return solved(Motion(sample_links(), given.inputs()));
        },
        arg("times", shot.times, rising().open(), at_least_many(1)),
        arg("poses", shot.poses, near.in_words("at most 1e9 in size"), rows),
        arg("gravity", shot.gravity, near.in_words("at most 1e9 in size"),
            {Size::Rule::any, 0, "none, one, or as many as `times`"}),
        arg("air", shot.air, near.in_words("at most 1e9 in size"),
            {Size::Rule::any, 0, "none, one, or as many as `times`"}),
        arg("resets", shot.resets,
            numbers("rising indices of times but the first", [](double x) { return x >= 1.0 && x < 3.0; })
                .open()))
        .costs(cost)
        .allocates(Memory::scratch);
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const auto& obstacles, const auto& obstacle_places, const auto& pinned, const auto& pin_places,
           const auto& pin_weights) {
            Shot given;
            given.obstacles = obstacles;
            given.obstacle_places = obstacle_places;
            given.pinned = pinned;
            given.pin_places = pin_places;
            given.pin_weights = pin_weights;
            return solved(Motion(sample_links(), given.inputs()));
        },
        of(shot.obstacles, each("radius", &Obstacle::radius, from(0.0, 1e6)),
           each("friction", &Obstacle::friction, from(0.0, 100.0))),
        arg("obstacle_places", shot.obstacle_places, near.in_words("at most 1e9 in size"), rows),
        arg("pinned", shot.pinned, index(3, "a link")),
        arg("pin_places", shot.pin_places, near.in_words("at most 1e9 in size"), rows),
        arg("pin_weights", shot.pin_weights, from(0.0, 1.0), rows))
        .costs(cost)
        .allocates(Memory::scratch);
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const auto& sides, double friction) {
            Shot given;
            given.sides = sides;
            given.friction = friction;
            return solved(Motion(sample_links(), given.inputs()));
        },
        arg("sides", shot.sides, near.in_words("at most 1e9 in size"),
            {Size::Rule::any, 0, "none, or as many as the poses"}),
        arg("friction", shot.friction, from(0.0, 100.0)))
        .costs("O(links log links times), with those that are near each other; squared where all are")
        .allocates(Memory::scratch);
    add(
        table, "strand::Surface::Surface(positions, triangles, executor)",
        [](const auto& positions, const auto& triangles) {
            Shot given;
            const Surface made(positions, triangles, 1);
            given.surfaces[0].surface = std::make_shared<const Surface>(made.positions(), triangles, 1);
            return solved(Motion(sample_links(), given.inputs()));
        },
        arg("positions", sample_positions(), any_at_rest("any; what is not finite is never met")),
        arg("triangles", sample_triangles(), index(5, "a vertex")))
        .costs("O(n log n)")
        .allocates(Memory::scratch);
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const auto& surfaces, const auto& matrices) {
            Shot given;
            given.surfaces = surfaces;
            given.surface_matrices = matrices;
            return solved(Motion(sample_links(), given.inputs()));
        },
        of(shot.surfaces, each("distance", &PlacedSurface::distance, from(0.0, 1e6)),
           each("friction", &PlacedSurface::friction, from(0.0, 100.0))),
        arg("surface_matrices", shot.surface_matrices,
            Domain{"turned, moved by at most 1e9 and scaled evenly by 1e-6 to 1e6; the last row is not read",
                   [](const Domain::Seen&) { return Verdict::open; }},
            rows))
        .costs(cost)
        .allocates(Memory::scratch);
    add(
        table, "strand::Motion::Motion(links, inputs, solving)",
        [](const Solving& solving) {
            Shot given;
            given.resets.clear();
            return solved(Motion(sample_links(), given.inputs(), solving));
        },
        of(Solving{.is_loop = true}, member("rate", &Solving::rate, from(60.0, 1e5)),
           member("settle", &Solving::settle, from(0.0, 1000.0)),
           member("cycles", &Solving::cycles, from(1.0, 1000.0))))
        .costs(cost)
        .allocates(Memory::scratch)
        .adds("in a loop: no resets, and two times at least");
}

void add_asking(Table& table) {
    add(table, "strand::Motion::solve(steps)",
        [] {
            Motion made(sample_links(), Shot().inputs());
            return made.solve(100);
        })
        .costs("O(links) a step")
        .allocates(Memory::scratch)
        .alone();
    static const Motion motion = [] {
        Motion made(sample_links(), Shot().inputs());
        made.solve(1000);
        return made;
    }();
    add(
        table, "strand::Motion::places(time, out)",
        [](double time, auto found) { motion.places(time, found); }, arg("time", 0.15, finite()),
        out<glm::dvec3>("out", 3, "links"))
        .costs("O(links), some 32 steps")
        .allocates(Memory::scratch);
    table.moved.push_back({"strand::Motion", "of no links, and solved", [] {
                               Motion from(sample_links(), Shot().inputs());
                               const Motion taken = std::move(from);
                               // NOLINTBEGIN(bugprone-use-after-move)
                               expect(from.size() == 0 && from.is_solved() && from.solve(10), "is empty");
                               from.places(0.0, {});
                               expect(from.bytes() == 0 && from.gap() == 0.0 && from.near_pairs() == 0,
                                      "has nothing");
                               // NOLINTEND(bugprone-use-after-move)
                               from = Motion(sample_links(), Shot().inputs());
                               expect(from.size() == 3 && taken.size() == 3, "is assigned");
                           }});
}

}  // namespace

void add_strand(Table& table) {
    add_making(table);
    add_asking(table);
}

}  // namespace motus::contracts
