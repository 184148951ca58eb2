#include "philox.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

using namespace motus::snow;

TEST_CASE("Philox gives its authors' numbers", "[snow]") {
    const auto gives = [](Words counter, Key key, Words wanted) {
        const Words found = philox(counter, key);
        CHECK(found.a == wanted.a);
        CHECK(found.b == wanted.b);
        CHECK(found.c == wanted.c);
        CHECK(found.d == wanted.d);
    };
    // Of Random123's kat_vectors.
    constexpr std::uint32_t ones = 0xffffffffU;
    gives({}, {}, {0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U});
    gives({ones, ones, ones, ones}, {ones, ones}, {0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU});
    gives({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U},
          {0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U});
}

TEST_CASE("fractions lie in [0, 1)", "[snow]") {
    CHECK(fraction(0) == 0.0F);
    CHECK(fraction(0x80000000U) == 0.5F);
    CHECK(fraction(0xffffffffU) < 1.0F);
}
