#include "wide_cases.hpp"

TEST_CASE("each of two lanes is computed as it would be alone", "[wide]") {
    check_numbers<Pair>();
}
