// Numbers that formulas do not expect, and what may come of them: a result, or an exception that names the
// argument.
#pragma once
#include <catch2/catch.hpp>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "extreme_numbers.hpp"
#include "random.hpp"

namespace motus::test {

/// Draws ordinary numbers, and extremes among them.
class Dice : public Random {
  public:
    /// share: of extremes.
    Dice(std::uint64_t seed, double share) : Random(seed), share_(share) {}

    [[nodiscard]] double number(double low = -3.0, double high = 3.0) {
        if (chance(share_)) return extremes.at(below(extremes.size()));
        return between(low, high);
    }
    [[nodiscard]] float single(double low = -3.0, double high = 3.0) {
        const double drawn = number(low, high);
        constexpr double most = std::numeric_limits<float>::max();
        if (drawn > most) return std::numeric_limits<float>::infinity();
        if (drawn < -most) return -std::numeric_limits<float>::infinity();
        return static_cast<float>(drawn);
    }
    [[nodiscard]] glm::dvec3 place() {
        const double x = number(), y = number();
        return {x, y, number()};
    }
    [[nodiscard]] glm::vec3 single_place() {
        const float x = single(), y = single();
        return {x, y, single()};
    }
    /// A rotation, seldom none.
    [[nodiscard]] glm::dquat quaternion() {
        if (!chance(share_)) return any_rotation();
        const double w = number(), x = number(), y = number();
        return {w, x, y, number()};
    }
    [[nodiscard]] glm::dmat4 matrix() {
        glm::dmat4 result = glm::mat4_cast(any_rotation());
        result[3] = glm::dvec4(place(), 1.0);
        if (chance(share_)) result[whole(0, 2)][whole(0, 2)] = number();
        if (chance(0.1)) result[whole(0, 2)] = glm::dvec4(0.0);
        return result;
    }
    [[nodiscard]] std::vector<double> numbers(std::size_t count, double low = -3.0, double high = 3.0) {
        std::vector<double> all(count);
        for (double& one : all) one = number(low, high);
        return all;
    }
    /// Rising, but for extremes.
    [[nodiscard]] std::vector<double> rising(std::size_t count) {
        std::vector<double> all(count);
        double next = between(-1.0, 1.0);
        for (double& one : all) {
            next += between(0.01, 1.0);
            one = chance(0.2 * share_) ? number() : next;
        }
        return all;
    }
    [[nodiscard]] std::vector<glm::dvec3> places(std::size_t count) {
        std::vector<glm::dvec3> all(count);
        for (glm::dvec3& one : all) one = place();
        return all;
    }
    [[nodiscard]] std::vector<glm::vec3> single_places(std::size_t count) {
        std::vector<glm::vec3> all(count);
        for (glm::vec3& one : all) one = single_place();
        return all;
    }
    [[nodiscard]] std::vector<glm::dquat> quaternions(std::size_t count) {
        std::vector<glm::dquat> all(count);
        for (glm::dquat& one : all) one = quaternion();
        return all;
    }
    [[nodiscard]] std::vector<float> matrices(std::size_t count) {
        std::vector<float> all;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dmat4 one = matrix();
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row) all.push_back(static_cast<float>(one[column][row]));
        }
        return all;
    }

  private:
    double share_;
};

/// Whether a call returns. What it throws instead is std::invalid_argument, and names an argument.
template <class Call>
bool returns(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& problem) {
        CAPTURE(problem.what());
        CHECK(names_an_argument(problem.what()));
        return false;
    }
    return true;
}

/// Whether a call is refused by std::invalid_argument that begins with the argument's name.
template <class Call>
bool is_refused(const Call& call, std::string_view argument) {
    try {
        call();
    } catch (const std::invalid_argument& problem) {
        CAPTURE(problem.what());
        const std::string_view message = problem.what();
        return message.substr(0, message.find(": ")) == argument;
    }
    return false;
}

}  // namespace motus::test
