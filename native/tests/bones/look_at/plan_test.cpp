#include "motus/bones/look_at/plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "figure.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::look_at;
using namespace motus::bones::look_at::checks;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180.0;

}  // namespace

TEST_CASE("the original's weights on bones: 9 degrees for the body, the rest for the head", "[rig_look_at]") {
    Figure figure(3);
    const double far = 1e9;  // if the body's turn moves the target by nothing
    figure.input.target = glm::angleAxis(-30 * degree, glm::dvec3(0, 0, 1)) * glm::dvec3(0, -far, 0);
    const Result result = solve(figure);
    const glm::dvec3 z(0, 0, 1);
    for (int i = 0; i < 3; ++i) {
        CHECK(angle_between(in_pose(figure, result, 1 + i), glm::angleAxis(-3 * (i + 1) * degree, z)) < 1e-8);
        const glm::dquat own = result.rotations[static_cast<std::size_t>(i)];
        CHECK(angle_between(own, glm::angleAxis(-3 * degree, glm::dvec3(0, 1, 0))) < 1e-8);
    }
    CHECK(angle_between(in_pose(figure, result, 4), glm::angleAxis(-30 * degree, z)) < 1e-8);
    CHECK(is_identity(result.rotations[4]));
    CHECK(is_identity(result.rotations[5]));
    CHECK(result.report.angle < 1e-12);
    CHECK(result.report.reason == Reason::reached);
    CHECK(result.report.yaw == Approx(-30 * degree));
    CHECK(result.report.pitch == Approx(0.0).margin(1e-8));
}

TEST_CASE("a head of full weight meets near targets, whatever the spine", "[rig_look_at]") {
    Randomness random(1);
    for (int spine_bones = 0; spine_bones <= 10; ++spine_bones) {
        for (int i = 0; i < 100; ++i) {
            Figure figure = animated(spine_bones, random, 0.0);
            figure.input.settings.eyes_weight = 0.0;
            figure.input.settings.body_weight = random.between(0.0, 1.0);
            if (i % 2 == 0)
                figure.input.target = glm::dvec3(figure.world * glm::dvec4(random.around_origin(0.5), 1.0));
            const Result result = solve(figure);
            CHECK(miss(figure, result, figure.bones.head, figure.input.head_forward) < 1e-9);
            CHECK(result.report.angle < 1e-9);
            CHECK(result.report.reason == Reason::reached);
        }
    }
}

TEST_CASE("scales, shears and modes of inheritance don't keep gazes off their targets", "[rig_look_at]") {
    Randomness random(2);
    for (int i = 0; i < 2000; ++i) {
        Figure figure = animated(3, random, 0.4);
        figure.world = random.pose(1.0, 3.0, 0.4);
        for (int& flags : figure.inheritance) {
            flags = static_cast<int>(random.between(0.0, 5.999));
            if (random.between(0.0, 1.0) < 0.8) flags |= inherits_rotation;
            if (random.between(0.0, 1.0) < 0.8) flags |= has_local_location;
        }
        if (i % 3 == 0) {
            figure.input.head_forward = random.around_origin(1.0);
            for (glm::dvec3& forward : figure.eyes_forward) forward = random.around_origin(1.0);
            figure.input.up = random.around_origin(1.0);
        }
        const Result result = solve(figure);
        CHECK(miss(figure, result, figure.bones.head, figure.input.head_forward) < 1e-9);
        for (std::size_t eye = 0; eye < figure.bones.eyes.size(); ++eye)
            CHECK(miss(figure, result, figure.bones.eyes[eye], figure.eyes_forward[eye]) < 1e-9);
        CHECK(result.report.angle < 1e-9);
    }
}

TEST_CASE("a rig with other forward and up axes looks as the upright one does", "[rig_look_at]") {
    // Y up and Z ahead, as in other programs: the same bones, seen in axes turned by a quarter about X.
    Figure upright(3);
    upright.input.settings.eyes_weight = 0.5;
    upright.input.settings.head_limit = 1.0;
    upright.input.target = {0.7, -1.1, 2.3};
    Figure turned = upright;
    const glm::dmat4 axes = glm::mat4_cast(glm::angleAxis(-0.5 * pi, glm::dvec3(1, 0, 0)));
    for (int bone = 0; bone < static_cast<int>(turned.parents.size()); ++bone) {
        const auto index = static_cast<std::size_t>(bone);
        turned.set(turned.rest, bone, axes * matrix_at(upright.rest, index));
        turned.set(turned.poses, bone, axes * matrix_at(upright.poses, index));
    }
    turned.world = upright.world * glm::inverse(axes);
    turned.input.up = {0, 1, 0};
    const Result wanted = solve(upright), found = solve(turned);
    for (std::size_t i = 0; i < wanted.rotations.size(); ++i)
        CHECK(angle_between(found.rotations[i], wanted.rotations[i]) < 1e-6);  // rest is single precision
    CHECK(found.report.pitch == Approx(wanted.report.pitch).margin(1e-6));
    CHECK(found.report.yaw == Approx(wanted.report.yaw).margin(1e-6));
}

TEST_CASE("eyes take what the head leaves, each from its own place", "[rig_look_at]") {
    Figure figure(2);
    figure.input.settings.head_weight = 0.0;
    figure.input.settings.body_weight = 0.0;
    figure.input.settings.eyes_weight = 1.0;
    figure.input.target = {0.0, -0.5, 1.28};  // between the eyes, 0.4 before them
    const Result result = solve(figure);
    CHECK(is_identity(result.rotations[2]));
    const double inwards = std::atan2(0.03, 0.4);
    CHECK(angle_between(in_pose(figure, result, 4), glm::angleAxis(-inwards, glm::dvec3(0, 0, 1))) < 1e-7);
    CHECK(angle_between(in_pose(figure, result, 5), glm::angleAxis(inwards, glm::dvec3(0, 0, 1))) < 1e-7);
    CHECK(result.report.angle < 1e-9);

    figure.input.settings.eyes_limit = 2 * degree;
    const Result limited = solve(figure);
    CHECK(angle_between(in_pose(figure, limited, 4), glm::dquat(1, 0, 0, 0)) <= 2 * degree + 1e-9);
    CHECK(limited.report.angle == Approx(inwards - 2 * degree).epsilon(0.02));
    CHECK(limited.report.reason == Reason::limit);
}

TEST_CASE("several targets are blended by weight, opposed ones too", "[rig_look_at]") {
    Figure figure(0);
    const glm::dvec3 head(0.0, 0.0, 1.0);
    const auto at = [&](double yaw) { return head + 5.0 * glm::dvec3(std::sin(yaw), -std::cos(yaw), 0.0); };
    const auto turned_by = [&] { return in_pose(figure, solve(figure), figure.bones.head); };
    const auto about_z = [](double angle) { return glm::angleAxis(angle, glm::dvec3(0, 0, 1)); };
    figure.input.target = at(60 * degree);
    std::vector<GazeTarget> further{{at(-20 * degree), 1.0}};
    figure.input.further = further;
    CHECK(angle_between(turned_by(), about_z(20 * degree)) < 1e-7);
    figure.input.target_weight = 3.0;  // only the ratio counts above a sum of 1
    CHECK(angle_between(turned_by(), about_z(40 * degree)) < 1e-7);
    figure.input.target_weight = 0.0;
    CHECK(angle_between(turned_by(), about_z(-20 * degree)) < 1e-7);
    // Weights whose sum, or whose product with an angle, is beyond double precision.
    for (const double huge : {1e308, 1.7e308}) {
        figure.input.target_weight = further[0].weight = huge;
        CHECK(angle_between(turned_by(), about_z(20 * degree)) < 1e-7);
        further.assign(9, {at(60 * degree), huge});
        figure.input.further = further;
        CHECK(angle_between(turned_by(), about_z(60 * degree)) < 1e-7);
        further.assign(1, {at(-20 * degree), 1.0});
        figure.input.further = further;
        CHECK(angle_between(turned_by(), about_z(60 * degree)) < 1e-7);
    }
    figure.input.target_weight = 0.0;
    further[0].weight = 0.25;  // the animated gaze takes the rest
    CHECK(angle_between(turned_by(), about_z(-5 * degree)) < 1e-7);
    further[0].weight = -1.0;
    CHECK(is_still(solve(figure)));

    further[0] = {at(-120 * degree), 1.0};
    figure.input.target = at(120 * degree);
    figure.input.target_weight = 1.0;
    CHECK(angle_between(turned_by(), about_z(0.0)) < 1e-7);
    CHECK(solve(figure).report.angle < 1e-9);

    further[0].weight = std::numeric_limits<double>::quiet_NaN();
    CHECK(is_still(solve(figure)));
    CHECK(!solve(figure).report.reason);
}

TEST_CASE("a further target without weight changes nothing", "[rig_look_at]") {
    Randomness random(11);
    for (int i = 0; i < 50; ++i) {
        Figure figure = animated(3, random, 0.1);
        const Result alone = solve(figure);
        const std::vector<GazeTarget> further{{random.around_origin(4.0), 0.0}};
        figure.input.further = further;
        const Result with_further = solve(figure);
        for (std::size_t row = 0; row < alone.rotations.size(); ++row)
            CHECK(angle_between(alone.rotations[row], with_further.rotations[row]) < 1e-7);
    }
}

TEST_CASE("without a turn every row is the identity, bit for bit", "[rig_look_at]") {
    Randomness random(3);
    for (int i = 0; i < 300; ++i) {
        Figure figure = animated(3, random, i % 2 == 0 ? 0.0 : 0.3);
        switch (i % 5) {
            case 0:
                figure.input.settings.weight = 0.0;
                break;
            case 1:
                figure.input.is_on = false;
                break;
            case 2:
                figure.input.settings.clamp = 1.0;
                break;
            case 3:
                figure.input.settings.body_weight = figure.input.settings.head_weight = 0.0;
                figure.input.settings.eyes_weight = 0.0;
                break;
            default:
                figure.input.settings.body_limit = figure.input.settings.head_limit = 0.0;
                figure.input.settings.eyes_limit = 0.0;
        }
        const Result result = solve(figure);
        CHECK(is_still(result));
        CHECK(result.report.reason.has_value());
    }
}

TEST_CASE("a target at the head keeps the animated gaze", "[rig_look_at]") {
    Figure figure(2);
    figure.input.target = {0.0, 0.0, static_cast<double>(1.2f)};
    const Result result = solve(figure);
    CHECK(is_still(result));
    CHECK(result.report.reason == Reason::reached);
}

TEST_CASE("a look that limits stop is reported as limited", "[rig_look_at]") {
    Figure figure(2);
    figure.input.settings.body_limit = 10 * degree;
    figure.input.settings.head_limit = 40 * degree;
    figure.input.target = {10.0, 0.0, 1.2};  // to its left
    const Result result = solve(figure);
    CHECK(angle_between(in_pose(figure, result, 2), glm::dquat(1, 0, 0, 0)) <= 10 * degree + 1e-9);
    CHECK(angle_between(in_pose(figure, result, 3), glm::dquat(1, 0, 0, 0)) ==
          Approx(50 * degree).epsilon(1e-6));
    CHECK(result.report.angle == Approx(40 * degree).epsilon(1e-6));
    CHECK(result.report.reason == Reason::limit);
    CHECK(result.report.yaw == Approx(90 * degree));
}

TEST_CASE("a look that falls short by its weights alone is not reported as limited", "[rig_look_at]") {
    Figure figure(2);
    figure.input.settings.weight = 0.5;
    figure.input.target = {10.0, -10.0, 1.2};
    const Result result = solve(figure);
    CHECK(result.report.angle == Approx(22.5 * degree).epsilon(1e-3));
    CHECK(result.report.reason == Reason::reached);
}

TEST_CASE("bones between the spine bones of a look carry these along", "[rig_look_at]") {
    Figure figure(5);
    figure.bones.body = {2, 4};
    figure.input.target = {1.0, -0.7, 1.9};
    const Result result = solve(figure);
    REQUIRE(result.rotations.size() == 5);
    CHECK(miss(figure, result, figure.bones.head, figure.input.head_forward) < 1e-9);
    CHECK_FALSE(is_identity(result.rotations[0]));
    CHECK(angle_between(result.rotations[0], result.rotations[1]) < 0.05);
}

TEST_CASE("the head's target going round: no jump on bones", "[rig_look_at]") {
    Figure figure(3);
    figure.input.settings = {1.0, 0.3, 1.0, 0.7, 0.5, 60 * degree, 80 * degree, 35 * degree};
    constexpr int count = 3000;
    for (const double height : {0.0, 0.8, 1.4, 2.5}) {
        Result last;
        for (int i = 0; i <= count; ++i) {
            const double angle = 2 * pi * i / count;
            figure.input.target = {2 * std::sin(angle), -2 * std::cos(angle), height};
            Result now = solve(figure);
            for (std::size_t row = 0; i > 0 && row < now.rotations.size(); ++row)
                CHECK(angle_between(now.rotations[row], last.rotations[row]) < 8.0 * 2 * pi / count);
            last = std::move(now);
        }
    }
}

TEST_CASE("numbers that are not finite leave their entry alone, others are solved", "[rig_look_at]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    Figure good(2);
    good.input.target = {1, -1, 1};
    good.input.settings.eyes_weight = 0.5;
    std::vector<Figure> bad(9, good);
    bad[0].input.target.x = nan;
    bad[1].input.settings.clamp = infinity;
    bad[2].input.head_forward = {0, 0, 0};
    bad[3].basis[16 * 1 + 5] = static_cast<float>(nan);
    bad[4].basis[16 * 3 + 13] = static_cast<float>(infinity);
    bad[5].poses[3] = bad[5].poses[1] = static_cast<float>(nan);
    bad[6].world = glm::dmat4(0.0);
    bad[7].set(bad[7].basis, 3, glm::dmat4(0.0));
    bad[8].basis[16 * 4 + 14] = static_cast<float>(nan);
    for (const Figure& figure : bad) {
        const Result result = solve(figure);
        CHECK(is_still(result));
        CHECK_FALSE(result.report.reason.has_value());
        CHECK((result.report.angle == 0.0 && result.report.yaw == 0.0 && result.report.pitch == 0.0));
    }

    const GazePlan plan(good.parents, std::vector<GazeBones>(2, good.bones));
    std::vector<GazeInput> inputs(2, good.input);
    for (GazeInput& input : inputs) input.eyes_forward = good.eyes_forward;
    inputs[0].target.x = nan;
    std::vector<glm::dquat> rotations(plan.rows().size());
    std::vector<GazeDiagnostics> reports(2);
    plan.solve(good.view(), good.world, inputs, rotations, reports);
    CHECK_FALSE(reports[0].reason.has_value());
    const Result alone = solve(good);
    CHECK(reports[1].angle == alone.report.angle);
    for (std::size_t i = 0; i < 5; ++i) CHECK(rotations[5 + i] == alone.rotations[i]);
}

TEST_CASE("any finite rig gives finite results", "[rig_look_at]") {
    Randomness random(7);
    for (int i = 0; i < 5000; ++i) {
        Figure figure = animated(static_cast<int>(random.between(0.0, 5.9)), random, i % 2 == 0 ? 1.5 : 0.1);
        for (int& flags : figure.inheritance) flags = static_cast<int>(random.between(0.0, 31.9));
        figure.input.settings = {random.between(-1.0, 2.0), random.between(-1.0, 2.0),
                                 random.between(-1.0, 2.0), random.between(-1.0, 2.0),
                                 random.between(-1.0, 2.0), random.between(-1.0, 6.0),
                                 random.between(-1.0, 6.0), random.between(-1.0, 6.0)};
        if (i % 7 == 0) {
            const int bone =
                static_cast<int>(random.between(1.0, static_cast<double>(figure.parents.size()) - 0.1));
            figure.basis[static_cast<std::size_t>(16 * bone + i % 16)] = i % 14 == 0 ? 0.0f : 3e38f;
        }
        if (i % 11 == 0) figure.input.target *= 1e200;
        const Result result = solve(figure);
        for (const glm::dquat& q : result.rotations) {
            CHECK(glm::length(q) == Approx(1.0).epsilon(1e-9));
            CHECK(q.w >= 0.0);
        }
        CHECK(std::isfinite(result.report.angle));
        CHECK(std::isfinite(result.report.yaw + result.report.pitch));
    }
}

TEST_CASE("plans refuse bones that are not above each other", "[rig_look_at]") {
    const std::vector<int> parents{-1, 0, 1, 2, 2, 0};
    const auto plan = [&](const GazeBones& bones) { return GazePlan(parents, {&bones, 1}); };
    const GazePlan good = plan({{0, 1}, 2, {3, 4}});
    CHECK(std::vector<int>(good.rows().begin(), good.rows().end()) == std::vector<int>{0, 1, 2, 3, 4});
    for (const GazeBones& bones : std::vector<GazeBones>{{{}, 6, {}},
                                                         {{}, -1, {}},
                                                         {{1, 0}, 2, {}},
                                                         {{0, 0}, 2, {}},
                                                         {{5}, 2, {}},
                                                         {{2}, 2, {}},
                                                         {{0, 9}, 2, {}},
                                                         {{0}, 2, {2}},
                                                         {{0}, 2, {1}},
                                                         {{0}, 2, {5}}})
        CHECK_THROWS_AS(plan(bones), std::invalid_argument);
    const std::vector<int> ring{1, 0}, wrong{7};
    const GazeBones head{{}, 0, {}};
    CHECK_THROWS_AS(GazePlan(ring, {&head, 1}), std::invalid_argument);
    CHECK_THROWS_AS(GazePlan(wrong, {&head, 1}), std::invalid_argument);

    const Figure figure(1);
    GazeDiagnostics report;
    std::vector<glm::dquat> rows(9);
    GazeInput input = figure.input;
    input.eyes_forward = figure.eyes_forward;
    CHECK_THROWS_AS(good.solve(figure.view(), figure.world, {&input, 1}, rows, {&report, 1}),
                    std::invalid_argument);
    const GazePlan eyed(figure.parents, {&figure.bones, 1});
    rows.resize(eyed.rows().size());
    input.eyes_forward = input.eyes_forward.first(1);
    CHECK_THROWS_AS(eyed.solve(figure.view(), figure.world, {&input, 1}, rows, {&report, 1}),
                    std::invalid_argument);
    // Another rig of as many bones.
    Figure same(2);
    std::vector<int> others = same.parents;
    others[2] = 0;
    const GazePlan own(same.parents, {&head, 1});
    std::vector<glm::dquat> row(1);
    CHECK_NOTHROW(own.solve(same.view(), same.world, {&same.input, 1}, row, {&report, 1}));
    same.parents = others;
    CHECK_THROWS_AS(own.solve(same.view(), same.world, {&same.input, 1}, row, {&report, 1}),
                    std::invalid_argument);
}
