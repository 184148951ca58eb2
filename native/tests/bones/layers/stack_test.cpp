#include "motus/bones/layers/stack.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "allocations.hpp"
#include "motus/bones/layers/mask.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::layers;
using motus::fcurve::FCurve;
using motus::fcurve::Interpolation;
using motus::fcurve::Key;
using std::numbers::pi;

namespace {

const glm::dvec3 x(1, 0, 0), z(0, 0, 1);

double distance(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

/// Root, hips, chest, arm: one below the other; each is turned about Z by its clip, 0.1 rad a frame.
struct Figure {
    std::array<int, 4> parents{-1, 0, 1, 2};
    std::array<char, 4> inherits{1, 1, 1, 1};
    std::vector<glm::dquat> rest;
    std::vector<double> mask{0, 0, 1, 1};
    Clip clip;
    Layer layer;

    Figure() : clip(clip_of({0, 1, 2, 3})) {
        for (int bone = 0; bone < 4; ++bone) rest.push_back(glm::angleAxis(0.4 * bone, x));
        layer.clip = &clip;
        layer.mask = mask;
        layer.timing.after = After::hold;
        layer.timing.last = 101;
    }
    Figure(const Figure&) = delete;
    Figure& operator=(const Figure&) = delete;

    static Clip clip_of(const std::vector<int>& bones) {
        const std::array modes{Rotation::xyz, Rotation::xyz, Rotation::xyz, Rotation::xyz};
        const FCurve line({Key{{1, 0}, {0, 0}, {2, 0}, Interpolation::linear},
                           Key{{101, 10}, {100, 10}, {102, 10}, Interpolation::linear}},
                          false);
        std::vector<ClipCurve> curves;
        for (const int bone : bones) curves.push_back({bone, 5, 0});
        return {modes, curves, std::array{line}};
    }

    [[nodiscard]] std::vector<Transform> lay(double frame, const std::vector<Layer>& layers,
                                             const std::vector<Transform>& base) const {
        std::vector<Transform> result(4);
        std::vector<char> changed(4);
        Stack(parents, rest, inherits).solve(frame, layers, base, result, changed);
        return result;
    }

    /// Rotation of each bone in the armature.
    [[nodiscard]] std::vector<glm::dquat> standing(const std::vector<Transform>& pose) const {
        std::vector<glm::dquat> turned;
        for (std::size_t bone = 0; bone < 4; ++bone) {
            const glm::dquat from = bone == 0 ? rest[0] : glm::conjugate(rest[bone - 1]) * rest[bone];
            turned.push_back((bone == 0 ? no_turn : turned[bone - 1]) * from * pose[bone].rotation);
        }
        return turned;
    }
};

std::vector<Transform> walking() {
    std::vector<Transform> base(4);
    for (std::size_t bone = 0; bone < 4; ++bone) base[bone].rotation = glm::angleAxis(0.2, x);
    return base;
}

}  // namespace

TEST_CASE("a layer acts where its mask is, by weight times mask", "[layers]") {
    Figure figure;
    figure.mask = {0, 0, 0.5, 1};
    figure.layer.mask = figure.mask;
    figure.layer.weight = 0.5;
    const std::vector<Transform> base = walking();
    const std::vector<Transform> found = figure.lay(6.0, {figure.layer}, base);
    CHECK(found[0].rotation == base[0].rotation);
    CHECK(found[1].rotation == base[1].rotation);
    const glm::dquat way = glm::conjugate(base[2].rotation) * glm::angleAxis(0.5, z);
    CHECK(distance(found[2].rotation, base[2].rotation * part_of_turn(way, 0.25)) < 1e-7);
    CHECK(distance(found[3].rotation, base[3].rotation * part_of_turn(way, 0.5)) < 1e-7);
}

TEST_CASE("layers are laid one over the other", "[layers]") {
    Figure figure;
    Layer additive = figure.layer;
    additive.mode = LayerMode::additive;
    const std::vector<Transform> found = figure.lay(4.0, {figure.layer, additive, additive}, walking());
    CHECK(distance(found[3].rotation, glm::angleAxis(0.9, z)) < 1e-7);
}

TEST_CASE("a reference is what an additive layer starts from", "[layers]") {
    Figure figure;
    std::vector<Transform> reference(4);
    figure.clip.evaluate(3.0, {}, reference);
    figure.layer.reference = reference;
    figure.layer.mode = LayerMode::additive;
    const std::vector<Transform> base = walking();
    const std::vector<Transform> found = figure.lay(5.0, {figure.layer}, base);
    CHECK(distance(found[3].rotation, base[3].rotation * glm::angleAxis(0.2, z)) < 1e-7);
}

TEST_CASE("a layer of weight 0 changes no bit", "[layers]") {
    Figure figure;
    figure.layer.in_armature = true;
    const std::vector<Transform> base = walking();
    for (const double weight : {0.0, -1.0}) {
        figure.layer.weight = weight;
        const std::vector<Transform> found = figure.lay(6.0, {figure.layer}, base);
        for (std::size_t bone = 0; bone < 4; ++bone) CHECK(found[bone].rotation == base[bone].rotation);
    }
}

namespace {

constexpr auto last_angle = static_cast<float>(4.0 * pi);

/// Two turns in 48 frames about Y, and nothing else, of a rig's second bone; with the third one keyed at a
/// slant.
Clip rotor(Rotation mode) {
    const std::array modes{mode, mode, Rotation::xyz, Rotation::xyz};
    const auto key = [](double frame, double value) {
        return Key{{frame, value}, {frame, value}, {frame, value}, Interpolation::linear};
    };
    const FCurve turning({key(1, 0), key(49, last_angle)}, false),
        slanted({key(1, 0.6), key(49, 0.9)}, false);
    return {modes, std::array{ClipCurve{1, mode == Rotation::axis_angle ? 3 : 4, 0}, ClipCurve{2, 3, 1}},
            std::array{turning, slanted}};
}

/// A layer that plays it, with what LayerStack wants of it.
struct Rotor {
    Clip clip;
    std::vector<Lap> laps;
    Layer layer;

    Rotor(const Figure& figure, Rotation mode, double begin = 1.0, double end = 49.0)
        : clip(rotor(mode)), laps(2), layer(figure.layer) {
        std::array<Transform, 2> pose;
        std::array<Numbers, 2> first, last;
        clip.evaluate(begin, {}, pose, first);
        clip.evaluate(end, {}, pose, last);
        for (std::size_t i = 0; i < 2; ++i) {
            laps[i].from = first[i];
            for (std::size_t n = 0; n < 4; ++n) laps[i].gained[n] = last[i][n] - first[i][n];
        }
        layer.clip = &clip;
        layer.laps = laps;
        layer.timing.last = 49.0;
    }
    Rotor(const Rotor&) = delete;
    Rotor& operator=(const Rotor&) = delete;
};

const glm::dvec3 y(0, 1, 0);

}  // namespace

TEST_CASE("a layer that turns a bone twice turns it by its weight times two turns", "[layers]") {
    Figure figure;
    const std::vector<Transform> still(4);
    for (const Rotation mode : {Rotation::xyz, Rotation::zxy, Rotation::axis_angle}) {
        Rotor rotor(figure, mode);
        CHECK(rotor.clip.has_spins());
        for (const LayerMode acts : {LayerMode::override, LayerMode::additive}) {
            for (const double weight : {0.1, 0.25, 0.5, 0.9, 1.0}) {
                figure.mask = {0, 1, 1, 1};
                rotor.layer.mask = figure.mask;
                rotor.layer.mode = acts;
                rotor.layer.weight = weight;
                for (double frame = 1.0; frame <= 49.0; frame += 1.5) {
                    const double angle = weight * (frame - 1.0) / 48.0 * static_cast<double>(last_angle);
                    CHECK(distance(figure.lay(frame, {rotor.layer}, still)[1].rotation,
                                   glm::angleAxis(angle, y)) < 1e-7);
                }
            }
        }
    }
}

TEST_CASE("a bone that goes around in a repeated layer goes on from lap to lap, and backwards", "[layers]") {
    Figure figure;
    figure.mask = {0, 1, 1, 1};
    const std::vector<Transform> still(4);
    for (const double speed : {1.0, -1.0}) {
        Rotor rotor(figure, Rotation::xyz, speed > 0.0 ? 1.0 : 49.0, speed > 0.0 ? 49.0 : 1.0);
        rotor.layer.mask = figure.mask;
        rotor.layer.timing.after = After::repeat;
        rotor.layer.timing.speed = speed;
        rotor.layer.weight = 0.25;
        for (double frame = 1.0; frame <= 300.0; frame += 7.5) {
            const double angle = 0.25 * speed * (frame - 1.0) / 48.0 * 4.0 * pi;
            CHECK(distance(figure.lay(frame, {rotor.layer}, still)[1].rotation, glm::angleAxis(angle, y)) <
                  1e-6);
        }
    }
}

TEST_CASE("with blending in the armature a bone that goes around takes its children along", "[layers]") {
    Figure figure;
    figure.mask = {0, 1, 1, 1};
    for (const LayerMode acts : {LayerMode::override, LayerMode::additive}) {
        Rotor rotor(figure, Rotation::xyz);
        rotor.layer.mask = figure.mask;
        rotor.layer.in_armature = true;
        rotor.layer.mode = acts;
        const auto poses = [&](double frame, double weight) {
            rotor.layer.weight = weight;
            return figure.standing(figure.lay(frame, {rotor.layer}, walking()));
        };
        for (const double weight : {0.3, 0.5, 0.8}) {
            for (double frame = 1.0; frame < 49.0; frame += 0.5)
                for (std::size_t bone = 0; bone < 4; ++bone)
                    CHECK(distance(poses(frame, weight)[bone], poses(frame + 0.5, weight)[bone]) <
                          weight * 0.5 / 48.0 * 4.5 * pi);
        }
        for (const double frame : {1.0, 13.0, 30.0, 49.0}) {
            for (std::size_t bone = 0; bone < 4; ++bone) {
                CHECK(distance(poses(frame, 1.0)[bone], poses(frame, 1.0 - 1e-9)[bone]) < 1e-6);
                CHECK(distance(poses(frame, 1e-9)[bone], figure.standing(walking())[bone]) < 1e-6);
            }
        }
    }
}

TEST_CASE("with blending in the armature hips that turn do not turn bones that the layer holds", "[layers]") {
    Figure figure;
    figure.layer.in_armature = true;
    std::vector<Transform> still(4);
    const std::vector<Transform> wanted = figure.lay(6.0, {figure.layer}, still);
    const std::vector<Transform> found = figure.lay(6.0, {figure.layer}, walking());
    // The clip turns root and hips as well, so that the chest stands as in the clip alone.
    std::vector<Transform> all(4);
    for (Transform& bone : all) bone.rotation = glm::angleAxis(0.5, z);
    for (std::size_t bone = 2; bone < 4; ++bone) {
        CHECK(distance(figure.standing(found)[bone], figure.standing(wanted)[bone]) < 1e-7);
        CHECK(distance(figure.standing(found)[bone], figure.standing(all)[bone]) < 1e-7);
    }
    CHECK(found[1].rotation == walking()[1].rotation);
}

TEST_CASE("with blending in the armature a part of the weight gives a part of the turn in armature space",
          "[layers]") {
    Figure figure;
    figure.layer.in_armature = true;
    figure.layer.weight = 0.3;
    const std::vector<Transform> base = walking();
    const std::vector<glm::dquat> beneath = figure.standing(base);
    figure.layer.weight = 1.0;
    const std::vector<glm::dquat> above = figure.standing(figure.lay(6.0, {figure.layer}, base));
    figure.layer.weight = 0.3;
    const std::vector<glm::dquat> found = figure.standing(figure.lay(6.0, {figure.layer}, base));
    for (std::size_t bone = 2; bone < 4; ++bone)
        CHECK(distance(found[bone], part_of_turn(above[bone] * glm::conjugate(beneath[bone]), 0.3) *
                                        beneath[bone]) < 1e-7);
}

TEST_CASE("with blending in the armature an additive layer adds its rotation in armature space", "[layers]") {
    Figure figure;
    figure.layer.in_armature = true;
    figure.layer.mode = LayerMode::additive;
    const std::vector<Transform> base = walking();
    std::vector<Transform> source(4);
    for (Transform& bone : source) bone.rotation = glm::angleAxis(0.5, z);
    const std::vector<glm::dquat> said = figure.standing(source);
    const std::vector<glm::dquat> rest = figure.standing(std::vector<Transform>(4));
    const std::vector<glm::dquat> beneath = figure.standing(base);
    const std::vector<glm::dquat> found = figure.standing(figure.lay(6.0, {figure.layer}, base));
    for (std::size_t bone = 2; bone < 4; ++bone)
        CHECK(distance(found[bone], said[bone] * glm::conjugate(rest[bone]) * beneath[bone]) < 1e-7);
}

TEST_CASE("with blending in the armature bones without inherited rotation do not turn with their parents",
          "[layers]") {
    Figure figure;
    figure.inherits = {1, 1, 0, 1};
    figure.layer.in_armature = true;
    const std::vector<Transform> found = figure.lay(6.0, {figure.layer}, walking());
    CHECK(distance(found[2].rotation, glm::angleAxis(0.5, z)) < 1e-7);
}

TEST_CASE("a layer leaves bones whose numbers are not finite as they are", "[layers]") {
    Figure figure;
    std::vector<Transform> base = walking();
    base[3].location.x = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Transform> found = figure.lay(6.0, {figure.layer}, base);
    CHECK(found[3].rotation == base[3].rotation);
    CHECK(distance(found[2].rotation, glm::angleAxis(0.5, z)) < 1e-7);
}

TEST_CASE("a stack of layers allocates once, not for each bone", "[layers]") {
    Figure figure;
    const Stack stack(figure.parents, figure.rest, figure.inherits);
    const std::vector<Layer> few(2, figure.layer), many(50, figure.layer);
    const std::vector<Transform> base = walking();
    std::vector<Transform> result(4);
    std::vector<char> changed(4);
    const auto taken = [&](const std::vector<Layer>& layers) {
        return test::bytes_allocated_by([&] { stack.solve(6.0, layers, base, result, changed); });
    };
    CHECK(taken(few) == taken(many));
}

TEST_CASE("a stack of layers refuses arrays that do not fit the rig", "[layers]") {
    Figure figure;
    std::vector<Transform> base(3);
    std::vector<char> changed(3);
    const Stack stack(figure.parents, figure.rest, figure.inherits);
    CHECK_THROWS_AS(stack.solve(1.0, {}, base, base, changed), std::invalid_argument);
    base.resize(4);
    changed.resize(4);
    Layer bad = figure.layer;
    bad.mask = std::span(figure.mask).first(3);
    CHECK_THROWS_AS(stack.solve(1.0, std::array{bad}, base, base, changed), std::invalid_argument);
    bad = figure.layer;
    bad.clip = nullptr;
    CHECK_THROWS_AS(stack.solve(1.0, std::array{bad}, base, base, changed), std::invalid_argument);
    CHECK_THROWS_AS(parents_first(std::array{1, 0}), std::invalid_argument);
    CHECK_THROWS_AS(parents_first(std::array{2, -1}), std::invalid_argument);
}

TEST_CASE("parents_first orders bones so that parents come before their children", "[layers]") {
    CHECK(parents_first(std::array{2, -1, 1, 0}) == std::vector<int>{1, 2, 0, 3});
}

TEST_CASE("the feather of a mask spreads over the given number of bones", "[layers]") {
    //   0 - 1 - 2 - 3 - 4, and 5 with 6 on its own
    const std::array parents{-1, 0, 1, 2, 3, -1, 5};
    const std::array chosen{0.0, 1.0, 1.0, 0.5, 1.0, 1.0, 1.0};
    std::vector<double> mask(7);
    const auto soften = [&](int feather) {
        feathered(parents, parents_first(parents), chosen, feather, mask);
        return mask;
    };
    CHECK(soften(0) == std::vector<double>(chosen.begin(), chosen.end()));
    CHECK(soften(1) == std::vector<double>{0, 0.5, 1, 0.5, 1, 1, 1});
    const std::vector<double> wide = soften(3);
    CHECK(wide[1] == Approx(0.25));
    CHECK(wide[2] == Approx(0.5));
    CHECK(wide[3] == Approx(0.375));
    CHECK(wide[4] == Approx(1.0));
    CHECK(wide[5] == 1.0);  // without a bone above there is no border
}
