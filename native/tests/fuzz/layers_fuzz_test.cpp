// Layers of animation with numbers that nobody expects.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "motus/bones/layers/mask.hpp"
#include "motus/bones/layers/stack.hpp"
#include "motus/core/numeric.hpp"

using namespace motus;
using namespace motus::bones::layers;
using namespace motus::test;

namespace {

/// An F-curve of any keys; refused where they do not rise or a number is not finite.
[[nodiscard]] fcurve::FCurve fcurve_of(Dice& dice, std::size_t count) {
    std::vector<fcurve::Key> keys(count);
    double frame = dice.number(-5.0, 5.0);
    for (fcurve::Key& key : keys) {
        frame += dice.number(0.0, 3.0);
        key.place = {frame, dice.number()};
        key.left = {frame - dice.number(0.0, 1.0), dice.number()};
        key.right = {frame + dice.number(0.0, 1.0), dice.number()};
        key.interpolation =
            static_cast<fcurve::Interpolation>(dice.whole(0, fcurve::interpolation_count - 1));
        key.easing = static_cast<fcurve::Easing>(dice.whole(0, fcurve::easing_count - 1));
        key.amplitude = static_cast<float>(dice.number());
        key.period = static_cast<float>(dice.number());
    }
    std::optional<fcurve::Cycles> cycles;
    if (dice.chance(0.5)) {
        cycles.emplace();
        cycles->before = static_cast<fcurve::Repeat>(dice.whole(0, fcurve::repeat_count - 1));
        cycles->after = static_cast<fcurve::Repeat>(dice.whole(0, fcurve::repeat_count - 1));
        cycles->after_count = dice.whole(-1, 3);
        cycles->blend_in = static_cast<float>(dice.number(0.0, 5.0));
        if (dice.chance(0.5)) cycles->start = static_cast<float>(dice.number());
        cycles->influence = static_cast<float>(dice.number(0.0, 1.0));
    }
    return {std::move(keys), dice.chance(0.5), cycles};
}

[[nodiscard]] LayerTiming timing_of(Dice& dice) {
    LayerTiming timing{
        dice.number(),         dice.number(),        0.0, dice.number(), static_cast<After>(dice.whole(0, 2)),
        dice.number(0.0, 3.0), dice.number(0.0, 3.0)};
    timing.last = timing.first + dice.number(0.0, 9.0);
    return timing;
}

/// Three bones, of which the clip animates two; the action is 1 to 9.
struct Layered {
    std::vector<int> parents{-1, 0, 1};
    std::vector<glm::dquat> rest{3, bones::no_turn};
    std::vector<char> inherits{1, 1, 1};
    std::vector<fcurve::Key> keys{{{1.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}},
                                  {{9.0, 8.0}, {8.0, 8.0}, {10.0, 8.0}}};
    std::vector<ClipCurve> curves{{0, 0, 0}, {1, 4, 0}};
    std::vector<Rotation> rotations{Rotation::quaternion, Rotation::xyz, Rotation::axis_angle};
    Clip clip{rotations, curves, std::vector{fcurve::FCurve(keys, true)}};
    Stack stack{parents, rest, inherits};
    std::vector<double> mask{1.0, 1.0, 1.0};

    [[nodiscard]] Layer layer(const LayerTiming& timing) const {
        Layer one;
        one.clip = &clip;
        one.mask = mask;
        one.timing = timing;
        return one;
    }
};

}  // namespace

TEST_CASE("an action whose frame range overflows plays finite frames", "[fuzz]") {
    const Layered rig;
    for (const After after : {After::nothing, After::hold, After::repeat}) {
        for (const double speed : {1.0, -1.0, 1e300}) {
            const LayerTiming timing{
                .start = 0.0, .first = -1.7e308, .last = 1.7e308, .speed = speed, .after = after};
            for (const double frame : {0.0, 5.0, 1.7e308, -1.7e308}) {
                const Moment moment = moment_of(timing, frame);
                CHECK(std::isfinite(moment.frame));
                CHECK((moment.weight >= 0.0 && moment.weight <= 1.0));
                const std::vector<Layer> layers{rig.layer(timing)};
                const std::vector<Transform> base(3);
                std::vector<Transform> result(3);
                std::vector<char> changed(3);
                rig.stack.solve(frame, layers, base, result, changed);
                for (const Transform& one : result) CHECK(is_finite(one));
            }
        }
    }
}

TEST_CASE("frames that are NaN are refused before any output is written", "[fuzz]") {
    const Layered rig;
    std::vector<Transform> out(2);
    std::vector<Transform> base(3), result(3);
    std::vector<char> changed(3, 7);
    for (const double bad : {not_a_number, infinity, -infinity}) {
        CHECK(is_refused([&] { rig.clip.evaluate(bad, {}, out); }, "frame"));
        CHECK(is_refused([&] { (void)moment_of({}, bad); }, "frame"));
        CHECK(is_refused([&] { (void)moment_of({.start = bad}, 1.0); }, "start"));
        CHECK(is_refused([&] { (void)moment_of({.first = bad}, 1.0); }, "first"));
        CHECK(is_refused([&] { (void)moment_of({.speed = bad}, 1.0); }, "speed"));
        CHECK(is_refused([&] { (void)moment_of({.blend_in = bad}, 1.0); }, "blend_in"));
        const auto solve = [&](const Layer& layer, double frame) {
            const std::vector<Layer> layers{rig.layer({}), layer};
            rig.stack.solve(frame, layers, base, result, changed);
        };
        CHECK(is_refused([&] { solve(rig.layer({}), bad); }, "frame"));
        CHECK(is_refused([&] { solve(rig.layer({.start = bad}), 1.0); }, "start"));
        Layer layer = rig.layer({});
        layer.weight = bad;
        CHECK(is_refused([&] { solve(layer, 1.0); }, "weight"));
        layer = rig.layer({});
        const std::vector<double> given(1);
        layer.given = given;
        CHECK(is_refused([&] { solve(layer, 1.0); }, "given"));
    }
    CHECK(changed == std::vector<char>(3, 7));
    CHECK(is_refused([&] { (void)fcurve::FCurve({}, true); }, "keys"));
    std::vector<fcurve::Key> falling = rig.keys;
    std::swap(falling[0], falling[1]);
    CHECK(is_refused([&] { (void)fcurve::FCurve(falling, true); }, "keys"));
    falling = rig.keys;
    falling[1].place.x = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_refused([&] { (void)fcurve::FCurve(falling, true); }, "keys"));
    fcurve::Cycles endless;
    endless.influence = std::numeric_limits<float>::infinity();
    CHECK(is_refused([&] { (void)fcurve::FCurve(rig.keys, true, endless); }, "cycles"));
    endless = {.after_count = -1};
    CHECK(is_refused([&] { (void)fcurve::FCurve(rig.keys, true, endless); }, "cycles"));
    const fcurve::FCurve sound(rig.keys, true);
    std::vector<double> values(2);
    CHECK(is_refused([&] { sound.values(std::array{1.0}, values); }, "out"));
    CHECK(is_refused([&] { sound.values(std::array{1.0, not_a_number}, values); }, "frames"));
    CHECK(std::isnan(sound.value(not_a_number)));
}

TEST_CASE("a rotation made of arbitrary numbers is a unit quaternion", "[fuzz]") {
    Dice dice(21, 0.5);
    for (int round = 0; round < 3000; ++round) {
        const std::array<double, 4> numbers{dice.number(), dice.number(), dice.number(), dice.number()};
        const glm::dquat q = rotation_of(static_cast<Rotation>(dice.whole(0, 7)), numbers);
        if (are_finite(numbers)) CHECK(glm::dot(q, q) == Approx(1.0));
    }
}

TEST_CASE("layers of arbitrary numbers are refused, or give finite bones", "[fuzz]") {
    for (const double share : {0.01, 0.2}) {
        Dice dice(22, share);
        for (int round = 0; round < 600; ++round) {
            const LayerTiming timing = timing_of(dice);
            const double frame = dice.number(-5.0, 30.0);
            returns([&] {
                const Moment moment = moment_of(timing, frame);
                CHECK(std::isfinite(moment.frame));
                CHECK((moment.weight >= 0.0 && moment.weight <= 1.0));
            });
            Layered rig;
            returns([&] { (void)fcurve_of(dice, dice.below(4)).value(frame); });
            returns([&] {
                const std::vector<fcurve::FCurve> fcurves{fcurve_of(dice, 4), fcurve_of(dice, 2)};
                const std::vector<ClipCurve> curves{
                    {dice.whole(-1, 3), dice.whole(-1, 10), dice.whole(-2, 2)},
                    {0, 0, 0},
                    {1, dice.whole(0, 9), 1, dice.chance(0.5)},
                    {2, 3, dice.whole(-1, 1)}};
                rig.clip = Clip(rig.rotations, std::span(curves).subspan(dice.chance(0.1) ? 0 : 1), fcurves);
            });
            std::vector<Transform> base(3), result(3);
            for (Transform& one : base) one = {dice.place(), dice.any_rotation(), dice.place()};
            rig.mask = dice.numbers(3, 0.0, 1.0);
            std::vector<Layer> layers{rig.layer({}), rig.layer(timing)};
            const std::vector<double> given = dice.numbers(rig.clip.given_count());
            const std::vector<Transform> reference(rig.clip.bones().size());
            for (Layer& layer : layers) {
                layer.given = given;
                layer.weight = dice.number(0.0, 1.0);
                layer.mode = static_cast<LayerMode>(dice.whole(0, 1));
                layer.in_armature = dice.chance(0.5);
                if (dice.chance(0.3)) layer.reference = reference;
            }
            std::vector<char> changed(3);
            returns([&] {
                rig.stack.solve(frame, layers, base, result, changed);
                for (std::size_t bone = 0; bone < 3; ++bone)
                    if (is_finite(base[bone])) CHECK(is_finite(result[bone]));
            });
            std::vector<Transform> wanted = base, said(3);
            for (Transform& one : wanted) one = {dice.place(), dice.any_rotation(), dice.place()};
            std::vector<unsigned> reached(3);
            returns([&] {
                rig.stack.find_source(frame, layers, dice.below(2), base, wanted, std::array{0, 1, 2}, said,
                                      reached);
                for (const Transform& one : said) CHECK(is_finite(one));
            });
        }
    }
}

TEST_CASE("masks refuse arrays of different sizes", "[fuzz]") {
    const std::vector<int> parents{-1, 0, 1};
    const std::vector<int> order = parents_first(parents);
    const std::vector<double> chosen{0.0, 1.0, 1.0};
    std::vector<double> mask(3), longer(4);
    feathered(parents, order, chosen, 1, mask);
    CHECK(mask[1] == Approx(0.5));
    CHECK(is_refused([&] { feathered(parents, order, chosen, 1, longer); }, "mask"));
    CHECK(is_refused([&] { feathered(parents, order, longer, 1, mask); }, "chosen"));
    CHECK(is_refused([&] { feathered(parents, {}, chosen, 1, mask); }, "order"));
    CHECK(is_refused([&] { feathered(parents, order, chosen, -1, mask); }, "feather"));
    const std::vector<int> wild{0, 1, 3}, orphans{-1, 9, 1};
    CHECK(is_refused([&] { feathered(parents, wild, chosen, 1, mask); }, "order"));
    CHECK(is_refused([&] { feathered(orphans, order, chosen, 1, mask); }, "parents"));
    CHECK(is_refused([&] { (void)parents_first(orphans); }, "parents"));
}
