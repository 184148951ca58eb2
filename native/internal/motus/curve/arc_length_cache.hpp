// The cache of arc length tables.
#pragma once
#include <cstddef>

#include "motus/core/cache.hpp"
#include "motus/curve/arc_length.hpp"

namespace motus::curve {

struct CurveHash {
    [[nodiscard]] std::size_t operator()(const Curve& curve) const noexcept;
};
struct ArcLengthBytes {
    [[nodiscard]] std::size_t operator()(const Curve& curve, const ArcLength& path) const noexcept;
};
using ArcLengthCache = Cache<Curve, ArcLength, CurveHash, ArcLengthBytes>;

/// The process's cache of arc length tables.
[[nodiscard]] ArcLengthCache& arc_length_cache();

}  // namespace motus::curve
