// What wide_test.cpp compiles for each instruction set.
#pragma once

namespace motus::test {

struct Checks {
    const char* name = nullptr;
    void (*pairs)() = nullptr;
    void (*quads)() = nullptr;
    void (*octets)() = nullptr;
};

}  // namespace motus::test
