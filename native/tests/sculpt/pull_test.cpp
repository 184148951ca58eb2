#include "motus/sculpt/pull.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "checks.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::sculpt;
using namespace motus::sculpt::checks;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Stretched, turned and sheared.
const glm::mat3 world{1.5f, 0.2f, 0.0f, -0.3f, 0.7f, 0.1f, 0.0f, 0.4f, 2.0f};

/// Turned about (1, 2, 2) and stretched along the axes, not sheared.
const glm::mat3 stretched =
    glm::mat3(glm::mat3_cast(glm::angleAxis(0.7, glm::dvec3(1.0, 2.0, 2.0) / 3.0)) *
              glm::dmat3(glm::dvec3(1.5, 0, 0), glm::dvec3(0, 0.6, 0), glm::dvec3(0, 0, 2.0)));

}  // namespace

TEST_CASE("a pull moves its root by the whole displacement, and a vertex at half the radius by half",
          "[pull]") {
    const std::vector<glm::vec3> points{{1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {1, 1, 4}, {1, 0.5f, 1}};
    Dab dab;
    dab.root = {1, 1, 1};
    dab.displacement = {0, 0, 4};
    dab.radius = 2.0f;
    const std::vector<glm::vec3> found = pulled(points, dab);
    CHECK(found[0] == glm::vec3(1, 1, 5));
    CHECK(found[1] == glm::vec3(2, 1, 3));
    CHECK(found[2] == points[2]);  // exactly at the radius
    CHECK(found[3] == points[3]);
    CHECK(found[4].z == Approx(1.0 + 4.0 * 0.84375));
}

TEST_CASE("the original's formula, which compares the square with R", "[pull]") {
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {1.9f, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    Dab dab;
    dab.displacement = {0, 0, 10};
    dab.radius = 4.0f;
    dab.profile = {Falloff::classic, 1.0f, {}};
    const std::vector<glm::vec3> found = pulled(points, dab);
    CHECK(found[0].z == Approx(10.0));
    CHECK(found[1].z == Approx(10.0 * 0.8 * 0.8));
    CHECK(found[2].z == Approx(10.0 * std::pow(1.0 - 3.61 / 5.0, 2.0)));
    CHECK(found[3].z == 0.0f);
    CHECK(found[4].z == 0.0f);
}

TEST_CASE("pulls agree with the formula for every falloff, mirror, metric and weight", "[pull]") {
    const std::vector<glm::vec3> points = cloud(5003);  // not a multiple of any vector's length
    const std::vector<float> weights = random_weights(points.size());
    const std::vector<float> curve{0.0f, 0.8f, -0.5f, 1.0f};
    for (const Falloff falloff : {Falloff::classic, Falloff::smooth, Falloff::sphere, Falloff::linear,
                                  Falloff::sharp, Falloff::constant, Falloff::gaussian, Falloff::curve}) {
        for (const unsigned mirror : {0u, 1u, 6u, 7u}) {
            for (const glm::mat3& metric : {glm::mat3(1.0f), stretched, world}) {
                Dab dab = sample_dab();
                // Off by rounding, a vertex may fall on either side of the radius: a step for `constant`
                // alone.
                dab.profile = {falloff, 1.5f, curve};
                dab.mirror = mirror;
                dab.metric = metric;
                INFO("falloff " << static_cast<int>(falloff) << ", mirror " << mirror << ", metric "
                                << metric[0].x);
                CHECK(error(points, dab, pulled(points, dab)) < 2e-6);
                CHECK(error(points, dab, pulled(points, dab, weights), weights) < 2e-6);
            }
        }
    }
}

TEST_CASE("a metric that turns and scales all directions alike is another radius", "[pull]") {
    const std::vector<glm::vec3> points = cloud(5003);
    const glm::mat3 turn = glm::mat3_cast(glm::angleAxis(0.8f, glm::normalize(glm::vec3(0.3f, 1.0f, -0.5f))));
    for (const Falloff falloff : {Falloff::smooth, Falloff::sphere, Falloff::linear, Falloff::gaussian}) {
        for (const float size : {1e-9f, 1e-3f, 0.4f, 1.0f, 40.0f, 1e6f, 1e9f}) {
            for (const float mirrored : {1.0f, -1.0f}) {
                Dab dab = sample_dab();
                dab.profile = {falloff, 0.0f, {}};
                const std::vector<glm::vec3> wanted = pulled(points, dab);
                dab.metric = mirrored * size * turn;
                dab.radius *= size;
                const std::vector<glm::vec3> found = pulled(points, dab);
                double largest = 0.0;
                for (std::size_t i = 0; i < points.size(); ++i)
                    largest = std::max(largest, glm::distance(glm::dvec3(found[i]), glm::dvec3(wanted[i])));
                INFO("falloff " << static_cast<int>(falloff) << ", size " << mirrored * size);
                // The sphere's edge is steep.
                CHECK(largest < (falloff == Falloff::sphere ? 5e-4 : 2e-6));
            }
        }
    }
}

TEST_CASE("falloff constant moves all vertices within the radius alike and none beyond", "[pull]") {
    const std::vector<glm::vec3> points = cloud(20000);
    Dab dab = sample_dab();
    dab.profile.falloff = Falloff::constant;
    const std::vector<glm::vec3> found = pulled(points, dab);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = glm::distance(glm::dvec3(points[i]), glm::dvec3(dab.root));
        if (std::abs(distance - 0.7) < 1e-6) continue;
        CHECK(found[i] == (distance < 0.7 ? points[i] + dab.displacement : points[i]));
        moved += distance < 0.7 ? 1 : 0;
    }
    CHECK(moved > 1000);
}

TEST_CASE("vertices that a pull does not move keep their bits", "[pull]") {
    std::vector<glm::vec3> points = cloud(1000);
    for (glm::vec3& p : points) p.x = -0.0f;  // to which adding zero gives +0
    Dab dab = sample_dab();
    dab.minimum = dab.maximum = 0.25f;  // of those that move
    SECTION("out of reach") {
        dab.root = {50, 50, 50};
        CHECK(same_bits(pulled(points, dab), points));
    }
    SECTION("without weight") {
        std::vector<float> weights(points.size(), 0.0f);
        CHECK(same_bits(pulled(points, dab, weights), points));
        weights[17] = 1.0f;
        dab.root = points[17];
        std::vector<glm::vec3> found = pulled(points, dab, weights);
        CHECK(found[17] == glm::vec3(points[17].x + 0.1f, points[17].y + 0.3f, 0.25f));
        found[17] = points[17];
        CHECK(same_bits(found, points));
    }
}

TEST_CASE("moved vertices stay between minimum and maximum on the axis", "[pull]") {
    const std::vector<glm::vec3> points = cloud(4000);
    for (const int axis : {0, 1, 2}) {
        Dab dab = sample_dab();
        dab.displacement = {3, 3, 3};
        dab.clamp_axis = axis;
        dab.minimum = -0.1f;
        dab.maximum = 0.5f;
        const std::vector<glm::vec3> found = pulled(points, dab);
        std::size_t moved = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (found[i] == points[i]) continue;
            ++moved;
            CHECK(found[i][axis] >= -0.1f);
            CHECK(found[i][axis] <= 0.5f);
        }
        CHECK(moved > 100);
        CHECK(error(points, dab, found) < 2e-6);
    }
}

TEST_CASE("a pull in place equals a pull into another array", "[pull]") {
    const std::vector<glm::vec3> points = cloud(3001);
    const std::vector<float> weights = random_weights(points.size());
    for (const unsigned mirror : {0u, 1u}) {
        Dab dab = sample_dab();
        dab.mirror = mirror;
        std::vector<glm::vec3> here = points;
        pull(here, dab, weights, here);
        CHECK(same_bits(here, pulled(points, dab, weights)));
    }
}

TEST_CASE("a mirrored pull is symmetric, and not doubled where its images meet", "[pull]") {
    std::vector<glm::vec3> points = cloud(2000);
    const std::size_t half = points.size();
    for (std::size_t i = 0; i < half; ++i) points.push_back(points[i] * glm::vec3(-1, 1, 1));
    Dab dab = sample_dab();
    dab.mirror = 1;
    const std::vector<glm::vec3> found = pulled(points, dab);
    for (std::size_t i = 0; i < half; ++i)
        CHECK(glm::distance(found[i] * glm::vec3(-1, 1, 1), found[i + half]) < 1e-6f);

    SECTION("on the plane it is the mean of the images") {
        dab.root = {0, 0, 0};
        const std::vector<glm::vec3> one{{0, 0, 0}};
        CHECK(pulled(one, dab)[0] == glm::vec3(0.0f, 0.3f, -0.2f));
    }
    SECTION("where one image reaches, it acts as if alone") {
        Dab alone = dab;
        alone.mirror = 0;
        dab.root = alone.root = {0.9f, 0, 0};
        dab.radius = alone.radius = 0.3f;
        for (const glm::vec3& p : points) {
            if (p.x > 0.0f) CHECK(pulled({&p, 1}, dab)[0] == pulled({&p, 1}, alone)[0]);
        }
    }
    SECTION("it is continuous where a second image begins to reach") {
        dab.radius = 0.5f;  // the image's root is at -0.2
        const glm::vec3 inside(0.2999f, -0.1f, 0.3f), outside(0.3001f, -0.1f, 0.3f);
        const glm::vec3 a = pulled({&inside, 1}, dab)[0] - inside,
                        b = pulled({&outside, 1}, dab)[0] - outside;
        CHECK(glm::distance(a, b) < 1e-3f);
    }
}

TEST_CASE("a mirrored dab has an image for each combination of mirror axes", "[pull]") {
    Dab dab = sample_dab();
    dab.mirror = 5;  // x, z
    const std::vector<PullImage> images = images_of(dab);
    REQUIRE(images.size() == 4);
    CHECK(images[0].root == dab.root);
    CHECK(images[1].root == dab.root * glm::vec3(-1, 1, 1));
    CHECK(images[2].root == dab.root * glm::vec3(1, 1, -1));
    CHECK(images[3].displacement == dab.displacement * glm::vec3(-1, 1, -1));
}

TEST_CASE("vertices that a tree finds are moved as if all were looked at", "[pull]") {
    const std::vector<glm::vec3> points = cloud(30000);
    const std::vector<float> weights = random_weights(points.size());
    for (const unsigned mirror : {0u, 3u}) {
        Dab dab = sample_dab();
        dab.mirror = mirror;
        dab.metric = world;
        std::vector<std::uint32_t> near;
        for (const mesh::Reach& reach : straight_reaches(points, dab))
            near.insert(near.end(), reach.vertices.begin(), reach.vertices.end());
        near.push_back(0);  // others do no harm
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        test::Random(3).shuffle(std::span(near));
        std::vector<glm::vec3> out(points.size());
        pull_among(points, dab, near, weights, out);
        CHECK(same_bits(out, pulled(points, dab, weights)));
        std::vector<glm::vec3> here = points;
        pull_among(here, dab, near, weights, here);
        CHECK(same_bits(here, out));
    }
}

TEST_CASE("distances of a pull may be measured on another shape of the mesh", "[pull]") {
    const std::vector<glm::vec3> shape = cloud(30000), points = cloud(30000, 2);
    const std::vector<float> weights = random_weights(points.size());
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0u);
    for (const unsigned mirror : {0u, 3u}) {
        for (const bool is_clamped : {false, true}) {
            Dab dab = sample_dab();
            dab.mirror = mirror;
            dab.metric = world;
            std::vector<glm::vec3> wanted = pulled(shape, dab, weights);
            for (std::size_t i = 0; i < points.size(); ++i) wanted[i] += points[i] - shape[i];
            if (is_clamped) {
                dab.minimum = -0.2f;
                dab.maximum = 0.3f;
                for (std::size_t i = 0; i < points.size(); ++i)
                    if (std::abs(wanted[i].z - points[i].z) > 1e-6f)
                        wanted[i].z = std::clamp(wanted[i].z, dab.minimum, dab.maximum);
            }
            std::vector<glm::vec3> out(points.size());
            pull(points, dab, weights, out, shape);
            float worst = 0.0f;
            for (std::size_t i = 0; i < points.size(); ++i) {
                // By so little force, it may or may not move: then it may or may not be clamped.
                const bool is_doubtful = is_clamped && glm::distance(wanted[i], points[i]) < 1e-5f;
                if (!is_doubtful) worst = std::max(worst, glm::distance(out[i], wanted[i]));
            }
            CHECK(worst < 1e-6f);
            std::vector<glm::vec3> here = points;
            pull(here, dab, weights, here, shape);
            CHECK(same_bits(here, out));
            here = points;
            pull_among(here, dab, all, weights, here, shape);
            CHECK(same_bits(here, out));
            std::vector<glm::vec3> copy(points.size());
            pull(shape, dab, {}, out, shape, copy);
            CHECK(same_bits(out, pulled(shape, dab)));
            CHECK(same_bits(copy, out));
        }
    }
}

TEST_CASE("a pull may be given distances that were measured beforehand", "[pull]") {
    const std::vector<glm::vec3> points = cloud(20000);
    const std::vector<float> weights = random_weights(points.size());
    for (const unsigned mirror : {0u, 1u, 7u}) {
        Dab dab = sample_dab();
        dab.radius = 0.5f;
        dab.mirror = mirror;
        dab.profile.falloff = Falloff::sphere;
        const std::vector<mesh::Reach> reaches = straight_reaches(points, dab);
        std::vector<glm::vec3> out(points.size());
        pull_along(points, dab, reaches, weights, out);
        CHECK(error(points, dab, out, weights) < 1e-5);  // its own rounding of distances, steep at the edge
        std::vector<glm::vec3> here = points;
        pull_along(here, dab, reaches, weights, here);
        CHECK(same_bits(here, out));
    }
    SECTION("edges are numbers as any") {
        const std::vector<glm::vec3> line{{0, 0, 0}, {5, 0, 0}, {9, 0, 0}, {10, 0, 0}};
        Dab dab;
        dab.displacement = {0, 1, 0};
        dab.radius = 3.0f;
        dab.profile.falloff = Falloff::linear;
        const std::vector<mesh::Reach> steps{{{0, 1, 2, 3}, {1, 0, 1, 3}}};
        std::vector<glm::vec3> out(4);
        pull_along(line, dab, steps, {}, out);
        CHECK(out[0].y == Approx(2.0 / 3.0));
        CHECK(out[1].y == 1.0f);
        CHECK(out[2].y == Approx(2.0 / 3.0));
        CHECK(out[3].y == 0.0f);
    }
}

TEST_CASE("a pull of no vertices, or with empty reaches, changes nothing", "[pull]") {
    std::vector<glm::vec3> none;
    CHECK_NOTHROW(pull(none, sample_dab(), {}, none));
    CHECK_NOTHROW(pull_among(none, sample_dab(), {}, {}, none));
    const std::vector<mesh::Reach> reaches(1);
    CHECK_NOTHROW(pull_along(none, sample_dab(), reaches, {}, none));
    std::vector<glm::vec3> points = cloud(10), out(10);
    pull_along(points, sample_dab(), reaches, {}, out);
    CHECK(same_bits(out, points));
}

TEST_CASE("a refused pull writes nothing", "[pull]") {
    const std::vector<glm::vec3> good = cloud(2000);
    std::vector<std::uint32_t> all(good.size());
    std::iota(all.begin(), all.end(), 0u);
    const std::vector<mesh::Reach> reaches{{all, std::vector<float>(good.size(), 0.1f)}};
    const std::vector<float> whole(good.size(), 1.0f);
    const auto leaves = [&](const std::vector<glm::vec3>& points, const std::vector<float>& weights,
                            const char* problem) {
        const Dab dab = sample_dab();
        const std::vector<glm::vec3> before(points.size(), glm::vec3(7.0f));
        const auto leave = [&](auto&& pull_into) {
            std::vector<glm::vec3> out = before, here = points;
            CHECK_THROWS_WITH(pull_into(points, out), problem);
            CHECK(same_bits(out, before));
            CHECK_THROWS_WITH(pull_into(here, here), problem);
            CHECK(same_bits(here, points));
        };
        leave([&](auto& from, auto& to) { pull(from, dab, weights, to); });
        leave([&](auto& from, auto& to) { pull_among(from, dab, all, weights, to); });
        leave([&](auto& from, auto& to) { pull_along(from, dab, reaches, weights, to); });
        leave([&](auto& from, auto& to) {
            Dab mirrored = dab;
            mirrored.mirror = 1;
            mirrored.maximum = 0.2f;
            pull(from, mirrored, weights, to);
        });
        std::vector<glm::vec3> out = before, copy = before;
        CHECK_THROWS_WITH(pull(points, dab, weights, out, good, copy), problem);
        CHECK((same_bits(out, before) && same_bits(copy, before)));
        CHECK_THROWS_WITH(pull(good, dab, weights, out, points, copy), problem);
        CHECK((same_bits(out, before) && same_bits(copy, before)));
        CHECK_THROWS_WITH(pull_among(good, dab, all, weights, out, points), problem);
        CHECK(same_bits(out, before));
    };
    for (const std::size_t at : {0u, 511u, 1999u}) {
        for (const float strange : {not_a_number, infinity, -infinity}) {
            std::vector<glm::vec3> points = good;
            points[at].y = strange;
            leaves(points, whole, "positions: every value must be finite");
        }
        for (const float strange : {not_a_number, -0.1f, 1.1f}) {
            std::vector<float> weights = whole;
            weights[at] = strange;
            leaves(good, weights, "weights: every value must lie in [0, 1]");
        }
    }
}

TEST_CASE("vertices out of a pull's reach may be at NaN or infinity", "[pull]") {
    std::vector<glm::vec3> points = cloud(100);
    points[7].x = not_a_number;
    const std::vector<std::uint32_t> near{3, 40};
    std::vector<glm::vec3> out = points;
    pull_among(points, sample_dab(), near, {}, out);
    CHECK(std::memcmp(&out[7], &points[7], sizeof out[7]) == 0);
    const std::vector<mesh::Reach> reaches{{near, {0.0f, 0.1f}}};
    pull_along(points, sample_dab(), reaches, {}, out);
    CHECK(out[3] == points[3] + sample_dab().displacement);
    // Large ones are numbers, though their squares are not.
    std::vector<glm::vec3> far{{0, 0, 0}, {3e38f, -3e38f, 1e30f}};
    Dab dab;
    dab.displacement = {0, 0, 1};
    const std::vector<glm::vec3> found = pulled(far, dab);
    CHECK(found[0].z == 1.0f);
    CHECK(found[1] == far[1]);
}

TEST_CASE("a pull refuses a shape to measure on that has a wrong size or is not finite", "[pull]") {
    const std::vector<glm::vec3> points = cloud(100), fewer(99);
    std::vector<glm::vec3> strange = points, out(100);
    strange[40].y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(pull(points, sample_dab(), {}, out, fewer), std::invalid_argument);
    CHECK_THROWS_AS(pull(points, sample_dab(), {}, out, strange), std::invalid_argument);
    CHECK_THROWS_AS(pull(strange, sample_dab(), {}, out, points), std::invalid_argument);
    std::vector<glm::vec3> short_copy(99);
    CHECK_THROWS_AS(pull(points, sample_dab(), {}, out, {}, short_copy), std::invalid_argument);
    const std::vector<std::uint32_t> one{40};
    CHECK_THROWS_AS(pull_among(strange, sample_dab(), one, {}, out, points), std::invalid_argument);
    CHECK_THROWS_AS(pull_among(points, sample_dab(), one, {}, out, fewer), std::invalid_argument);
}

TEST_CASE("a pull refuses arguments outside their domain", "[pull]") {
    std::vector<glm::vec3> points = cloud(100), fewer(99);
    std::vector<float> weights(100, 1.0f);
    const auto refuses = [&](auto&& change, const char* problem) {
        Dab dab = sample_dab();
        change(dab);
        std::vector<glm::vec3> out(points.size());
        CHECK_THROWS_WITH(pull(points, dab, weights, out), Catch::Matchers::StartsWith(problem));
    };
    for (const float strange : {not_a_number, infinity}) {
        refuses([=](Dab& dab) { dab.root.y = strange; }, "root:");
        refuses([=](Dab& dab) { dab.displacement.z = strange; }, "displacement:");
        refuses([=](Dab& dab) { dab.radius = strange; }, "radius:");
        refuses([=](Dab& dab) { dab.metric[1].x = strange; }, "metric:");
    }
    refuses([](Dab& dab) { dab.radius = 0.0f; }, "radius:");
    refuses([](Dab& dab) { dab.minimum = 1.0f, dab.maximum = 0.5f; }, "minimum:");
    refuses([](Dab& dab) { dab.minimum = not_a_number; }, "minimum:");
    refuses([](Dab& dab) { dab.clamp_axis = 3; }, "clamp_axis:");
    refuses([](Dab& dab) { dab.mirror = 8; }, "mirror:");
    refuses([](Dab& dab) { dab.profile.falloff = Falloff::curve; }, "curve:");
    CHECK_THROWS_WITH(pull(points, sample_dab(), {}, fewer), Catch::Matchers::StartsWith("out:"));
    for (const float strange : {-0.1f, 1.1f, not_a_number}) {
        weights[99] = strange;
        refuses([](Dab&) {}, "weights:");
    }
    weights.pop_back();
    refuses([](Dab&) {}, "weights:");

    std::vector<glm::vec3> out(points.size());
    const std::vector<std::uint32_t> beyond{100};
    CHECK_THROWS_WITH(pull_among(points, sample_dab(), beyond, {}, out),
                      Catch::Matchers::StartsWith("vertices:"));
    const std::vector<mesh::Reach> wrong[] = {
        {}, {{{1, 2}, {0.0f}}}, {{{2, 1}, {0.0f, 0.0f}}}, {{{1, 1}, {0.0f, 0.0f}}}, {{{100}, {0.0f}}}};
    for (const std::vector<mesh::Reach>& reaches : wrong)
        CHECK_THROWS_WITH(pull_along(points, sample_dab(), reaches, {}, out),
                          Catch::Matchers::StartsWith("reach:"));
}
