// The cache of frame tables.
#pragma once
#include <cstddef>
#include <optional>

#include "motus/core/cache.hpp"
#include "motus/path/frames.hpp"

namespace motus::path {

/// The input of frame tables, by which they are cached.
struct FrameTablesKey {
    curve::Curve curve;
    FrameMode mode = FrameMode::minimal;
    double smoothing = 0.0;
    std::optional<curve::Curve> rail{};  // in the mode rail
    RailPoint rail_point = RailPoint::share;
    [[nodiscard]] bool operator==(const FrameTablesKey&) const = default;
};

struct FrameTablesHash {
    [[nodiscard]] std::size_t operator()(const FrameTablesKey& key) const noexcept;
};
struct FrameTablesBytes {
    [[nodiscard]] std::size_t operator()(const FrameTablesKey& key, const FrameTables& tables) const noexcept;
};
using FrameTablesCache = Cache<FrameTablesKey, FrameTables, FrameTablesHash, FrameTablesBytes>;

/// The process's cache of frame tables.
[[nodiscard]] FrameTablesCache& frame_tables_cache();

}  // namespace motus::path
