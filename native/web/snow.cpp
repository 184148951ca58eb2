// When flakes are born while the rate is keyed.
#include <cstdint>

#include "motus/snow/births.hpp"
#include "web.hpp"

namespace motus::web {
namespace {

snow::Births births_of(const double* times, std::size_t count, const double* rates) {
    return {0.0, 0.0, 0.0, true, {}, {{times, times + count}, {rates, rates + count}}};
}

}  // namespace

/// keys: times, s, and the rates there, flakes a second. out: the number of flakes that are born until each
/// of the moments.
MOTUS_WEB(birth_counts)
(const double* times, std::size_t count, const double* rates, std::size_t, const double* moments,
 std::size_t wanted, double* out) {
    const snow::Births births = births_of(times, count, rates);
    for (std::size_t i = 0; i < wanted; ++i) out[i] = static_cast<double>(births.count(moments[i]));
}

/// out: the moments at which the first flakes are born, `wanted` of them; infinity for those that never are.
MOTUS_WEB(birth_times)
(const double* times, std::size_t count, const double* rates, std::size_t, std::size_t wanted, double* out) {
    const snow::Births births = births_of(times, count, rates);
    for (std::uint64_t i = 0; i < wanted; ++i) out[i] = births.streamed(i);
}

}  // namespace motus::web
