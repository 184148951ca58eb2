// The loops for each instruction set give the same bits, and so does any number of threads.
#include "pull_kernel.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <vector>

#include "checks.hpp"
#include "motus/core/parallel.hpp"
#include "puller.hpp"

using namespace motus;
using namespace motus::sculpt;
using namespace motus::sculpt::checks;

namespace {

constexpr Falloff all_falloffs[] = {Falloff::classic,  Falloff::smooth,   Falloff::sphere,
                                    Falloff::root,     Falloff::linear,   Falloff::sharp,
                                    Falloff::constant, Falloff::gaussian, Falloff::curve};
const std::vector<float> hill{0.0f, 0.3f, -0.2f, 1.0f, 0.5f};

Dab dab_with(Falloff falloff, float radius) {
    Dab dab;
    dab.root = {0.2f, -0.1f, 0.3f};
    dab.displacement = {0.1f, 0.3f, -0.2f};
    dab.radius = radius;
    dab.profile = {falloff, 1.3f, hill};
    dab.minimum = -0.4f;
    dab.maximum = 0.8f;
    return dab;
}

const glm::mat3 sheared{1.5f, 0.2f, 0.0f, -0.3f, 0.7f, 0.1f, 0.0f, 0.4f, 2.0f};
const glm::mat3 turned{0.0f, 1.5f, 0.0f, -0.7f, 0.0f, 0.0f, 0.0f, 0.0f, 2.0f};

void set_free(Dab& dab) {
    dab.minimum = -std::numeric_limits<float>::infinity();
    dab.maximum = std::numeric_limits<float>::infinity();
}

std::vector<glm::vec3> pulled_by(const PullKernel& kernel, std::span<const glm::vec3> points, const Dab& dab,
                                 std::span<const float> weights) {
    const Puller puller(dab, points.size(), weights.size(), points.size(), kernel);
    std::vector<glm::vec3> out(points.size());
    puller.act_whole({points.data(), points.data()}, weights.empty() ? nullptr : weights.data(), 0,
                     points.size(), out.data());
    return out;
}

}  // namespace

TEST_CASE("every instruction set gives the same bits", "[pull]") {
    const std::span<const PullKernel> kernels = pull_kernels();
    if (kernels.size() == 1) WARN("there is one instruction set alone, and nothing to compare with");
    for (const std::size_t count : {1u, 3u, 4u, 7u, 8u, 9u, 511u, 512u, 1029u, 5000u}) {
        const std::vector<glm::vec3> points = cloud(count);
        const std::vector<float> weights = random_weights(count);
        for (const Falloff falloff : all_falloffs) {
            for (const unsigned mirror : {0u, 3u}) {
                for (const float radius : {0.3f, 0.9f, 5.0f}) {
                    Dab dab = dab_with(falloff, radius);
                    dab.mirror = mirror;
                    if (count % 4 != 1) set_free(dab);
                    if (count % 2 == 1) dab.metric = count % 3 == 0 ? turned : sheared;
                    const auto plain = pulled_by(kernels.front(), points, dab, {});
                    const auto weighed = pulled_by(kernels.front(), points, dab, weights);
                    for (const PullKernel& kernel : kernels) {
                        INFO(kernel.name << ", " << count << " vertices, falloff "
                                         << static_cast<int>(falloff));
                        CHECK(same_bits(plain, pulled_by(kernel, points, dab, {})));
                        CHECK(same_bits(weighed, pulled_by(kernel, points, dab, weights)));
                    }
                }
            }
        }
    }
}

TEST_CASE("dabs without limits, done in one pass, give the same bits as by blocks", "[pull]") {
    const float huge = std::numeric_limits<float>::max();
    for (const std::size_t count : {1u, 5u, 15u, 16u, 17u, 33u, 700u, 5000u}) {
        std::vector<glm::vec3> points = cloud(count);
        points[count / 2] = {-0.0f, 0.0f, -0.0f};
        points[count - 1] = {huge, -huge, 0.0f};  // finite, but no square of it is
        std::vector<float> weights = random_weights(count);
        weights[count / 3] = 0.0f;
        for (const Falloff falloff : all_falloffs) {
            for (const float radius : {0.3f, 5.0f}) {
                for (const glm::mat3& metric : {glm::mat3(1.0f), turned, sheared}) {
                    Dab dab = dab_with(falloff, radius);
                    set_free(dab);
                    dab.metric = metric;
                    Dab by_blocks = dab;
                    by_blocks.minimum = -huge;  // limits, which hold nothing back
                    by_blocks.maximum = huge;
                    for (const PullKernel& kernel : pull_kernels()) {
                        INFO(kernel.name << ", " << count << " vertices, falloff "
                                         << static_cast<int>(falloff));
                        const std::vector<glm::vec3> found = pulled_by(kernel, points, dab, {});
                        CHECK(same_bits(found, pulled_by(kernel, points, by_blocks, {})));
                        CHECK((found[count - 1].x == huge && found[count - 1].y == -huge));
                        CHECK(same_bits(pulled_by(kernel, points, dab, weights),
                                        pulled_by(kernel, points, by_blocks, weights)));
                    }
                }
            }
        }
    }
}

TEST_CASE("every instruction set gives the same forces", "[pull]") {
    test::Random random(2);
    std::vector<float> distances(pull_block);
    for (int round = 0; round < 200; ++round) {
        for (float& distance : distances) distance = random.between(0.0f, round % 2 == 0 ? 1.0f : 3.0f);
        distances[5] = std::numeric_limits<float>::quiet_NaN();
        distances[6] = std::numeric_limits<float>::infinity();
        distances[7] = 0.0f;
        for (const Falloff falloff : all_falloffs) {
            const ForceTerms terms = force_terms({falloff, 0.1f * static_cast<float>(round), hill}, 1.1f);
            std::vector<float> first = distances;
            pull_kernels().front().force(terms, first.data(), first.size());
            for (const PullKernel& kernel : pull_kernels()) {
                std::vector<float> found = distances;
                kernel.force(terms, found.data(), found.size());
                CHECK(std::memcmp(first.data(), found.data(), found.size() * sizeof(float)) == 0);
            }
        }
    }
}

TEST_CASE("results do not depend on how the vertices are shared out", "[pull]") {
    const std::vector<glm::vec3> points = cloud(600000);
    const std::vector<float> weights = random_weights(points.size());
    const Dab dab = dab_with(Falloff::gaussian, 0.8f);
    const std::vector<glm::vec3> one = pulled_by(pull_kernels().back(), points, dab, weights);
    CHECK(same_bits(pulled(points, dab, weights), one));
    for (const std::size_t threads : {2u, 3u, 5u}) {
        const Puller puller(dab, points.size(), weights.size(), points.size());
        std::vector<glm::vec3> out(points.size());
        in_parts(
            points.size(), 1000,
            [&](std::size_t first, std::size_t last) {
                puller.act_whole({points.data(), points.data()}, weights.data(), first, last, out.data());
            },
            threads);
        CHECK(same_bits(out, one));
    }
}
