#include "motus/fcurve/fcurve.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::fcurve;
using std::numbers::pi;

namespace {

Key key(double frame, double value, Interpolation interpolation, double handle = 1.0) {
    return {{frame, value}, {frame - handle, value}, {frame + handle, value}, interpolation};
}

/// From (1, 2) by a line to (5, 10), a step to (9, 4).
std::vector<Key> steps_and_lines() {
    return {key(1, 2, Interpolation::linear), key(5, 10, Interpolation::constant),
            key(9, 4, Interpolation::linear)};
}

/// A line from (1, 0) to (11, 5).
FCurve cyclic(const Cycles& cycles, bool goes_on = false) {
    return {{key(1, 0, Interpolation::linear), key(11, 5, Interpolation::linear)}, goes_on, cycles};
}

/// Eased from (0, 0) to (1, 1).
double eased_at(Interpolation interpolation, Easing easing, double share) {
    Key from = key(0, 0, interpolation);
    from.easing = easing;
    return FCurve({from, key(1, 1, Interpolation::linear)}, false).value(share);
}

}  // namespace

TEST_CASE("steps and lines between keys, and beyond them", "[fcurve]") {
    const FCurve holding(steps_and_lines(), false), going_on(steps_and_lines(), true);
    CHECK(holding.value(3.0) == 6.0f);
    CHECK(holding.value(8.5) == 10.0f);
    CHECK(holding.value(9.0) == 4.0f);
    CHECK(holding.value(-10.0) == 2.0f);
    CHECK(holding.value(20.0) == 4.0f);
    CHECK(going_on.value(0.0) == 0.0f);   // as from 1 to 5
    CHECK(going_on.value(11.0) == 1.0f);  // as from 5 to 9
    CHECK(FCurve({steps_and_lines()[0]}, true).value(7.0) == 2.0f);
    CHECK(holding.value(9.0 - 5e-5) == 4.0f);  // so near a key Blender has its value
}

TEST_CASE("a Bezier piece is its own cubic", "[fcurve]") {
    test::Random random(1);
    for (int i = 0; i < 500; ++i) {
        Key from = key(1.0, random.between(-2.0, 2.0), Interpolation::bezier);
        Key to = key(11.0, random.between(-2.0, 2.0), Interpolation::bezier);
        from.right = {random.between(1.0, 11.0), random.between(-3.0, 3.0)};
        to.left = {random.between(1.0, 11.0), random.between(-3.0, 3.0)};
        const double t = random.between(0.05, 0.95);
        const auto on = [&](const auto& part) {
            return (1 - t) * (1 - t) * (1 - t) * part(from.place) +
                   3 * t * (1 - t) * (1 - t) * part(from.right) + 3 * t * t * (1 - t) * part(to.left) +
                   t * t * t * part(to.place);
        };
        const double frame = on([](const glm::vec2& point) { return static_cast<double>(point.x); });
        const double value = on([](const glm::vec2& point) { return static_cast<double>(point.y); });
        // A frame's rounding is a value's error by the slope, which is great where both handles stand alike.
        const FCurve curve({from, to}, false);
        const double slope = std::abs(curve.value(frame + 1e-3) - curve.value(frame - 1e-3)) / 2e-3;
        CHECK(curve.value(frame) == Approx(value).margin(2e-6 * (1.0 + slope)));
        Roots roots;
        CHECK(curve.precise_value(frame, roots) == Approx(value).epsilon(0).margin(1e-7 + 2e-14 * slope));
    }
}

TEST_CASE("a precise value is in double precision if the F-curve is plain", "[fcurve]") {
    // Multiples of 1/3 and of 1/7, of which single precision has rounding.
    const std::vector<Key> keys{key(0, 0, Interpolation::linear), key(21, 7, Interpolation::linear)};
    Roots roots;
    for (int i = -50; i < 70; ++i) {
        const double frame = i / 7.0;
        CHECK(FCurve(keys, true).precise_value(frame, roots) == Approx(frame / 3.0).epsilon(1e-15));
        const FCurve repeated(keys, true, Cycles{});
        CHECK(repeated.precise_value(frame, roots) == static_cast<double>(repeated.value(frame)));
    }
    std::vector<Key> eased{key(0, 0, Interpolation::cubic), key(21, 7, Interpolation::linear)};
    const FCurve slow(eased, false);
    CHECK(slow.precise_value(10.1, roots) == static_cast<double>(slow.value(10.1)));
    CHECK(std::isnan(FCurve(keys, true).precise_value(std::numeric_limits<double>::infinity(), roots)));
}

TEST_CASE("caches of roots serve curves with different keys", "[fcurve]") {
    test::Random random(4);
    Roots kept;
    std::vector<FCurve> curves;
    for (int i = 0; i < 6; ++i) {
        Key from = key(1, 0, Interpolation::bezier), to = key(11.0 + i / 2, 5 + i, Interpolation::bezier);
        from.right = {random.between(1.0, 11.0), 0.0};
        to.left = {random.between(1.0, 11.0), 5.0};
        curves.push_back(FCurve({from, to}, false));
    }
    for (int i = 0; i < 300; ++i) {
        const double frame = static_cast<int>(random.between(2.0, 11.0));
        const FCurve& curve = curves[static_cast<std::size_t>(random.between(0.0, 5.999))];
        Roots fresh;
        CHECK(curve.precise_value(frame, kept) == curve.precise_value(frame, fresh));
    }
}

TEST_CASE("handles that are longer than the way are shortened", "[fcurve]") {
    Key from = key(0, 0, Interpolation::bezier), to = key(4, 1, Interpolation::bezier);
    from.right = {40, 10};
    to.left = {-36, -9};
    const float beyond = FCurve({from, to}, false).value(1.3);
    from.right = {4, 1};
    to.left = {0, 0};
    CHECK(beyond == Approx(FCurve({from, to}, false).value(1.3)));
}

TEST_CASE("beyond a Bezier key its handle leads on", "[fcurve]") {
    Key only = key(5, 1, Interpolation::bezier);
    only.left = {3, 0};
    only.right = {6, 3};
    CHECK(FCurve({only}, true).value(1.0) == -1.0f);
    CHECK(FCurve({only}, true).value(7.0) == 5.0f);
    CHECK(FCurve({only}, false).value(7.0) == 1.0f);
}

TEST_CASE("easings are Penner's", "[fcurve]") {
    const auto power = [](double t, double exponent) { return std::pow(t, exponent); };
    for (const double t : {0.1, 0.35, 0.5, 0.8}) {
        const auto in = [&](Interpolation kind) { return eased_at(kind, Easing::in, t); };
        CHECK(in(Interpolation::quadratic) == Approx(power(t, 2)).margin(1e-6));
        CHECK(in(Interpolation::cubic) == Approx(power(t, 3)).margin(1e-6));
        CHECK(in(Interpolation::quartic) == Approx(power(t, 4)).margin(1e-6));
        CHECK(in(Interpolation::quintic) == Approx(power(t, 5)).margin(1e-6));
        CHECK(in(Interpolation::sinusoidal) == Approx(1 - std::cos(t * pi / 2)).margin(1e-6));
        CHECK(in(Interpolation::circular) == Approx(1 - std::sqrt(1 - t * t)).margin(1e-6));
        const double least = std::pow(2.0, -10);  // so that it begins at 0
        CHECK(in(Interpolation::exponential) ==
              Approx((std::pow(2.0, 10 * (t - 1)) - least) / (1 - least)).margin(1e-6));
        CHECK(in(Interpolation::back) == Approx(t * t * (2.70158 * t - 1.70158)).margin(1e-6));
        // Without an amplitude Blender's elastic way swings in its last quarter of a period alone.
        CHECK(in(Interpolation::elastic) == 0.0);
    }
    CHECK(eased_at(Interpolation::bounce, Easing::out, 1 / 2.75) == Approx(1.0));
    CHECK(eased_at(Interpolation::bounce, Easing::out, 1.5 / 2.75) == Approx(0.75));
    CHECK(eased_at(Interpolation::bounce, Easing::out, 2.25 / 2.75) == Approx(0.9375));
}

TEST_CASE("an elastic way swings by its amplitude and period", "[fcurve]") {
    Key from = key(0, 0, Interpolation::elastic);
    from.easing = Easing::out;
    from.amplitude = 2.0f;
    from.period = 0.4f;
    const FCurve curve({from, key(1, 1, Interpolation::linear)}, false);
    const double late = 0.4 / (2 * pi) * std::asin(0.5);
    for (const double t : {0.05, 0.3, 0.7}) {
        // Blender's swings begin at the other side: it takes the time back.
        const double swing = 2.0 * std::pow(2.0, -10 * t) * std::sin((-t - late) * 2 * pi / 0.4);
        CHECK(curve.value(t) == Approx(swing + 1.0).margin(2e-6));
    }
}

TEST_CASE("easing out is easing in from the end, and both are halves of one way", "[fcurve]") {
    for (int kind = 3; kind < interpolation_count; ++kind) {
        const auto interpolation = static_cast<Interpolation>(kind);
        // The overshoot of back and the period of elastic are other ones where both sides are eased.
        const bool has_own = interpolation == Interpolation::back || interpolation == Interpolation::elastic;
        for (const double t : {0.1, 0.3, 0.45, 0.6, 0.9}) {
            const double in = eased_at(interpolation, Easing::in, t);
            CHECK(eased_at(interpolation, Easing::out, 1 - t) == Approx(1 - in).margin(3e-6));
            if (!has_own)
                CHECK(eased_at(interpolation, Easing::in_out, t / 2) == Approx(in / 2).margin(3e-6));
            const double both = eased_at(interpolation, Easing::in_out, t);
            CHECK(eased_at(interpolation, Easing::in_out, 1 - t) == Approx(1 - both).margin(3e-6));
            const bool ends = kind == 3 || kind == 4 || interpolation == Interpolation::elastic;
            CHECK(eased_at(interpolation, Easing::automatic, t) ==
                  eased_at(interpolation, ends ? Easing::out : Easing::in, t));
        }
    }
}

TEST_CASE("cycles repeat, with offset or mirrored, on both sides", "[fcurve]") {
    for (int lap = 1; lap < 6; ++lap) {
        const double after = 11.0 + 10.0 * (lap - 1) + 4.0, before = 1.0 - 10.0 * (lap - 1) - 4.0;
        CHECK(cyclic({}).value(after) == 2.0f);
        CHECK(cyclic({}).value(before) == 3.0f);
        const Cycles rising{.before = Repeat::with_offset, .after = Repeat::with_offset};
        CHECK(cyclic(rising).value(after) == 2.0f + 5.0f * static_cast<float>(lap));
        CHECK(cyclic(rising).value(before) == 3.0f - 5.0f * static_cast<float>(lap));
        const Cycles mirrored{.before = Repeat::mirror, .after = Repeat::mirror};
        CHECK(cyclic(mirrored).value(after) == (lap % 2 == 1 ? 3.0f : 2.0f));
        CHECK(cyclic(mirrored).value(before) == (lap % 2 == 1 ? 2.0f : 3.0f));
        const Cycles none{.before = Repeat::none, .after = Repeat::none};
        CHECK(cyclic(none).value(after) == 5.0f);
        CHECK(cyclic(none, true).value(before) == Approx((before - 1.0) / 2.0));
        const Cycles counted{.before_count = 2, .after_count = 2};
        CHECK(cyclic(counted).value(after) == (lap <= 2 ? 2.0f : 5.0f));
        CHECK(cyclic(counted).value(before) == (lap <= 2 ? 3.0f : 0.0f));
    }
    CHECK(cyclic({}).value(21.0) == 5.0f);  // the end of a lap, not the beginning of the next one
    CHECK(cyclic({}).value(1000001.0) == 5.0f);
    CHECK(cyclic({}).value(1000004.0) == 1.5f);
    CHECK(FCurve({key(1, 3, Interpolation::linear)}, false, Cycles{}).value(9.0) == 3.0f);
}

TEST_CASE("cycles act within their frames, by their influence", "[fcurve]") {
    const Cycles within{.start = 0.0f, .end = 40.0f};
    CHECK(cyclic(within).value(35.0) == 2.0f);
    CHECK(cyclic(within).value(41.0) == 5.0f);
    CHECK(cyclic(within).value(-1.0) == 0.0f);
    // By half its influence the frame is half as far from where it is played.
    CHECK(cyclic({.influence = 0.5f}).value(11.5) == 2.75f);
    const Cycles fading{.start = 0.0f, .end = 40.0f, .blend_out = 20.0f};
    CHECK(cyclic(fading).value(20.0) == 4.5f);
    CHECK(cyclic(fading).value(40.0) == 5.0f);
}

TEST_CASE("where the numbers of cycles overflow the value is NaN, of however many keys", "[fcurve]") {
    Cycles overflowing;
    overflowing.influence = std::numeric_limits<float>::max();
    const double last_frame = std::numeric_limits<float>::max();
    for (const std::size_t count : {1U, 2U, 3U}) {
        std::vector<Key> keys = steps_and_lines();
        keys.resize(count);
        CHECK(std::isnan(FCurve(keys, false, overflowing).value(last_frame)));
    }
}

TEST_CASE("laps are counted in double precision, or in single as older versions of Blender do", "[fcurve]") {
    // The float before the end of lap 100 of 10.1 frames: in single precision the quotient is 100, a lap too
    // far, and the mirrored lap is played from its wrong end.
    const std::vector<Key> keys{key(0, 0, Interpolation::linear), key(10.1f, 7, Interpolation::linear)};
    const double frame = 1020.0999755859375;
    const FCurve exact(keys, false, Cycles{.after = Repeat::mirror});
    const FCurve single(keys, false, Cycles{.after = Repeat::mirror, .is_exact = false});
    CHECK(exact.value(frame) == 7.0f);
    CHECK(single.value(frame) == 0.0f);
    CHECK(exact.value(frame - 3.0) == single.value(frame - 3.0));
}

TEST_CASE("many frames at once are the same, and in any order", "[fcurve]") {
    const FCurve curve(steps_and_lines(), true, Cycles{.after = Repeat::mirror});
    test::Random random(3);
    std::vector<double> frames(200), values(200);
    for (double& frame : frames) frame = random.between(-100.0, 100.0);
    curve.values(frames, values);
    for (std::size_t i = 0; i < frames.size(); ++i)
        CHECK(values[i] == static_cast<double>(curve.value(frames[i])));
}

TEST_CASE("a plain F-curve has neither easings nor cycles", "[fcurve]") {
    CHECK(FCurve(steps_and_lines(), false).is_plain());
    CHECK_FALSE(cyclic({}).is_plain());
    CHECK_FALSE(FCurve({key(0, 0, Interpolation::back)}, false).is_plain());
}
