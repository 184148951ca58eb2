// Catch2 3 under the names of Catch2 2, which the tests use: Debian 12 has 2, and Debian 13, Fedora and Arch
// have 3.
#pragma once

#include <catch2/catch_all.hpp>
#include <string>

using Catch::Approx;

namespace Catch {

using Matchers::StartsWith;

/// A text that has `part` somewhere.
inline auto Contains(const std::string& part) {
    return Matchers::ContainsSubstring(part);
}

}  // namespace Catch
