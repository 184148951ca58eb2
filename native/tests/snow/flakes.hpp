// What the tests of flakes share.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "motus/snow/snow.hpp"

namespace motus::snow {

struct Flakes {
    explicit Flakes(std::size_t count)
        : position(count),
          velocity(count),
          size(count),
          age(count),
          color(count),
          rotation(count),
          id(count) {}
    [[nodiscard]] Fields fields() { return {position, velocity, size, color, age, rotation, id}; }

    std::vector<glm::vec3> position, velocity;
    std::vector<float> size, age;
    std::vector<glm::vec4> color, rotation;
    std::vector<std::int64_t> id;
};

[[nodiscard]] inline Flakes flakes_at(const Snow& snow, double time, std::size_t threads = 1) {
    const Living living = snow.living(time, threads);
    Flakes flakes(living.count());
    snow.evaluate(living, flakes.fields(), threads);
    return flakes;
}

template <class T>
[[nodiscard]] bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

[[nodiscard]] inline bool are_same(const Flakes& a, const Flakes& b) {
    return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
           same_bits(a.size, b.size) && same_bits(a.age, b.age) && same_bits(a.color, b.color) &&
           same_bits(a.rotation, b.rotation) && same_bits(a.id, b.id);
}

/// Everything at once.
[[nodiscard]] inline SnowSettings rich(double rate) {
    SnowSettings s;
    s.rate = rate;
    s.delay = 0.3;
    s.lifetime = 2.5;
    s.bursts = {{0.5, 300}, {1.7, 77}};
    s.start_color = {{0.0F, {1.0F, 0.0F, 0.0F, 1.0F}}, {1.0F, {0.0F, 1.0F, 0.0F, 0.5F}}};
    s.cone_angle = 0.6;
    s.random_speed = s.random_orientation = s.random_lifetime = s.random_size = s.random_color = true;
    s.snow = s.gravity = true;
    s.drag = 0.7;
    s.wind = {1.0, -0.5, 0.2};
    s.gusts = 0.5;
    s.turbulence = 0.8;
    s.tumble = 3.0;
    s.seed = 12345678901U;
    s.emitter_times = {0.0, 1.0, 2.5};
    for (const double at : s.emitter_times)
        s.emitter_matrices.push_back(glm::translate(glm::dmat4(1.0), glm::dvec3(at, 0.0, 3.0)) *
                                     glm::rotate(glm::dmat4(1.0), at, glm::dvec3(1.0, 0.2, 0.0)));
    return s;
}

/// Flakes of several shapes that fly in several ways.
[[nodiscard]] inline std::array<SnowSettings, 4> kinds(double rate) {
    std::array<SnowSettings, 4> all{rich(rate), rich(rate), rich(rate), rich(rate)};
    all[1].snow = false;
    all[1].shape = Shape::sphere;
    all[2].snow_offsets = true;
    all[2].shape = Shape::cone;
    all[3] = SnowSettings{};
    all[3].rate = rate;
    return all;
}

}  // namespace motus::snow
