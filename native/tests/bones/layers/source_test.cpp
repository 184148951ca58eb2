#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "motus/bones/layers/stack.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::layers;
using motus::fcurve::FCurve;
using motus::fcurve::Interpolation;
using motus::fcurve::Key;
using std::numbers::pi;

namespace {

constexpr unsigned all = location | rotation | scale;
const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

double distance(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

/// Turned by up to `most`.
Transform drawn(test::Random& random, double most) {
    const glm::dvec3 place = random.in_cube();
    const glm::dquat turn = random.rotation(most);
    const glm::dvec3 size = glm::dvec3(1.25) + random.in_cube(0.75);
    return {place, turn, size};
}

/// A clip that says all of some of four bones, whatever it is told.
struct Told {
    std::vector<int> bones;
    Clip clip;
    std::vector<double> given;

    explicit Told(std::vector<int> of) : bones(std::move(of)), clip(made(bones)) {}

    static Clip made(const std::vector<int>& bones) {
        std::vector<ClipCurve> curves;
        for (const int bone : bones)
            for (int channel = 0; channel < channel_count; ++channel) curves.push_back({bone, channel, -1});
        return {std::array<Rotation, 4>{}, curves, {}};
    }

    void tell(const std::vector<Transform>& said) {
        given.clear();
        for (const Transform& one : said) {
            const glm::dquat& q = one.rotation;
            given.insert(given.end(), {one.location.x, one.location.y, one.location.z, q.w, q.x, q.y, q.z,
                                       one.scale.x, one.scale.y, one.scale.z});
        }
    }
};

/// A chain of four bones, with a layer that says something of bones 1 to 3.
struct Rig {
    std::vector<glm::dquat> rest;
    std::vector<double> mask{1, 1, 1, 1};
    Stack stack;

    Rig() : rest(rests()), stack(std::array{-1, 0, 1, 2}, rest, std::array<char, 4>{1, 1, 0, 1}) {}

    static std::vector<glm::dquat> rests() {
        std::vector<glm::dquat> found;
        found.reserve(4);
        for (int bone = 0; bone < 4; ++bone) found.push_back(glm::angleAxis(0.4 * bone, x));
        return found;
    }

    [[nodiscard]] Layer layer(const Told& told) const {
        Layer made;
        made.clip = &told.clip;
        made.given = told.given;
        made.mask = mask;
        made.timing.after = After::hold;
        return made;
    }

    [[nodiscard]] std::vector<Transform> lay(const std::vector<Layer>& layers,
                                             const std::vector<Transform>& base) const {
        std::vector<Transform> result(4);
        std::vector<char> changed(4);
        stack.solve(1.0, layers, base, result, changed);
        return result;
    }

    struct Source {
        std::vector<Transform> said;
        std::vector<unsigned> reached;
    };
    [[nodiscard]] Source find(const std::vector<Layer>& layers, std::size_t edited,
                              const std::vector<Transform>& base, const std::vector<Transform>& wanted,
                              const std::vector<int>& chosen) const {
        Source found{std::vector<Transform>(chosen.size()), std::vector<unsigned>(chosen.size())};
        stack.find_source(1.0, layers, edited, base, wanted, chosen, found.said, found.reached);
        return found;
    }
};

std::vector<Transform> drawn_pose(test::Random& random, double most, std::size_t count = 4) {
    std::vector<Transform> pose;
    for (std::size_t bone = 0; bone < count; ++bone) pose.push_back(drawn(random, most));
    return pose;
}

void check_same(const Transform& found, const Transform& wanted) {
    CHECK(glm::length(found.location - wanted.location) < 1e-9);
    CHECK(distance(found.rotation, wanted.rotation) < 1e-9);
    CHECK(glm::length(found.scale - wanted.scale) < 1e-9);
}

}  // namespace

TEST_CASE("what a source is found to be makes the wanted pose, below and above other layers", "[layers]") {
    test::Random random(71);
    const Rig rig;
    for (int turn = 0; turn < 400; ++turn) {
        Told lower({0, 1, 2, 3}), edited({1, 2, 3}), upper({0, 2, 3}), top({1, 3});
        lower.tell(drawn_pose(random, 1.0));
        edited.tell(drawn_pose(random, 1.0, 3));
        upper.tell(drawn_pose(random, 0.3, 3));
        top.tell(drawn_pose(random, 0.3, 2));
        const std::vector<Transform> reference = drawn_pose(random, 0.5, 3);
        std::vector<Layer> layers{rig.layer(lower), rig.layer(edited), rig.layer(upper), rig.layer(top)};
        const auto flag = [&](int bit) { return (turn >> bit) % 2 == 1; };
        layers[0].weight = 0.5;
        layers[1].weight = flag(0) ? 1.0 : 0.3;
        layers[1].mode = flag(1) ? LayerMode::additive : LayerMode::override;
        layers[1].in_armature = flag(2);
        if (flag(1) && flag(5)) layers[1].reference = reference;
        layers[2].weight = 0.3;
        layers[2].in_armature = flag(3);
        layers[3].mode = LayerMode::additive;
        layers[3].in_armature = flag(4);
        const std::vector<Transform> base = drawn_pose(random, 0.3);
        // What is wanted lies within what 0.3 of a half turn reaches.
        std::vector<Transform> wanted = rig.lay(layers, base);
        const std::vector<int> chosen{1, 2, 3};
        for (const int bone : chosen) {
            Transform& one = wanted[static_cast<std::size_t>(bone)];
            const Transform more = drawn(random, 0.1);
            one = {one.location + more.location, normalized_product(one.rotation * more.rotation),
                   one.scale * more.scale};
        }
        const Rig::Source found = rig.find(layers, 1, base, wanted, chosen);
        edited.tell(found.said);
        layers[1].given = edited.given;
        const std::vector<Transform> seen = rig.lay(layers, base);
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            INFO(turn << ' ' << chosen[i]);
            CHECK(found.reached[i] == all);
            const auto bone = static_cast<std::size_t>(chosen[i]);
            check_same(seen[bone], wanted[bone]);
        }
    }
}

TEST_CASE("a source by its formula", "[layers]") {
    const Rig rig;
    Told told({1});
    told.tell({Transform{}});
    Layer layer = rig.layer(told);
    layer.weight = 0.3;
    std::vector<Transform> base(4), wanted(4);
    base[1] = {{1, 2, 3}, glm::angleAxis(0.2, x), {1, 2, 4}};
    wanted = base;
    wanted[1] = {{1.3, 2, 3}, glm::angleAxis(0.2, x) * glm::angleAxis(0.15, y), {1.3, 2, 4}};
    SECTION("override") {
        const Rig::Source found = rig.find({layer}, 0, base, wanted, {1});
        CHECK(found.reached[0] == all);
        check_same(found.said[0], {{2, 2, 3}, glm::angleAxis(0.2, x) * glm::angleAxis(0.5, y), {2, 2, 4}});
    }
    SECTION("additive, over a reference") {
        const std::array reference{Transform{{5, 0, 0}, glm::angleAxis(0.7, z), {2, 1, 1}}};
        layer.mode = LayerMode::additive;
        layer.reference = reference;
        const Rig::Source found = rig.find({layer}, 0, base, wanted, {1});
        CHECK(found.reached[0] == all);
        check_same(found.said[0], {{6, 0, 0}, glm::angleAxis(0.7, z) * glm::angleAxis(0.5, y), {4, 1, 1}});
    }
    SECTION("steady in the armature") {
        layer.weight = 1.0;
        layer.in_armature = true;
        wanted[0].rotation = base[0].rotation = glm::angleAxis(0.9, z);  // which the layer does not say
        const Rig::Source found = rig.find({layer}, 0, base, wanted, {1});
        const glm::dquat from_parent = rig.rest[1];
        check_same({{}, found.said[0].rotation, {1, 1, 1}},
                   {{},
                    glm::conjugate(from_parent) * wanted[0].rotation * from_parent * wanted[1].rotation,
                    {1, 1, 1}});
    }
}

TEST_CASE("what no source can make is told", "[layers]") {
    const Rig rig;
    Told told({1}), cover({1});
    told.tell({Transform{}});
    cover.tell({Transform{}});
    std::vector<Layer> layers{rig.layer(told), rig.layer(cover)};
    std::vector<Transform> base(4), wanted(4);
    wanted[1].rotation = glm::angleAxis(1.0, y);
    SECTION("a layer above hides it") {
        CHECK(rig.find(layers, 0, base, wanted, {1}).reached[0] == no_channel);
        layers[1].weight = 0.9;
        const Rig::Source found = rig.find(layers, 0, base, wanted, {1});
        CHECK(found.reached[0] == (location | scale));
        CHECK(distance(found.said[0].rotation, glm::angleAxis(pi, y)) < 1e-7);
    }
    SECTION("the layer has no share") {
        layers[0].weight = 0.0;
        const Rig::Source found = rig.find(layers, 0, base, wanted, {1});
        CHECK(found.reached[0] == no_channel);
        CHECK(found.said[0].rotation == base[1].rotation);
    }
    SECTION("more than half a turn") {
        layers.pop_back();
        layers[0].weight = 0.3;
        CHECK(rig.find(layers, 0, base, wanted, {1}).reached[0] == (location | scale));
        layers[0].weight = 0.32;
        CHECK(rig.find(layers, 0, base, wanted, {1}).reached[0] == all);
    }
    SECTION("a scale of what is 0") {
        layers.pop_back();
        layers[0].mode = LayerMode::additive;
        base[1].scale.x = 0.0;
        CHECK(rig.find(layers, 0, base, wanted, {1}).reached[0] == (location | rotation));
        wanted[1].scale.x = 0.0;
        CHECK(rig.find(layers, 0, base, wanted, {1}).reached[0] == all);
    }
    SECTION("numbers that are not finite") {
        layers.pop_back();
        wanted[1].location.x = std::numeric_limits<double>::infinity();
        const Rig::Source found = rig.find(layers, 0, base, wanted, {1});
        CHECK(found.reached[0] == no_channel);
        CHECK(is_finite(found.said[0]));
    }
}

TEST_CASE("a bone that goes around has a source where the whole layer counts", "[layers]") {
    const std::array modes{Rotation::xyz, Rotation::xyz, Rotation::xyz, Rotation::xyz};
    const auto end = static_cast<float>(4.0 * pi);
    const FCurve twice({Key{{1, 0}, {1, 0}, {1, 0}, Interpolation::linear},
                        Key{{49, end}, {49, end}, {49, end}, Interpolation::linear}},
                       false);
    const Clip clip(modes, std::vector<ClipCurve>{{1, 4, 0}}, std::array{twice});
    const std::array laps{Lap{{}, {0, end, 0, 0}}};
    const Rig rig;
    for (const bool in_armature : {false, true}) {
        Layer layer;
        layer.clip = &clip;
        layer.mask = rig.mask;
        layer.laps = laps;
        layer.timing.last = 49;
        layer.timing.after = After::hold;
        layer.in_armature = in_armature;
        layer.weight = 0.5;
        const std::vector<Transform> base(4);
        CHECK((rig.find({layer}, 0, base, base, {1}).reached[0] & rotation) == 0);
        // Above the edited layer it is taken off by the share of its turns.
        Told told({1});
        told.tell({Transform{}});
        const std::vector<Layer> layers{rig.layer(told), layer};
        Told near({1});
        near.tell({Transform{{}, glm::angleAxis(0.3, x), {1, 1, 1}}});
        std::vector<Transform> wanted(4), result(4);
        std::vector<char> changed(4);
        rig.stack.solve(20.0, std::vector{rig.layer(near), layer}, base, wanted, changed);
        Rig::Source found{std::vector<Transform>(1), std::vector<unsigned>(1)};
        rig.stack.find_source(20.0, layers, 0, base, wanted, std::array{1}, found.said, found.reached);
        CHECK(found.reached[0] == all);
        told.tell(found.said);
        rig.stack.solve(20.0, std::vector{rig.layer(told), layer}, base, result, changed);
        check_same(result[1], wanted[1]);
    }
}

TEST_CASE("arguments of a source are checked", "[layers]") {
    const Rig rig;
    Told told({1});
    told.tell({Transform{}});
    const std::vector<Layer> layers{rig.layer(told)};
    const std::vector<Transform> pose(4), less(3);
    CHECK_THROWS_AS(rig.find(layers, 1, pose, pose, {1}), std::invalid_argument);
    CHECK_THROWS_AS(rig.find(layers, 0, less, pose, {1}), std::invalid_argument);
    CHECK_THROWS_AS(rig.find(layers, 0, pose, less, {1}), std::invalid_argument);
    CHECK_THROWS_AS(rig.find(layers, 0, pose, pose, {4}), std::invalid_argument);
    CHECK_THROWS_AS(rig.find(layers, 0, pose, pose, {-1}), std::invalid_argument);
}
