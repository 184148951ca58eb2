#include "motus/bones/products.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::bones;

namespace {

std::vector<double> numbers(std::size_t count, unsigned seed) {
    test::Random random(seed);
    std::vector<double> result(count);
    for (double& number : result) number = random.between(-2.0, 2.0);
    return result;
}

/// GLM's matrices lie column by column, so that of rows is its transpose.
glm::dmat4 transpose_at(const std::vector<double>& rows, std::size_t first) {
    glm::dmat4 result;
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = rows[first + static_cast<std::size_t>(i)];
    return result;
}

}  // namespace

TEST_CASE("products of many matrices are GLM's", "[products]") {
    const std::vector<double> left = numbers(48, 1), right = numbers(48, 2);
    std::vector<double> out(48);
    multiply(left, right, {4, 4}, out);
    for (std::size_t first = 0; first < 48; first += 16) {
        const glm::dmat4 wanted = transpose_at(right, first) * transpose_at(left, first);
        for (int i = 0; i < 16; ++i)
            CHECK(out[first + static_cast<std::size_t>(i)] == Approx(wanted[i / 4][i % 4]).margin(1e-14));
    }
}

TEST_CASE("one matrix stands for all, on either side", "[products]") {
    const std::vector<double> one = numbers(9, 3), many = numbers(18, 4);
    std::vector<double> twice(one), out(18), wanted(18);
    twice.insert(twice.end(), one.begin(), one.end());
    multiply(one, many, {3, 3}, out);
    multiply(twice, many, {3, 3}, wanted);
    CHECK(out == wanted);
    multiply(many, one, {3, 3}, out);
    multiply(many, twice, {3, 3}, wanted);
    CHECK(out == wanted);
}

TEST_CASE("matrices and columns", "[products]") {
    const std::vector<double> turn{0, -1, 1, 0}, column{3, 5};
    std::vector<double> out(2);
    multiply(turn, column, {2, 1}, out);
    CHECK(out == std::vector<double>{-5, 3});
}

TEST_CASE("lengths that do not fit are refused", "[products]") {
    std::vector<double> out(32);
    CHECK_THROWS_AS(multiply(numbers(15, 1), numbers(16, 1), {4, 4}, out), std::invalid_argument);
    CHECK_THROWS_AS(multiply(numbers(16, 1), numbers(48, 1), {4, 4}, out), std::invalid_argument);
    CHECK_THROWS_AS(multiply(numbers(16, 1), numbers(16, 1), {4, 4}, std::span(out).first(31)),
                    std::invalid_argument);
    CHECK_THROWS_AS(multiply({}, {}, {0, 0}, out), std::invalid_argument);
}
