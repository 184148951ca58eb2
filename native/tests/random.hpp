// Random numbers for tests and benchmarks, the same from every compiler and standard library: the standard
// says what its engines give, but neither what its distributions do nor in which order two arguments are
// evaluated. So whoever draws twice in one expression writes braces, or two statements.
// SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators" (2014).
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>

namespace motus::test {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t mixed = state_;
        mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
        mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
        return mixed ^ (mixed >> 31U);
    }

    /// In [low, high).
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53);
    }
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(bits() >> 40U) * 0x1p-24f);
    }
    bool chance(double share) { return between(0.0, 1.0) < share; }
    /// 0 to count - 1.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    /// low to high, both included.
    int whole(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::size_t>(high - low) + 1));
    }
    /// A number of mean 0 and deviation 1, nearly normal: the sum of twelve numbers, which needs no
    /// logarithm. At most 6.
    double normal() {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) sum += between(0.0, 1.0);
        return sum;
    }

    /// Anywhere in the cube from -size to size.
    glm::dvec3 in_cube(double size = 1.0) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    glm::vec3 in_cube(float size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    /// Three normal numbers.
    glm::dvec3 around_origin(double size = 1.0) {
        return {size * normal(), size * normal(), size * normal()};
    }
    /// Every direction alike.
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 point = in_cube();
            const double square = glm::dot(point, point);
            if (square > 0.01 && square <= 1.0) return point / std::sqrt(square);
        }
    }
    /// A place at a distance from `low` to `high` in any direction.
    glm::dvec3 at_distance(double low, double high) {
        const double distance = between(low, high);
        return distance * direction();
    }
    /// A rotation by this angle about any axis.
    glm::dquat turn(double angle) { return glm::angleAxis(angle, direction()); }
    /// A rotation by an angle of up to `most` about any axis.
    glm::dquat rotation(double most) {
        const double angle = between(-most, most);
        return turn(angle);
    }
    /// Every rotation alike, nearly.
    glm::dquat any_rotation() {
        const glm::dvec3 vector = around_origin();
        return glm::normalize(glm::dquat(normal(), vector.x, vector.y, vector.z));
    }

    template <class T>
    void shuffle(std::span<T> values) {
        for (std::size_t left = values.size(); left > 1; --left)
            std::swap(values[left - 1], values[below(left)]);
    }

  private:
    std::uint64_t state_;
};

}  // namespace motus::test
