#include "motus/core/bounded.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

TEMPLATE_TEST_CASE("one number that reaches the limit is noticed wherever it stands", "[bounded]", float,
                   double) {
    const auto limit = static_cast<TestType>(3.4e38);
    const TestType infinity = std::numeric_limits<TestType>::infinity();
    for (const std::size_t count : {1, 2, 7, 64, 1000}) {
        for (const std::size_t place : {std::size_t{0}, count / 2, count - 1}) {
            std::vector<TestType> numbers(count, TestType(1));
            for (const TestType fine :
                 {TestType(0), std::nextafter(limit, TestType(0)), -std::nextafter(limit, TestType(0)),
                  std::numeric_limits<TestType>::denorm_min()}) {
                numbers[place] = fine;
                CHECK(motus::are_below(std::span<const TestType>(numbers), 3.4e38));
            }
            for (const TestType bad :
                 {limit, -limit, infinity, -infinity, std::numeric_limits<TestType>::quiet_NaN()}) {
                numbers[place] = bad;
                CHECK_FALSE(motus::are_below(std::span<const TestType>(numbers), 3.4e38));
            }
        }
    }
    CHECK(motus::are_below(std::span<const TestType>(), 3.4e38));
}
