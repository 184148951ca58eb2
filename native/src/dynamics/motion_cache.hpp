// The tables of all motions that were asked for last. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motion_table.hpp"
#include "motus/core/cache.hpp"

namespace motus::dynamics {

template <class System>
struct MotionHash {
    std::size_t operator()(const MotionSettings<System>& settings) const {
        ContentHash hash;
        hash.add(std::span<const double>(settings.start));
        hash.add(settings.interval);
        add_to(hash, settings.system);
        hash.add(std::span<const double>(settings.accelerations));
        return hash.value();
    }
};

template <class System>
struct MotionBytes {
    std::size_t operator()(const MotionSettings<System>& settings, const MotionTable<System>& table) const {
        return table.bytes() + bytes_of(settings.accelerations);
    }
};

template <class System>
using MotionCache =
    Cache<MotionSettings<System>, MotionTable<System>, MotionHash<System>, MotionBytes<System>>;

inline constexpr std::size_t most_tables = 4096;
/// Most tables of motions that are asked for together, and their bytes. If these had too little room in the
/// cache, with the budget that it has at first, each question would drop the tables that the next one needs.
inline constexpr std::size_t most_tables_together = most_tables / 2;
inline constexpr std::size_t most_bytes_together = std::size_t{448} << 20U;

/// The one cache of a system's tables. It is never destroyed: other threads may still use it when the process
/// ends.
template <class System>
[[nodiscard]] MotionCache<System>& motion_cache() {
    static auto& cache = *new MotionCache<System>(most_tables);
    return cache;
}

template <class System>
[[nodiscard]] std::shared_ptr<const MotionTable<System>> motion_table(
    const MotionSettings<System>& settings) {
    return motion_cache<System>().get(settings, [](const MotionSettings<System>& key) {
        return std::make_shared<const MotionTable<System>>(key);
    });
}

/// A motion forwards and backwards from its start.
template <class System>
class Motion {
  public:
    /// settings: those of the motion forwards.
    explicit Motion(MotionSettings<System> settings) : settings_(std::move(settings)) {}

    /// Greatest size of the table that a time is in, with its key. Throws as at().
    [[nodiscard]] std::size_t bytes_until(double time) {
        return table(time < 0.0).bytes_until(time) + bytes_of(settings_.accelerations);
    }

    /// The state at a time in the motion's own unit.
    [[nodiscard]] std::array<double, System::size> at(double time) { return table(time < 0.0).at(time); }

    /// The table for times below 0 if `is_past`, else the one for times from 0 on.
    [[nodiscard]] const MotionTable<System>& table(bool is_past) {
        auto& found = tables_[is_past ? 1 : 0];
        if (!found) {
            MotionSettings<System> wanted = settings_;
            if (is_past) {
                if (!settings_.accelerations.empty())
                    throw std::invalid_argument("times: must be at least 0: the pivot's past is not known");
                wanted.interval = -wanted.interval;
            }
            found = motion_table(wanted);
        }
        return *found;
    }

  private:
    MotionSettings<System> settings_;
    std::array<std::shared_ptr<const MotionTable<System>>, 2> tables_;
};

}  // namespace motus::dynamics
