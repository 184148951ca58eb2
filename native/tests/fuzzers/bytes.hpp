// Bytes, as a fuzzer gives them, read as the arguments of functions: any bytes are some arguments, and those
// that differ little are arguments that differ little, by which a fuzzer finds its way.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "extreme_numbers.hpp"

namespace motus::fuzzers {

/// Where the bytes have ended, all that is read is 0.
class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

    [[nodiscard]] bool is_empty() const { return left_.empty(); }

    std::uint8_t byte() {
        if (left_.empty()) return 0;
        const std::uint8_t first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    bool flag() { return byte() % 2 != 0; }
    /// low to high, both included, of 256 at most.
    int whole(int low, int high) { return low + byte() % (high - low + 1); }
    template <class Choice>
    Choice choice(int count) {
        return static_cast<Choice>(byte() % count);
    }
    /// 0 to most.
    std::size_t count(int most) { return static_cast<std::size_t>(whole(0, most)); }

    /// From low to high in steps of a 65536th; and one of the extremes for one first byte of eight.
    double number(double low = -3.0, double high = 3.0) {
        const std::uint8_t kind = byte();
        if (kind >= 224) return test::extremes.at(byte() % test::extremes.size());
        const int high_byte = byte(), share = 256 * high_byte + byte();
        const double between = low + (high - low) * share / 65536.0;
        return kind >= 192 ? std::round(between) : between;
    }
    float single(double low = -3.0, double high = 3.0) {
        const double drawn = number(low, high);
        constexpr double most = std::numeric_limits<float>::max();
        if (std::abs(drawn) > most)
            return std::copysign(std::numeric_limits<float>::infinity(),
                                 static_cast<float>(drawn > 0.0 ? 1 : -1));
        return static_cast<float>(drawn);
    }
    glm::dvec3 place(double size = 3.0) {
        const double x = number(-size, size), y = number(-size, size);
        return {x, y, number(-size, size)};
    }
    glm::vec3 single_place(double size = 3.0) {
        const float x = single(-size, size), y = single(-size, size);
        return {x, y, single(-size, size)};
    }
    std::vector<glm::dvec3> places(std::size_t count) {
        std::vector<glm::dvec3> all(count);
        for (glm::dvec3& one : all) one = place();
        return all;
    }
    std::vector<double> numbers(std::size_t count) {
        std::vector<double> all(count);
        for (double& one : all) one = number();
        return all;
    }
    /// A rotation, or what lies near to one.
    glm::dquat quaternion() {
        const glm::dvec3 vector = place(1.0);
        const glm::dquat any(number(-1.0, 1.0), vector.x, vector.y, vector.z);
        return flag() ? any : glm::normalize(any);
    }

  private:
    std::span<const std::uint8_t> left_;
};

}  // namespace motus::fuzzers
