// Snow of any settings on any small mesh: flakes are at finite places unless their numbers overflow, and what
// lies has a finite height and all of the volume.
#include "motus/snow/snow.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "bytes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/snow/cover.hpp"
#include "motus/snow/layer.hpp"
#include "reads_mesh.hpp"
#include "targets.hpp"

namespace motus::fuzzers {

using namespace snow;

namespace {

/// What flies, some 100 flakes at a time as a rule.
SnowSettings settings_of(Bytes& bytes) {
    SnowSettings s;
    s.start_speed = bytes.number(-4.0, 4.0);
    s.lifetime = bytes.number(0.0, 4.0);
    s.start_size = bytes.number();
    s.rate = bytes.number(0.0, 30.0);
    s.delay = bytes.number(0.0, 1.0);
    s.duration = bytes.number(0.0, 5.0);
    s.looping = bytes.flag();
    for (std::size_t left = bytes.count(2); left > 0; --left)
        s.bursts.push_back({bytes.number(0.0, 2.0), bytes.byte()});
    s.shape = bytes.choice<Shape>(7);
    s.surface_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.surface_triangles = {{0, 1, 2}};
    s.frustum_angles = {bytes.number(0.0, 1.6), bytes.number(0.0, 1.6)};
    s.frustum_near = bytes.number(0.0, 1.0);
    s.frustum_far = bytes.number(0.0, 9.0);
    s.cone_angle = bytes.number(0.0, 3.2);
    s.cone_radius = bytes.number(0.0, 3.0);
    const std::uint8_t random = bytes.byte();
    s.random_speed = (random & 1U) != 0;
    s.random_orientation = (random & 2U) != 0;
    s.random_lifetime = (random & 4U) != 0;
    s.random_size = (random & 8U) != 0;
    s.snow = (random & 16U) != 0;
    s.snow_offsets = (random & 32U) != 0;
    s.gravity = (random & 64U) != 0;
    s.seed = bytes.byte();
    s.collision = bytes.choice<Collision>(3);
    s.emitter_times = {0.0};
    s.emitter_matrices = {glm::dmat4(1.0)};
    s.emitter_matrices[0][3] = glm::dvec4(bytes.place(), 1.0);
    return s;
}

/// What acts on it in the air and where it has landed.
void add_air(Bytes& bytes, SnowSettings& s) {
    s.max_angle = bytes.number();
    s.snow_frequency = bytes.number(0.1, 3.0);
    s.acceleration = bytes.place(10.0);
    s.drag = bytes.number(0.0, 3.0);
    s.wind = bytes.place();
    if (bytes.flag()) {
        s.wind_times = {bytes.number(-1.0, 1.0), bytes.number(1.0, 3.0)};
        s.wind_values = {bytes.place(), bytes.place()};
    }
    s.gusts = bytes.number(0.0, 1.0);
    s.gust_frequency = bytes.number(0.1, 2.0);
    s.turbulence = bytes.number(0.0, 2.0);
    s.turbulence_size = bytes.number(0.1, 2.0);
    s.tumble = bytes.number(0.0, 9.0);
    if (bytes.flag()) s.ground = bytes.number();
    if (bytes.flag()) s.rest_time = bytes.number(0.0, 2.0);
    s.melt_time = bytes.number(0.0, 2.0);
    s.friction = bytes.number(0.0, 2.0);
}

/// Flakes that are born until a time, at most: more than a few take too long to try many.
bool are_few(const SnowSettings& s, double until) {
    return s.rate * until < 300.0 && s.lifetime < 20.0 && s.snow_frequency < 100.0;
}

std::vector<glm::vec3> places_at(const Snow& snow, double time) {
    const Living living = snow.living(time, 1);
    std::vector<glm::vec3> places(living.count());
    std::vector<float> ages(living.count()), sizes(living.count());
    std::vector<glm::vec4> rotations(living.count());
    snow.evaluate(living, {.position = places, .size = sizes, .age = ages, .rotation = rotations}, 1);
    for (const float age : ages) expect(std::isfinite(age) && age >= 0.0F, "age: finite, not below 0");
    return places;
}

/// The same places, whatever was asked for before.
void fly(const SnowSettings& settings, double time, double other) {
    const Snow snow(settings), anew(settings);
    (void)places_at(snow, other);
    const std::vector<glm::vec3> places = places_at(snow, time), again = places_at(anew, time);
    expect(places.size() == again.size(), "living: the same in any order");
    for (std::size_t i = 0; i < places.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            expect(places[i][axis] == again[i][axis] ||
                       (std::isnan(places[i][axis]) && std::isnan(again[i][axis])),
                   "position: the same bits in any order");
}

void lie(Bytes& bytes, const SnowSettings& settings, const Mesh& mesh, double end) {
    const Snow snow(settings);
    const CoverSettings how{end, bytes.number(0.0, 1e-3), bytes.number(0.0, 1.6), bytes.whole(-1, 3)};
    const Cover cover(snow, how, 1);
    std::vector<float> heights(cover.vertex_count());
    cover.heights(end, heights, 1);
    for (const float height : heights) expect(std::isfinite(height) && height >= 0.0F, "heights: finite");
    const SnowLayer layer(mesh.positions, mesh.triangles, -settings.acceleration, settings.collider.get());
    const SnowLayer::Mesh lying = layer.at(heights, bytes.single(0.0, 0.1), bytes.single(0.0, 2.0));
    for (const glm::vec3& position : lying.positions) expect(is_finite(position), "layer: finite places");
    for (const glm::ivec3& triangle : lying.triangles)
        for (int i = 0; i < 3; ++i)
            expect(triangle[i] >= 0 && static_cast<std::size_t>(triangle[i]) < lying.positions.size(),
                   "layer: triangles of vertices that there are");
}

}  // namespace

void try_snow(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    SnowSettings settings = settings_of(bytes);
    if (bytes.flag()) add_air(bytes, settings);
    const double time = bytes.number(0.0, 6.0), other = bytes.number(0.0, 6.0);
    const Mesh mesh(bytes);
    returns([&] { settings.collider = std::make_shared<const Collider>(mesh.positions, mesh.triangles, 1); });
    if (!are_few(settings, std::max(time, other))) return;
    returns([&] { fly(settings, time, other); });
    returns([&] { lie(bytes, settings, mesh, time); });
}

}  // namespace motus::fuzzers
