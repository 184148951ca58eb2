// Results that docs/library.md says to be the same bits by all compilers that it names: each is compared with
// one number, a hash that was computed once. The tests run this for an older processor as well.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "motus/bones/layers/transform.hpp"
#include "motus/colour/screen.hpp"
#include "motus/curve/curve.hpp"
#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/spherical_pendulum.hpp"
#include "motus/lattice/lattice.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "motus/noise/noise.hpp"
#include "motus/sculpt/pull.hpp"
#include "motus/snow/collider.hpp"
#include "motus/snow/snow.hpp"
#include "motus/strand/motion.hpp"
#include "motus/walker/walker.hpp"
#include "random.hpp"

using namespace motus;

namespace {

/// FNV-1a over the bits of numbers.
class Bits {
  public:
    void add(std::uint64_t number) {
        for (int byte = 0; byte < 8; ++byte)
            hash_ = (hash_ ^ (number >> (8 * byte) & 0xffU)) * 0x100000001b3U;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
    template <int Size, class Number>
    void add(const glm::vec<Size, Number>& numbers) {
        for (int i = 0; i < Size; ++i) add(numbers[i]);
    }
    void add(const glm::dquat& q) {
        for (const double part : {q.w, q.x, q.y, q.z}) add(part);
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// Waves of parabolas, for which no sine is needed: a grid of vertices 0.25 m apart, `side` each way.
struct Hills {
    static constexpr int side = 25;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;

    Hills() {
        const auto wave = [](int i) { return static_cast<float>((i % 8) * (8 - i % 8)) / 16.0F - 0.5F; };
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                positions.emplace_back(0.25F * static_cast<float>(column - side / 2),
                                       0.25F * static_cast<float>(row - side / 2),
                                       0.3F * wave(row) * wave(column + 3));
                if (row + 1 == side || column + 1 == side) continue;
                const int corner = row * side + column;
                triangles.emplace_back(corner, corner + 1, corner + side + 1);
                triangles.emplace_back(corner, corner + side + 1, corner + side);
            }
        }
    }
};

}  // namespace

TEST_CASE("noise has the same bits everywhere", "[same_bits]") {
    test::Random random(1);
    Bits bits;
    std::vector<glm::vec3> places(1000);
    for (glm::vec3& place : places) place = random.in_cube(100.0F);
    std::vector<float> values(places.size());
    noise::values(places, 3, values);
    for (const float value : values) bits.add(value);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 place = random.in_cube(1e4);
        bits.add(noise::value(place, 5));
        bits.add(noise::gradient(place, 5));
        bits.add(noise::value(place.x, 6));
        bits.add(noise::gradient(glm::dvec2(place), 7));
    }
    CHECK(bits.hash() == 0x4ed0d0e19e01d209U);
}

TEST_CASE("places, derivatives and tangents on curves have the same bits everywhere", "[same_bits]") {
    test::Random random(2);
    Bits bits;
    for (const int degree : {1, 2, 3, 5}) {
        std::vector<glm::dvec3> points(3 * (static_cast<std::size_t>(degree) + 1));
        for (glm::dvec3& point : points) point = random.in_cube(10.0);
        const curve::Curve curve = curve::Curve::chain(degree, points, false);
        for (int i = 0; i <= 100; ++i) {
            const double t = 0.03 * i;
            bits.add(curve::position(curve, t));
            bits.add(curve::tangent(curve, t));
            for (const int order : {1, 2, 3}) bits.add(curve::derivative(curve, t, order));
        }
    }
    CHECK(bits.hash() == 0xb53e0512b23c32c9U);
}

TEST_CASE("meshes are picked from and measured with the same bits everywhere", "[same_bits]") {
    const Hills hills;
    Bits bits;
    const mesh::Picker picker(hills.positions, hills.triangles);
    test::Random random(3);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 origin = random.in_cube(2.0) + glm::dvec3(0.0, 0.0, 5.0);
        const auto hit = picker.ray(origin, random.in_cube(0.4) - glm::dvec3(0.0, 0.0, 1.0));
        bits.add(std::uint64_t{hit.has_value() ? 1U : 0U});
        if (hit) {
            bits.add(std::uint64_t{hit->triangle});
            bits.add(hit->distance);
        }
    }
    const auto neighbours = mesh::Neighbours::of_triangles(hills.positions.size(), hills.triangles);
    const mesh::Reach reach = mesh::surface_reach(hills.positions, neighbours, 312, 2.5F);
    for (std::size_t i = 0; i < reach.vertices.size(); ++i) {
        bits.add(std::uint64_t{reach.vertices[i]});
        bits.add(reach.distances[i]);
    }
    CHECK(bits.hash() == 0xf951923a45b1850cU);
}

TEST_CASE("pulls have the same bits everywhere", "[same_bits]") {
    const Hills hills;
    Bits bits;
    using sculpt::Falloff;
    for (const Falloff falloff : {Falloff::classic, Falloff::smooth, Falloff::sphere, Falloff::root,
                                  Falloff::linear, Falloff::sharp, Falloff::gaussian}) {
        sculpt::Dab dab;
        dab.root = {0.3F, 0.1F, 0.0F};
        dab.displacement = {0.1F, -0.2F, 0.7F};
        dab.radius = 1.7F;
        dab.mirror = 1;
        dab.profile.falloff = falloff;
        std::vector<glm::vec3> moved(hills.positions.size());
        sculpt::pull(hills.positions, dab, {}, moved);
        for (const glm::vec3& place : moved) bits.add(place);
    }
    CHECK(bits.hash() == 0xce37a42a9e7f8aceU);
}

TEST_CASE("lattices deform with the same bits everywhere", "[same_bits]") {
    const Hills hills;
    test::Random random(4);
    Bits bits;
    using lattice::Basis;
    for (const Basis basis :
         {Basis::bernstein, Basis::linear, Basis::cardinal, Basis::catmull_rom, Basis::bspline}) {
        lattice::Lattice lattice;
        lattice.origin = {-3.0, -3.0, -1.0};
        lattice.axes = glm::dmat3(6.0, 0.0, 0.0, 0.0, 6.0, 0.0, 0.0, 0.0, 2.0);
        lattice.resolution = {4, 5, 3};
        lattice.basis = {basis, basis, basis};
        std::vector<glm::vec3> moves(lattice::point_count(lattice)), moved(hills.positions.size());
        for (glm::vec3& move : moves) move = random.in_cube(0.5F);
        lattice::deform(lattice, moves, {}, hills.positions, moved);
        for (const glm::vec3& place : moved) bits.add(place);
    }
    CHECK(bits.hash() == 0x00dff5ff1fe22f3aU);
}

TEST_CASE("flakes fly, turn and land with the same bits everywhere", "[same_bits]") {
    const Hills hills;
    snow::SnowSettings settings;
    settings.rate = 200.0;
    settings.lifetime = 8.0;
    settings.start_speed = 1.0;
    settings.cone_radius = 2.0;
    settings.random_speed = settings.random_orientation = settings.random_size = true;
    settings.cone_angle = 0.4;
    settings.snow = settings.snow_offsets = true;
    settings.gravity = true;
    settings.drag = 1.5;
    settings.wind = {0.5, 0.2, 0.0};
    settings.gusts = 0.4;
    settings.turbulence = 0.5;
    settings.tumble = 3.0;
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {glm::dmat4{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 4, 1}};
    settings.collider = std::make_shared<const snow::Collider>(hills.positions, hills.triangles);
    Bits bits;
    for (const snow::Collision collision :
         {snow::Collision::stay, snow::Collision::slide, snow::Collision::melt}) {
        settings.collision = collision;
        const snow::Snow snow(settings);
        const snow::Living living = snow.living(12.34);
        std::vector<glm::vec3> positions(living.count()), velocities(living.count());
        std::vector<glm::vec4> rotations(living.count());
        std::vector<float> sizes(living.count());
        snow.evaluate(living,
                      {.position = positions, .velocity = velocities, .size = sizes, .rotation = rotations});
        for (std::size_t i = 0; i < living.count(); ++i) {
            bits.add(positions[i]);
            bits.add(velocities[i]);
            bits.add(rotations[i]);
            bits.add(sizes[i]);
        }
    }
    CHECK(bits.hash() == 0xf2d20098421e26c3U);
}

TEST_CASE("feet walk with the same bits everywhere", "[same_bits]") {
    const Hills hills;
    walker::Way way;
    for (int sample = 0; sample <= 96; ++sample) {
        const double time = sample / 24.0;
        way.times.push_back(time);
        way.poses.push_back(
            glm::dmat4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1 * time * (2.0 - time), time - 2.0, 0, 1});
    }
    for (const double y : {0.5, 0.0, -0.5})
        for (const double x : {-0.6, 0.6}) way.rest.emplace_back(x, y, 0.0);
    way.phases = {0.0, 0.5, 0.5, 0.0, 0.0, 0.5};
    way.duty = 0.6;
    way.stride = 0.5;
    const walker::Ground ground(hills.positions, hills.triangles, std::nullopt);
    const walker::Walker walker(way, {}, &ground);
    Bits bits;
    for (int frame = 0; frame <= 100; ++frame) {
        for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
            const walker::Foot foot = walker.foot(leg, frame / 25.0);
            bits.add(foot.position);
            bits.add(foot.normal);
        }
    }
    CHECK(bits.hash() == 0xa793a724323e976fU);
}

TEST_CASE("double pendulums have the same bits everywhere", "[same_bits]") {
    const dynamics::DoublePendulum pendulum{.mass1 = 2.0, .mass2 = 1.0, .length1 = 1.0, .length2 = 0.7};
    std::vector<double> times;
    for (int i = 0; i <= 300; ++i) times.push_back(0.2 * i);
    std::vector<dynamics::DoublePendulumState> states(times.size());
    dynamics::double_pendulum(pendulum, {.theta1 = 2.0, .theta2 = 2.5}, times, states);
    Bits bits;
    for (const dynamics::DoublePendulumState& state : states)
        for (const double number : {state.theta1, state.theta2, state.omega1, state.omega2}) bits.add(number);
    CHECK(bits.hash() == 0x06b0611eda9e1dbcU);
}

TEST_CASE("spherical pendulums have the same bits everywhere", "[same_bits]") {
    std::vector<double> times;
    for (int i = 0; i <= 300; ++i) times.push_back(0.2 * i);
    std::vector<dynamics::SphericalState> states(times.size());
    dynamics::spherical_pendulum({.length = 1.2, .damping = 0.01},
                                 {.angle = 2.0, .heading = 0.3, .velocity = 0.5, .across = 1.5}, times,
                                 states);
    Bits bits;
    for (const dynamics::SphericalState& state : states) {
        bits.add(state.direction);
        bits.add(state.velocity);
    }
    CHECK(bits.hash() == 0x6f09fe0ea6c64627U);
}

TEST_CASE("strands have the same bits everywhere", "[same_bits]") {
    using namespace strand;
    // Two chains on a way of parabolas, with a branch, a spring, a pin that comes and goes, a ball and a
    // floor.
    const Link link{.frequency = 0.7, .response = 0.5, .drag = 0.4, .stretch = 0.01, .thickness = 0.05};
    std::vector<Link> links(9, link);
    const std::array parents{-1, 0, 1, 2, 1, -1, 5, 6, 7};
    for (std::size_t i = 0; i < links.size(); ++i) links[i].parent = parents[i];
    std::vector<double> times, pin_weights;
    std::vector<glm::dvec3> poses, obstacle_places, pin_places;
    for (int k = 0; k <= 96; ++k) {
        const double time = k / 48.0;
        times.push_back(time);
        const glm::dvec3 body(time * (2.0 - time), 0.0, 1.0 + 0.5 * time * (1.0 - time));
        for (const glm::dvec3& rest : {glm::dvec3(0, 0, 0),
                                       {0.2, 0, 0},
                                       {0.4, 0, 0},
                                       {0.6, 0, 0},
                                       {0.2, 0.3, 0.1},
                                       {0, 1, 0},
                                       {0.3, 1, 0},
                                       {0.6, 1, 0},
                                       {0.9, 1, 0}})
            poses.push_back(body + rest);
        obstacle_places.insert(obstacle_places.end(),
                               {{0.6, 0, 0.5}, {0.6, 0.4, 0.5}, {0, 0, 0.3}, {0, 0, 1}});
        pin_places.emplace_back(0.5, 1.0, 1.2);
        pin_weights.push_back(0.25 * (k / 24));
    }
    const std::vector<glm::dvec3> gravity{{0, 0, -9.81}}, air{{0, 2, 0}};
    const std::vector<Obstacle> obstacles{{Obstacle::Shape::capsule, 0.2, 0.4},
                                          {Obstacle::Shape::plane, 0.0, 0.6}};
    const std::vector<std::size_t> pinned{8};
    Motion motion(
        links,
        {times, poses, gravity, air, obstacles, obstacle_places, {}, {}, pinned, pin_places, pin_weights},
        {.settle = 0.5});
    motion.solve(100000);
    Bits bits;
    std::vector<glm::dvec3> places(links.size());
    for (int frame = 0; frame <= 50; ++frame) {
        motion.places(frame / 25.0, places);
        for (const glm::dvec3& place : places) bits.add(place);
    }
    CHECK(bits.hash() == 0x054b38016bda616bU);
}

TEST_CASE("strands that touch each other have the same bits everywhere", "[same_bits]") {
    using namespace strand;
    // Four chains side by side fall upon each other.
    const Link link{.frequency = 0.3, .drag = 0.4, .thickness = 0.06};
    std::vector<Link> links(20, link);
    for (std::size_t i = 0; i < links.size(); ++i)
        links[i].parent = i % 5 == 0 ? -1 : static_cast<int>(i) - 1;
    std::vector<double> times;
    std::vector<glm::dvec3> poses;
    for (int k = 0; k <= 48; ++k) {
        const double time = k / 48.0;
        times.push_back(time);
        for (int i = 0; i < 20; ++i) {
            const double chain = i / 5, part = i % 5;  // NOLINT(bugprone-integer-division): of whole chains
            poses.emplace_back(0.2 * part, 0.3 * chain * (1.0 - time), 0.15 * chain + time * (1.0 - time));
        }
    }
    const std::vector<glm::dvec3> gravity{{0, 0, -9.81}};
    Motion motion(links, {.times = times, .poses = poses, .gravity = gravity, .are_touching = true});
    motion.solve(100000);
    Bits bits;
    std::vector<glm::dvec3> places(links.size());
    for (int frame = 0; frame <= 25; ++frame) {
        motion.places(frame / 25.0, places);
        for (const glm::dvec3& place : places) bits.add(place);
    }
    CHECK(bits.hash() == 0x1a8faa3251e9d611U);
}

TEST_CASE("transforms are laid over each other with the same bits everywhere", "[same_bits]") {
    using namespace bones::layers;
    test::Random random(5);
    Bits bits;
    const auto some = [&random] {
        Transform transform;
        transform.location = random.in_cube(3.0);
        const glm::dvec3 axis = random.in_cube(1.0);
        const double w = random.between(-1.0, 1.0);
        const double length = std::sqrt(w * w + glm::dot(axis, axis));
        transform.rotation = glm::dquat(w / length, axis / length);
        transform.scale = random.in_cube(0.5) + 1.0;
        return transform;
    };
    for (int i = 0; i < 200; ++i) {
        const Transform base = some(), source = some(), reference = some();
        const double weight = random.between(0.0, 1.0);
        for (const Transform& found : {overridden(base, source, weight, location | rotation | scale),
                                       added(base, source, reference, weight, location | rotation | scale),
                                       between_transforms(base, source), transform_of(matrix_of(base))}) {
            bits.add(found.location);
            bits.add(found.rotation);
            bits.add(found.scale);
        }
    }
    CHECK(bits.hash() == 0x3358de35a3b17f55U);
}

TEST_CASE("a screen is found and keyed with the same bits everywhere", "[same_bits]") {
    test::Random random(6);
    std::vector<glm::vec4> pixels(64 * 48);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool is_screen = i % 64 < 40;
        const glm::vec3 noise = random.in_cube(0.03F);
        pixels[i] = glm::vec4(glm::vec3(0.5F, 0.4F, 0.3F) + noise, 1.0F);
        if (is_screen) pixels[i] = glm::vec4(glm::vec3(0.1F, 0.6F, 0.15F) + noise, 1.0F);
    }
    const colour::Picture picture{pixels, 64};
    const auto screen = colour::screen_color(picture);
    REQUIRE(screen.has_value());
    Bits bits;
    bits.add(*screen);
    const colour::ScreenQuality quality = colour::judge_screen(picture, *screen);
    for (const double number : {quality.share, quality.luminance_spread, quality.chroma_spread, quality.spill,
                                quality.black, quality.white})
        bits.add(number);
    for (const glm::vec4& pixel : pixels) bits.add(colour::matte(glm::dvec3(pixel), *screen));
    CHECK(bits.hash() == 0x708489cec591cebbU);
}
