// Each of several lanes has the result it would have alone, by each instruction set.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/wide_checks.hpp"
#include "motus/core/instruction_sets.hpp"
#include "random.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/wide_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "motus/core/sine-inl.hpp"
#include "motus/core/wide-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::test::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers at which a comparison, a choice or a rounding could go another way in one of the lanes.
constexpr std::array values{0.0,     -0.0,     1.0,      -1.0,      1.0 / 3.0, 5e-324,
                            1.7e308, -1.7e308, infinity, -infinity, nan};

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

/// A template of two numbers, with every two of them, in lanes beside any others.
template <class Several, class Function>
void check_lanes(const Function& function) {
    constexpr int lanes = lane_count<Several>;
    test::Random random(1);
    for (const double a : values)
        for (const double b : values)
            for (int here = 0; here < lanes; ++here) {
                Several first(0.0), second(0.0);
                for (int i = 0; i < lanes; ++i) {
                    set_lane(first, i, i == here ? a : values[random.below(values.size())]);
                    set_lane(second, i, i == here ? b : values[random.below(values.size())]);
                }
                const Several both = function(first, second);
                for (int i = 0; i < lanes; ++i) {
                    INFO(lane(first, i) << " and " << lane(second, i) << " in lane " << i);
                    REQUIRE(same_bits(lane(both, i), function(lane(first, i), lane(second, i))));
                }
            }
}

template <class Several>
void check_arithmetic() {
    using std::abs, std::max, std::min, std::sqrt;
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return a + b; });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return a - b; });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return a * b; });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return a / b; });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return min(a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return max(a, b); });
    check_lanes<Several>([](auto a, auto) HWY_ATTR { return abs(a); });
    check_lanes<Several>([](auto a, auto) HWY_ATTR { return sqrt(a); });
}

template <class Several>
void check_choices() {
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(a < b, a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(a <= b, a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(a > b, a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(a >= b, a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(a == b, a + b, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select(!(a < b), a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select((a < b) | (b < a), a, b); });
    check_lanes<Several>([](auto a, auto b) HWY_ATTR { return select((a <= b) & (b <= a), a + b, b); });
}

template <class Several>
void check_masks() {
    constexpr int lanes = lane_count<Several>;
    for (int here = 0; here < lanes; ++here) {
        Several one(0.0);
        set_lane(one, here, 1.0);
        const auto is_one = one > Several(0.5);
        CHECK(any(is_one));
        CHECK(all(is_one) == (lanes == 1));
        CHECK_FALSE(all(!is_one));
        for (int i = 0; i < lanes; ++i) CHECK(lane(is_one, i) == (i == here));
    }
    CHECK(all(Several(1.0) > Several(0.5)));
    CHECK_FALSE(any(Several(0.0) > Several(0.5)));
}

template <class Several>
void check_vectors() {
    constexpr int lanes = lane_count<Several>;
    const Several zero(0.0);
    Vector<Several> first{zero, zero, zero}, second{zero, zero, zero};
    std::array<glm::dvec3, lanes> a{}, b{};
    test::Random random(2);
    for (int i = 0; i < lanes; ++i) {
        a.at(i) = random.in_cube(9.0);
        b.at(i) = random.in_cube(9.0);
        set_lane(first, i, a.at(i));
        set_lane(second, i, b.at(i));
    }
    const auto is_positive = first.x > Several(0.0);
    for (int i = 0; i < lanes; ++i) {
        CHECK(lane(cross(first, second), i) == glm::cross(a.at(i), b.at(i)));
        CHECK(lane(dot(first, second), i) == glm::dot(a.at(i), b.at(i)));
        CHECK(lane(select(is_positive, first, second), i) == (a.at(i).x > 0.0 ? a.at(i) : b.at(i)));
    }
}

template <class Several>
void check_angles() {
    constexpr int lanes = lane_count<Several>;
    test::Random random(3);
    for (int round = 0; round < 1000; ++round) {
        Several angles(0.0);
        for (int i = 0; i < lanes; ++i)
            set_lane(angles, i, random.between(-1.0, 1.0) * std::exp(0.03 * round));
        const SineCosine<Several> found = motus::HWY_NAMESPACE::sine_cosine(angles);
        for (int i = 0; i < lanes; ++i) {
            const SineCosine<double> alone = motus::sine_cosine(lane(angles, i));
            INFO("angle " << lane(angles, i));
            REQUIRE(same_bits(lane(found.sine, i), alone.sine));
            REQUIRE(same_bits(lane(found.cosine, i), alone.cosine));
        }
    }
}

template <class Several>
void check_memory() {
    constexpr int lanes = lane_count<Several>;
    std::array<double, lanes + 1> from{}, to{};
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = 1.0 + static_cast<double>(i);
    Several some;
    load(from.data() + 1, some);  // at any address
    store(some, to.data() + 1);
    for (int i = 0; i < lanes; ++i) CHECK(lane(some, i) == 2.0 + i);
    from[0] = 0.0;
    CHECK(from == to);
}

template <class Several>
void check_fields() {
    constexpr std::size_t lanes = lane_count<Several>, count = 8, step = 11;
    std::array<double, step * lanes> given{}, written{};
    for (std::size_t at = 0; at < given.size(); ++at) given.at(at) = static_cast<double>(at);
    Several fields[count];  // NOLINT(*-avoid-c-arrays, *-member-init): as load_fields() has it
    load_fields(given.data(), step * sizeof(double), fields);
    for (std::size_t i = 0; i < lanes; ++i)
        for (std::size_t k = 0; k < count; ++k)
            CHECK(lane(fields[k], static_cast<int>(i)) == given.at(i * step + k));
    store_fields(fields, written.data(), step * sizeof(double));
    for (std::size_t at = 0; at < given.size(); ++at)
        CHECK(written.at(at) == (at % step < count ? given.at(at) : 0.0));
}

template <class Several>
void check_numbers() {
    check_arithmetic<Several>();
    check_choices<Several>();
    check_masks<Several>();
    check_vectors<Several>();
    check_angles<Several>();
    check_memory<Several>();
    if constexpr (lane_count<Several> == 2 || lane_count<Several> == 4) check_fields<Several>();
}

/// Of as many lanes as the instruction set has, if that is fewer.
constexpr Checks checks{HWY_STR(HWY_NAMESPACE), &check_numbers<UpTo<2>>, &check_numbers<UpTo<4>>,
                        &check_numbers<UpTo<8>>};

}  // namespace
}  // namespace motus::test::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::test {

TEST_CASE("each of several lanes is computed as it would be alone", "[wide]") {
    const Kernels<Checks> all({MOTUS_EVERY_TARGET(checks)});
    for (const Checks& of_set : all.runnable()) {
        DYNAMIC_SECTION(of_set.name) {
            SECTION("pairs") {
                of_set.pairs();
            }
            SECTION("quads") {
                of_set.quads();
            }
            SECTION("octets") {
                of_set.octets();
            }
        }
    }
}

}  // namespace motus::test
#endif
