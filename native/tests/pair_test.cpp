#include "pair.hpp"

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

using namespace motus;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers at which a comparison, a choice or a rounding could go another way in one of two lanes.
constexpr std::array values{0.0,     -0.0,     1.0,      -1.0,      1.0 / 3.0, 5e-324,
                            1.7e308, -1.7e308, infinity, -infinity, nan};

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

/// Whether a template gives both lanes what it gives each alone.
template <class Function>
bool is_lane_by_lane(Function&& function, double a, double b, double c, double d) {
    const Pair both = function(Pair(a, b), Pair(c, d));
    return same_bits(lane(both, 0), function(a, c)) && same_bits(lane(both, 1), function(b, d));
}

template <class Function>
void check_lanes(Function&& function) {
    std::mt19937 engine(1);
    std::uniform_int_distribution<std::size_t> any_value(0, values.size() - 1);
    for (const double a : values)
        for (const double c : values) {
            const double b = values[any_value(engine)], d = values[any_value(engine)];
            INFO(a << ", " << b << " and " << c << ", " << d);
            REQUIRE(is_lane_by_lane(function, a, b, c, d));
            REQUIRE(is_lane_by_lane(function, b, a, d, c));
        }
}

}  // namespace

TEST_CASE("each lane is computed as it would be alone", "[pair]") {
    using std::abs, std::max, std::min, std::sqrt;
    check_lanes([](auto a, auto b) { return a + b; });
    check_lanes([](auto a, auto b) { return a - b; });
    check_lanes([](auto a, auto b) { return a * b; });
    check_lanes([](auto a, auto b) { return a / b; });
    check_lanes([](auto a, auto b) { return min(a, b); });
    check_lanes([](auto a, auto b) { return max(a, b); });
    check_lanes([](auto a, auto) { return abs(a); });
    check_lanes([](auto a, auto) { return sqrt(a); });
}

TEST_CASE("each lane chooses for itself", "[pair]") {
    check_lanes([](auto a, auto b) { return select(a < b, a, b); });
    check_lanes([](auto a, auto b) { return select(a <= b, a, b); });
    check_lanes([](auto a, auto b) { return select(a > b, a, b); });
    check_lanes([](auto a, auto b) { return select(a >= b, a, b); });
    check_lanes([](auto a, auto b) { return select(a == b, a - a, b); });
    check_lanes([](auto a, auto b) { return select(!(a < b), a, b); });
    check_lanes([](auto a, auto b) { return select((a < b) | (b < a), a, b); });
    check_lanes([](auto a, auto b) { return select((a <= b) & (b <= a), a - a, b); });
}

TEST_CASE("masks of two", "[pair]") {
    const Pair low(1.0, 2.0);
    CHECK(any(low < Pair(2.0)));
    CHECK_FALSE(all(low < Pair(2.0)));
    CHECK(all(low < Pair(3.0)));
    CHECK_FALSE(any(low < Pair(1.0)));
    CHECK(lane(low < Pair(2.0), 0));
    CHECK_FALSE(lane(low < Pair(2.0), 1));
}

TEST_CASE("vectors of two", "[pair]") {
    using Vector = glm::vec<3, Pair>;
    const glm::dvec3 a(1.0, 2.0, 3.0), b(-4.0, 0.5, 7.0), c(0.1, 0.2, 0.3), d(9.0, -8.0, 7.0);
    Vector first(Pair(0.0)), second(Pair(0.0));
    set_lane(first, 0, a);
    set_lane(first, 1, b);
    set_lane(second, 0, c);
    set_lane(second, 1, d);
    CHECK(lane(glm::cross(first, second), 0) == glm::cross(a, c));
    CHECK(lane(glm::cross(first, second), 1) == glm::cross(b, d));
    CHECK(lane(glm::dot(first, second), 0) == glm::dot(a, c));
    CHECK(lane(glm::dot(first, second), 1) == glm::dot(b, d));
    CHECK(lane(select(first.x > Pair(0.0), first, second), 0) == a);
    CHECK(lane(select(first.x > Pair(0.0), first, second), 1) == d);
}
