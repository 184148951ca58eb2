#include "motus/sculpt/falloff.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::sculpt;

namespace {

constexpr Falloff all_falloffs[] = {Falloff::classic,  Falloff::smooth,   Falloff::sphere,
                                    Falloff::root,     Falloff::linear,   Falloff::sharp,
                                    Falloff::constant, Falloff::gaussian, Falloff::curve};

const std::vector<float> hill{0.0f, 0.3f, 0.2f, 1.0f, 0.5f};

/// The formulas as they are written in the manual, in double precision.
double by_definition(const Profile& profile, double radius, double distance) {
    const double t = 1.0 - distance / radius;
    if (profile.falloff == Falloff::classic) {
        if (distance * distance >= radius) return 0.0;
        return std::pow(1.0 - distance * distance / (radius + 1.0),
                        1.0 + std::abs(static_cast<double>(profile.scale_factor)));
    }
    if (distance >= radius) return 0.0;
    switch (profile.falloff) {
        case Falloff::smooth:
            return 3.0 * t * t - 2.0 * t * t * t;
        case Falloff::sphere:
            return std::sqrt(2.0 * t - t * t);
        case Falloff::root:
            return std::sqrt(t);
        case Falloff::linear:
            return t;
        case Falloff::sharp:
            return t * t;
        case Falloff::gaussian:
            return (std::exp(-4.5 * distance * distance / (radius * radius)) - std::exp(-4.5)) /
                   (1.0 - std::exp(-4.5));
        case Falloff::curve: {
            const double at = t * static_cast<double>(profile.curve.size() - 1);
            const std::size_t step = std::min(static_cast<std::size_t>(at), profile.curve.size() - 2);
            const double share = at - static_cast<double>(step);
            return profile.curve[step] * (1.0 - share) + profile.curve[step + 1] * share;
        }
        default:
            return 1.0;
    }
}

float force(const Profile& profile, float radius, float distance) {
    float result = distance;
    forces(profile, radius, {&result, 1}, {&result, 1});
    return result;
}

/// The change of a force by one rounding of d / R, which grows without bound at the edge for roots.
double allowance(const Profile& profile, double radius, double distance) {
    const double step = 1.2e-7 * std::max(distance, 1e-3 * radius);
    const double near = by_definition(profile, radius, std::max(0.0, distance - step));
    const double far = by_definition(profile, radius, distance + step);
    return distance + step >= radius ? std::abs(near) : std::abs(near - far);
}

}  // namespace

TEST_CASE("falloffs have the values of their formulas", "[falloff]") {
    CHECK(force({Falloff::smooth, 0, {}}, 2.0f, 1.0f) == 0.5f);
    CHECK(force({Falloff::smooth, 0, {}}, 2.0f, 1.5f) == Approx(0.15625));
    CHECK(force({Falloff::sphere, 0, {}}, 5.0f, 3.0f) == Approx(0.8));
    CHECK(force({Falloff::root, 0, {}}, 4.0f, 3.0f) == 0.5f);
    CHECK(force({Falloff::linear, 0, {}}, 4.0f, 1.0f) == 0.75f);
    CHECK(force({Falloff::sharp, 0, {}}, 4.0f, 1.0f) == 0.5625f);
    CHECK(force({Falloff::constant, 0, {}}, 4.0f, 3.99f) == 1.0f);
    CHECK(force({Falloff::gaussian, 0, {}}, 3.0f, 1.0f) ==
          Approx((std::exp(-0.5) - std::exp(-4.5)) / (1 - std::exp(-4.5))));
    CHECK(force({Falloff::classic, 0, {}}, 3.0f, 1.0f) == 0.75f);
    CHECK(force({Falloff::classic, 1, {}}, 3.0f, 1.0f) == Approx(0.5625));
    CHECK(force({Falloff::classic, -1, {}}, 3.0f, 1.0f) == Approx(0.5625));
    CHECK(force({Falloff::curve, 0, hill}, 4.0f, 1.0f) == 1.0f);
    CHECK(force({Falloff::curve, 0, hill}, 4.0f, 2.5f) == Approx(0.25));
}

TEST_CASE("forces agree with the formulas for any distance and radius", "[falloff]") {
    test::Random random(4);
    for (const Falloff falloff : all_falloffs) {
        for (const float radius : {1e-3f, 0.37f, 1.0f, 12.5f, 4000.0f}) {
            for (const float k : {0.0f, 0.5f, 3.0f, -10.0f}) {
                if (falloff != Falloff::classic && k != 0.0f) continue;
                const Profile profile{falloff, k, hill};
                std::vector<float> distances(3001);
                const float farthest = 1.2f * reach_of(profile, radius);
                for (float& distance : distances) distance = random.between(0.0f, farthest);
                distances[0] = 0.0f;
                std::vector<float> found(distances.size());
                forces(profile, radius, distances, found);
                double worst = 0.0;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    const double wanted = by_definition(profile, radius, distances[i]);
                    // The one step of distance, at which the force ends, is looked at below.
                    if (std::abs(distances[i] / reach_of(profile, radius) - 1.0) < 1e-6) continue;
                    const double excess =
                        std::abs(found[i] - wanted) - 2.0 * allowance(profile, radius, distances[i]);
                    worst = std::max(worst, excess);
                }
                INFO("falloff " << static_cast<int>(falloff) << ", radius " << radius << ", k " << k);
                CHECK(worst <= force_error);
            }
        }
    }
}

TEST_CASE("a force ends sharply at the radius", "[falloff]") {
    for (const Falloff falloff : all_falloffs) {
        for (const float radius : {0.25f, 1.0f, 3.0f, 1000.0f}) {
            const Profile profile{falloff, 2.0f, hill};
            const float reach = reach_of(profile, radius);
            CHECK(reach == (falloff == Falloff::classic ? std::sqrt(radius) : radius));
            CHECK(force(profile, radius, reach) == 0.0f);
            CHECK(force(profile, radius, std::nextafter(reach, 2.0f * reach)) == 0.0f);
            CHECK(force(profile, radius, 1e30f) == 0.0f);
            CHECK(force(profile, radius, std::numeric_limits<float>::infinity()) == 0.0f);
            CHECK(std::isnan(force(profile, radius, std::numeric_limits<float>::quiet_NaN())));
            const float within = force(profile, radius, std::nextafter(reach, 0.0f));
            CHECK(within >= 0.0f);
            CHECK(within <= 1.0f);
        }
    }
    CHECK(force({Falloff::constant, 0, {}}, 3.0f, std::nextafter(3.0f, 0.0f)) == 1.0f);
    CHECK(force({Falloff::classic, 0, {}}, 4.0f, std::nextafter(2.0f, 0.0f)) == Approx(0.2));
}

TEST_CASE("at the root the force is 1, and further away it never grows", "[falloff]") {
    for (const Falloff falloff : all_falloffs) {
        if (falloff == Falloff::curve) continue;
        const Profile profile{falloff, 1.5f, {}};
        CHECK(force(profile, 2.0f, 0.0f) == 1.0f);
        float last = 1.0f;
        for (int i = 0; i <= 2000; ++i) {
            const float now = force(profile, 2.0f, 0.001f * static_cast<float>(i));
            CHECK(now <= last + force_error);
            last = now;
        }
    }
    const Profile profile{Falloff::curve, 0, hill};
    CHECK(force(profile, 2.0f, 0.0f) == 0.5f);
    CHECK(force(profile, 2.0f, 1.9999999f) == Approx(0.0).margin(1e-6));
}

TEST_CASE("falloffs of extreme settings give finite forces", "[falloff]") {
    const auto is_share = [](float value) { return value >= 0.0f && value <= 1.0f; };
    for (const float radius : {1e-40f, 1e-20f, 1e20f, 3e38f}) {
        for (const Falloff falloff : all_falloffs) {
            for (const float share : {0.0f, 0.5f, 0.999f, 1.5f})
                CHECK(is_share(force({falloff, 0.5f, hill}, radius, share * radius)));
        }
    }
    for (const float k : {1e3f, 1e10f, 3e38f}) {
        CHECK(force({Falloff::classic, k, {}}, 2.0f, 0.0f) == 1.0f);
        CHECK(is_share(force({Falloff::classic, k, {}}, 2.0f, 1e-3f)));
        CHECK(force({Falloff::classic, k, {}}, 2.0f, 1.0f) < 1e-6f);
    }
}

TEST_CASE("forces refuse arguments outside their domain", "[falloff]") {
    std::vector<float> values(3, 0.5f);
    std::vector<float> fewer(2);
    const auto refuses = [&](const Profile& profile, float radius) {
        CHECK_THROWS_AS(forces(profile, radius, values, values), std::invalid_argument);
    };
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float radius : {0.0f, -1.0f, not_a_number, infinity}) refuses({}, radius);
    for (const float k : {not_a_number, infinity}) refuses({Falloff::classic, k, {}}, 1.0f);
    const std::vector<float> one{1.0f};
    const std::vector<float> strange{0.0f, not_a_number, 1.0f};
    refuses({Falloff::curve, 0, {}}, 1.0f);
    refuses({Falloff::curve, 0, one}, 1.0f);
    refuses({Falloff::curve, 0, strange}, 1.0f);
    CHECK_THROWS_AS(forces({}, 1.0f, values, fewer), std::invalid_argument);
    // Parameters that a falloff does not use are not checked.
    CHECK_NOTHROW(forces({Falloff::smooth, not_a_number, one}, 1.0f, values, values));
}
