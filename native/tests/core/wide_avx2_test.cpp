// Compiled for AVX2, whatever else is not: see CMakeLists.txt.
#include "wide_cases.hpp"

#if defined(__AVX2__)
TEST_CASE("each of four lanes is computed as it would be alone", "[wide]") {
    if (__builtin_cpu_supports("avx2"))
        check_numbers<Quad>();
    else
        WARN("skipped: this processor has no AVX2");
}
#endif
