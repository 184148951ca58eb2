#include <array>

#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/snow/cover.hpp"
#include "motus/snow/layer.hpp"
#include "motus/snow/marks.hpp"
#include "motus/snow/snow.hpp"

namespace motus::contracts {

template <Some<snow::Burst> T>
auto fields(Declared, T& v) {
    return std::tie(v.time, v.count);
}
template <Some<snow::GradientStop> T>
auto fields(Declared, T& v) {
    return std::tie(v.position, v.color);
}
template <Some<snow::Slide> T>
auto fields(Declared, T& v) {
    return std::tie(v.start, v.from, v.direction, v.speed, v.acceleration);
}
template <Some<snow::Collider::Hit> T>
auto fields(Declared, T& v) {
    return std::tie(v.triangle, v.part, v.point);
}
template <Some<snow::Collider::Place> T>
auto fields(Declared, T& v) {
    return std::tie(v.triangle, v.point);
}
template <Some<snow::Collider::Rest> T>
auto fields(Declared, T& v) {
    return std::tie(v.place, v.over);
}
template <Some<snow::Touchdown> T>
auto fields(Declared, T& v) {
    return std::tie(v.time, v.id, v.point, v.triangle);
}
template <Some<snow::SnowLayer::Mesh> T>
auto fields(Declared, T& v) {
    return std::tie(v.positions, v.depths, v.triangles, v.edges, v.sides);
}

namespace {

using namespace snow;

[[nodiscard]] SnowSettings sample_settings() {
    SnowSettings s;
    s.rate = 8.0;
    s.bursts = {{0.3, 4}};
    s.snow = true;
    s.gravity = true;
    s.drag = 0.5;
    s.wind_times = {0.0, 1.0};
    s.wind_values = {{0.1, 0.0, 0.0}, {0.0, 0.2, 0.0}};
    s.gusts = 0.2;
    s.turbulence = 0.3;
    s.tumble = 1.0;
    s.start_color = {{0.0F, glm::vec4(1.0F)}, {1.0F, glm::vec4(0.5F)}};
    s.emitter_times = {0.0, 1.0};
    s.emitter_matrices = {glm::dmat4(1.0), glm::dmat4(1.0)};
    s.emitter_matrices[0][3].z = s.emitter_matrices[1][3].z = 3.0;
    s.ground = -1.0;
    return s;
}
/// Which ends: where flakes land is found for 256 at a time, and here there are no more than 20.
[[nodiscard]] SnowSettings few_flakes() {
    SnowSettings s = sample_settings();
    s.looping = false;
    s.duration = 2.0;
    return s;
}
[[nodiscard]] std::vector<double> told(const Snow& snow, double time) {
    const Living living = snow.living(time, 1);
    std::vector<glm::vec3> positions(living.count()), velocities(living.count());
    std::vector<float> sizes(living.count());
    std::vector<glm::vec4> colors(living.count()), rotations(living.count());
    snow.evaluate(living,
                  {.position = positions,
                   .velocity = velocities,
                   .size = sizes,
                   .color = colors,
                   .rotation = rotations},
                  1);
    std::vector<double> all;
    const auto visit = [&](const auto& number) { all.push_back(static_cast<double>(number)); };
    each_number(positions, visit);
    each_number(velocities, visit);
    each_number(sizes, visit);
    each_number(colors, visit);
    each_number(rotations, visit);
    return all;
}
[[nodiscard]] std::shared_ptr<const Collider> sample_collider() {
    static const auto made = std::make_shared<const Collider>(sample_positions(), sample_triangles(), 1);
    return made;
}
[[nodiscard]] const Snow& sample_snow() {
    static const Snow made = [] {
        SnowSettings settings = sample_settings();
        settings.collider = sample_collider();
        return Snow(settings);
    }();
    return made;
}

void add_births(Table& table) {
    const std::vector<Burst> bursts{{0.3, 4}, {1.0, 5}};
    const auto counted = [](const Births& births) {
        return std::tuple(births.count(2.0), births.most_within(1.0), births.pieces().size());
    };
    add(
        table, "snow::Births::Births(rate, delay, duration, looping, bursts, keys)",
        [counted](double rate, double delay, double duration, const auto& given, const auto& times,
                  const auto& values) {
            return counted(Births(rate, delay, duration, false, given,
                                  {{times.begin(), times.end()}, {values.begin(), values.end()}}));
        },
        arg("rate", 5.0, at_least(0.0)), arg("delay", 0.5, at_least(0.0)),
        arg("duration", 5.0, at_least(0.0)),
        of(bursts, each("bursts", &Burst::time, at_least(0.0)),
           each("bursts", &Burst::count, from(0.0, 0x1p53).open())),
        arg("rate_times", std::vector{0.2, 1.0}, rising().open(), as_many_as("`rate_values`")),
        arg("rate_values", std::vector{3.0, 9.0}, at_least(0.0).open(), as_many_as("`rate_times`")))
        .costs("O(bursts log bursts + keys)")
        .allocates(Memory::scratch)
        .adds("bursts hold 2^53 flakes at most");
    static const Births births(5.0, 0.5, 5.0, false, bursts);
    add(
        table, "snow::Births::count(time)", [](double time) { return births.count(time); },
        arg("time", 1.0, any_at_rest("any; 0 for NaN")))
        .costs("O(log bursts)");
    add(
        table, "snow::Births::count_older(time, age)",
        [](double time, double age) { return births.count_older(time, age); },
        arg("time", 1.0, any_at_rest("any; 0 for NaN")), arg("age", 0.5, any_at_rest("any; 0 for NaN")))
        .costs("O(log bursts)");
    add(
        table, "snow::Births::streamed(j)", [](std::uint64_t j) { return births.streamed(j); },
        arg("j", std::uint64_t{3}, any_at_rest("any; infinite if the rate is 0")))
        .costs("O(1)")
        .infinite();
    add(
        table, "snow::Births::streamed(j, out)",
        [](std::uint64_t j) {
            std::array<double, 5> found{};
            births.streamed(j, found);
            return found;
        },
        arg("j", std::uint64_t{3}, any_at_rest("any; infinite if the rate is 0")))
        .costs("O(n)")
        .infinite();
    add(
        table, "snow::Births::most_within(length)", [](double length) { return births.most_within(length); },
        arg("length", 1.0, any().unbounded()))
        .costs("O(bursts)");
    table.moved.push_back({"snow::Births", "without bursts", [] {
                               Births from = births;
                               const Births taken = std::move(from);
                               (void)from.count(1.0);  // NOLINT(bugprone-use-after-move)
                               (void)from.most_within(1.0);
                               from = taken;
                               expect(from.count(9.0) == taken.count(9.0), "is assigned");
                           }});
}

void add_colliders(Table& table) {
    add(
        table, "snow::Collider::Collider(positions, triangles, executor)",
        [](const auto& positions, const auto& triangles) {
            return Collider(positions, triangles, 1).first_hit({0.3, 0.3, 5.0}, {0.3, 0.3, -5.0});
        },
        arg("collider_positions", sample_positions(), finite()),
        arg("collider_triangles", sample_triangles(), index(5, "a vertex")))
        .costs("O(n log n)")
        .allocates(Memory::scratch);
    const Domain finds = any_at_rest("any; where it is not finite nothing is met");
    add(
        table, "snow::Collider::first_hit(start, end)",
        [](const glm::dvec3& start, const glm::dvec3& end) {
            return sample_collider()->first_hit(start, end);
        },
        arg("start", glm::dvec3(0.3, 0.3, 5.0), finds), arg("end", glm::dvec3(0.3, 0.3, -5.0), finds))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    add(
        table, "snow::Collider::normal(triangle)",
        [](std::uint32_t triangle) { return sample_collider()->normal(triangle); },
        arg("triangle", 1U, index(3, "a triangle")))
        .costs("O(1)");
    add(
        table, "snow::Collider::below(point, direction)",
        [](const glm::dvec3& point, const glm::dvec3& direction) {
            return sample_collider()->below(point, direction);
        },
        arg("point", glm::dvec3(0.3, 0.3, 5.0), finds), arg("direction", glm::dvec3(0.0, 0.0, -1.0), finds))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    using Place = Collider::Place;
    add(
        table, "snow::Collider::slide(first, velocity, pull, friction, out)",
        [](const Place& first, const glm::dvec3& velocity, const glm::dvec3& pull, double friction) {
            std::vector<Slide> slides;
            const Collider::Rest rest = sample_collider()->slide(first, velocity, pull, friction, slides);
            return std::pair(rest, slides);
        },
        of(Place{0, false, {0.3, 0.3, 0.05}}, member("first", &Place::triangle, index(3, "a triangle")),
           member("first", &Place::point, finite().open())),
        arg("velocity", glm::dvec3(0.1, 0.2, 0.0), finite().open()),
        arg("pull", glm::dvec3(0.0, 0.0, -9.8), finite().open()), arg("friction", 0.1, at_least(0.0).open()))
        .costs("O(triangles passed), 64 at most")
        .allocates(Memory::scratch);
    Slide slide{0.0, glm::dvec3(1.0), {1.0, 0.0, 0.0}, 1.0, 0.5};
    add(
        table, "snow::Slide::position(time)", [slide](double time) { return slide.position(time); },
        arg("time", 0.5, any().unbounded()))
        .costs("O(1)");
    add(
        table, "snow::Slide::velocity(time)", [slide](double time) { return slide.velocity(time); },
        arg("time", 0.5, any().unbounded()))
        .costs("O(1)");
}

void add_snows(Table& table) {
    using S = SnowSettings;
    const Domain size = from(0.0, 1e30), single = finite().open().in_words("finite in single precision"),
                 some = from(0.0, 1000.0).open();
    add(
        table, "snow::Snow::Snow(settings)", [](const S& given) { return told(Snow(given), 0.6); },
        of(few_flakes(), member("start_speed", &S::start_speed, single),
           member("lifetime", &S::lifetime, size.open().tested_to(10.0)),
           member("start_size", &S::start_size, single),
           member("start_color", &S::start_color, single, at_least_many(1)),
           member("rate", &S::rate, at_least(0.0).open().tested_to(100.0)),
           member("delay", &S::delay, at_least(0.0).open()),
           member("duration", &S::duration, at_least(0.0).open()),
           member("cone_angle", &S::cone_angle, from(0.0, 3.14159265358979)),
           member("cone_radius", &S::cone_radius, size),
           member("frustum_angles", &S::frustum_angles,
                  numbers("0 to π / 2, without the end", [](double x) { return x >= 0.0 && x < 1.5707963; })),
           member("frustum_near", &S::frustum_near, from(0.0, 20.0).in_words("0 to `frustum_far`")),
           member("frustum_far", &S::frustum_far,
                  from(0.1, 1e30).in_words("1e-6 to 1e30, above `frustum_near`").open()),
           member("max_angle", &S::max_angle, up_to(1e6)),
           member("snow_frequency", &S::snow_frequency,
                  numbers("> 0 to 1000", [](double x) { return x > 0.0 && x <= 1000.0; }).open()),
           member("acceleration", &S::acceleration, single), member("drag", &S::drag, some),
           member("wind", &S::wind, single),
           member("wind_times", &S::wind_times, rising().open(), as_many_as("`wind_values`")),
           member("wind_values", &S::wind_values, single, as_many_as("`wind_times`")),
           member(
               "period", &S::period,
               numbers("0, or 1e-6 to 1e30", [](double x) { return x == 0.0 || (x >= 1e-6 && x <= 1e30); })),
           member("gusts", &S::gusts, size.open()),
           member("gust_frequency", &S::gust_frequency,
                  numbers("> 0 to 1000", [](double x) { return x > 0.0 && x <= 1000.0; }).open()),
           member("turbulence", &S::turbulence, from(0.0, 1e6)),
           member("turbulence_size", &S::turbulence_size, from(1e-6, 1e30)),
           member("tumble", &S::tumble, from(0.0, 1e6)), member("ground", &S::ground, single),
           member("rest_time", &S::rest_time, numbers("≥ 0, or infinity", [](double x) { return x >= 0.0; })),
           member("melt_time", &S::melt_time, size), member("friction", &S::friction, size),
           member("inherited", &S::inherited, single),
           member("emitter_times", &S::emitter_times, rising().open(), as_many_as("`emitter_matrices`")),
           member("emitter_matrices", &S::emitter_matrices, finite().open(), as_many_as("`emitter_times`"))))
        .costs("O(1), or a table of the steering")
        .allocates(Memory::scratch)
        .adds("1e8 living flakes at most; where numbers are as large as single precision is, flakes are, too")
        .infinite();
    const auto time = arg("time", 1.2, finite().tested_to(1e6));
    add(
        table, "snow::Snow::living(time, executor)",
        [](double at) { return sample_snow().living(at, 1).count(); }, time)
        .costs("O(n), and 10 µs a flake whose landing is not known")
        .allocates(Memory::scratch);
    add(
        table, "snow::Snow::known(time, executor)",
        [](double at) { return sample_snow().known(at, 1).count(); }, time)
        .costs("O(n)")
        .allocates(Memory::scratch);
    add(
        table, "snow::Snow::find_landings(time, most, executor)",
        [](double at, std::size_t most) { return sample_snow().find_landings(at, most, 1); }, time,
        arg("most", std::size_t{2}, any_at_rest("any")))
        .costs("10 µs a flake")
        .allocates(Memory::scratch);
    static const Living living = sample_snow().living(1.2, 1);
    add(
        table, "snow::Snow::evaluate(living, out, executor)",
        [](auto positions, auto sizes) {
            sample_snow().evaluate(living, {.position = positions, .size = sizes}, 1);
        },
        out<glm::vec3>("out", living.count(), "the living flakes, or none", true),
        out<float>("out", living.count(), "the living flakes, or none", true))
        .costs("O(n), 8 to 21 ms a million")
        .allocates(Memory::scratch)
        .adds("`living` is of the snow");
    add(
        table, "snow::Snow::touchdowns(end, executor)",
        [](double end) { return sample_snow().touchdowns(end, 1); }, arg("end", 1.2, finite().tested_to(1e3)))
        .costs("O(n log n), 10 µs a flake")
        .allocates(Memory::scratch)
        .adds("1e7 flakes at most");
    table.moved.push_back({"snow::Snow", "the snow that it was", [] {
                               Snow from = sample_snow();
                               const Snow taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.living(1.0, 1).count() == taken.living(1.0, 1).count(),
                                      "is the same");
                               from = taken;
                           }});
    table.moved.push_back({"snow::Living", "of no snow", [] {
                               Living from = living;
                               const Living taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.count() == 0 && from.time() == 0.0 && from.first() == 0 &&
                                          from.last() == 0,
                                      "is empty");
                               expect_refusal([&] { sample_snow().evaluate(from, {}, 1); });
                               from = taken;
                               expect(from.count() == living.count(), "is assigned");
                           }});
}

void add_marks(Table& table, const SnowLayer& layer) {
    using S = MarksSettings;
    static const std::vector<Mover> movers{{sample_collider(), {0.0}, {glm::dmat4(1.0)}}};
    const std::vector<double> times{0.0, 1.0};
    const std::vector<float> depths(5, 0.2F);
    add(
        table, "snow::Marks::Marks(layer, movers, times, heights, settings, executor)",
        [&layer](const auto& at, const auto& heights, const S& given) {
            const Marks made(layer, movers, at, heights, given, 1);
            std::vector<float> pressed(made.vertex_count());
            made.press(1.0, std::vector<float>(made.vertex_count(), 0.2F), {}, pressed);
            return pressed;
        },
        arg("times", times, rising()),
        arg("heights", std::vector<float>(10, 0.2F), at_least(0.0).open().tested_to(1e15),
            as_many_as("the vertices at all times")),
        of(S{}, member("packed", &S::packed, at_least(0.0)), member("step", &S::step, above(0.0))))
        .costs("O(looks log triangles)")
        .allocates(Memory::scratch)
        .adds("`movers` as those of `SnowSettings`; 10,000,000 looks at most");
    static const Marks marks(layer, movers, times, std::vector<float>(10, 0.2F), {}, 1);
    add(
        table, "snow::Marks::press(time, depths, shares, pressed)",
        [](double time, const auto& given, const auto& shares, auto pressed) {
            marks.press(time, given, shares, pressed);
        },
        arg("time", 1.0, finite()), arg("depths", depths, finite().open(), as_many_as("the vertices")),
        arg("shares", std::vector<float>(5, 0.5F), from(0.0, 1.0), as_many_or_none("the vertices")),
        out<float>("pressed", 5, "the vertices"))
        .costs("O(marked vertices)");
    table.moved.push_back({"snow::Marks", "of no vertices", [] {
                               Marks from = marks;
                               const Marks taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.vertex_count() == 0 && from.marked_count() == 0, "is empty");
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               from.press(0.0, {}, {}, {});
                               from = taken;
                               expect(from.vertex_count() == 5, "is assigned");
                           }});
}

void add_covers(Table& table) {
    using C = CoverSettings;
    add(
        table, "snow::steepest_slope(repose)", [](double repose) { return steepest_slope(repose); },
        arg("repose", 0.9, any().unbounded().in_words("0 to π / 2, not checked; NaN gives NaN")))
        .costs("O(1)");
    add(
        table, "snow::Cover::Cover(snow, settings, executor)",
        [](const C& given) {
            const Cover made(sample_snow(), given, 1);
            std::vector<float> heights(made.vertex_count());
            made.heights(1.0, heights, 1);
            return std::pair(heights, made.volume(1.0));
        },
        of(C{.end = 1.5}, member("end", &C::end, finite().open().tested_to(1e3)),
           member("flake_volume", &C::flake_volume,
                  numbers("> 0 to 1e30", [](double x) { return x > 0.0 && x <= 1e30; })),
           member("repose", &C::repose,
                  numbers("0 to π / 2, without the end", [](double x) { return x >= 0.0 && x < 1.5707963; })),
           member("smoothing", &C::smoothing, from(0.0, 1000.0))))
        .costs("O(n log n), 10 µs a flake")
        .allocates(Memory::scratch)
        .adds("`snow` has a collider")
        .infinite();
    static const Cover cover(sample_snow(), {.end = 1.5}, 1);
    add(
        table, "snow::Cover::heights(time, out, executor)",
        [](double time, auto heights) { cover.heights(time, heights, 1); }, arg("time", 1.0, finite()),
        out<float>("out", 5, "the vertices"))
        .costs("O(vertices (log flakes + rounds))")
        .allocates(Memory::scratch);
    add(
        table, "snow::Cover::volume(time)", [](double time) { return cover.volume(time); },
        arg("time", 1.0, finite()))
        .costs("O(log flakes)");
    add(table, "snow::Cover::restored(data)", [] { return Cover::restored(cover.bytes()).volume(1.0); })
        .costs("O(flakes + vertices)")
        .allocates(Memory::scratch)
        .adds("`data` is what `bytes()` gave");
    table.moved.push_back({"snow::Cover", "of no vertices", [] {
                               Cover from = cover;
                               const Cover taken = std::move(from);
                               // NOLINTBEGIN(bugprone-use-after-move)
                               expect(from.vertex_count() == 0 && from.areas().empty(), "is empty");
                               from.heights(1.0, {}, 1);
                               expect(from.volume(1.0) == 0.0, "has no snow");
                               // NOLINTEND(bugprone-use-after-move)
                               from = taken;
                               expect(from.vertex_count() == 5, "is assigned");
                           }});
    const glm::dvec3 up(0.0, 0.0, 1.0);
    const std::vector<float> depths(5, 0.1F);
    add(
        table, "snow::SnowLayer::SnowLayer(positions, triangles, up, shelter, hold, executor)",
        [](const auto& positions, const auto& triangles, const glm::dvec3& above, double hold) {
            const std::vector<float> deep(positions.size(), 0.1F);
            return SnowLayer(positions, triangles, above, sample_collider().get(), hold, 1)
                .at(deep, 0.01F, 1.0F);
        },
        arg("layer_positions", sample_positions(), finite().open()),
        arg("layer_triangles", sample_triangles(), index(5, "a vertex")), arg("up", up, direction()),
        arg("hold", 2.0, numbers("≥ 0, or infinity", [](double x) { return x >= 0.0; })))
        .costs("O(triangles)")
        .allocates(Memory::scratch)
        .infinite();
    static const SnowLayer layer(sample_positions(), sample_triangles(), up, nullptr,
                                 std::numeric_limits<double>::infinity(), 1);
    add(
        table, "snow::SnowLayer::at(depths, thinnest, steepest, left)",
        [](const auto& given, float thinnest, float steepest, const auto& left) {
            return layer.at(given, thinnest, steepest, left);
        },
        arg("depths", depths, finite().open().tested_to(1e15), as_many_as("the vertices")),
        arg("thinnest", 0.01F, at_least(0.0)),
        arg("steepest", 1.0F, numbers("> 0, or infinity", [](double x) { return x > 0.0; })),
        arg("left", std::vector<float>(5, 0.5F), at_least(0.0).open().tested_to(1e15),
            as_many_or_none("the vertices")))
        .costs("O(triangles)")
        .allocates(Memory::scratch);
    table.moved.push_back({"snow::SnowLayer", "of no vertices", [] {
                               SnowLayer from = layer;
                               const SnowLayer taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.vertex_count() == 0 && from.at({}, 0.0F, 1.0F).positions.empty(),
                                      "is empty");
                               from = taken;
                               expect(from.vertex_count() == 5, "is assigned");
                           }});
    add_marks(table, layer);
}

}  // namespace

void add_snow(Table& table) {
    add_births(table);
    add_colliders(table);
    add_snows(table);
    add_covers(table);
}

}  // namespace motus::contracts
