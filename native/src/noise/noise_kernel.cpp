#include "noise_kernel.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motus/core/instruction_sets.hpp"
#include "shape.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::noise::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

HWY_INLINE Words stir(Words bits) {
    return (bits ^ hn::ShiftRight<16>(bits)) * words(first_mixer);
}

HWY_INLINE Words mix(Words bits) {
    bits = stir(bits);
    bits = (bits ^ hn::ShiftRight<15>(bits)) * words(second_mixer);
    return bits ^ hn::ShiftRight<16>(bits);
}

/// The other sign if this bit is set.
HWY_INLINE Floats turn_where(Words bits, int bit, Floats all) {
    const Words signs = hn::ShiftLeftSame(bits, 31 - bit);
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
    // They choose by the sign alone; others would have to look at it first.
    return hn::IfNegativeThenElse(hn::BitCast(as_floats, signs), hn::Neg(all), all);
#else
    return hn::BitCast(as_floats, hn::BitCast(as_words, all) ^ (signs & words(0x80000000U)));
#endif
}

HWY_INLINE Floats within_reach(Floats number) {
    return hn::Clamp(number, floats(-farthest), floats(farthest));
}

/// Bits of whole numbers.
HWY_INLINE Words words_of(Floats whole) {
    return hn::BitCast(as_words, hn::ConvertTo(as_integers, whole));
}

// --- Along a line: what it adds up, and in which order, is what noise.cpp does -----------------------------

/// Adds a bump whose middle is at most 1 away.
HWY_INLINE void add_bump(Words hash, Floats from, Floats& sum) {
    const Floats rest = floats(1.0F) - from * from;
    const Floats upper = hn::ConvertTo(as_floats, hn::BitCast(as_integers, hn::ShiftRight<16>(hash)));
    const Floats height = upper * floats(2.0F / 65535.0F) - floats(1.0F);
    sum = sum + rest * rest * rest * (height + floats(line::steepness) * turn_where(hash, sign_bit, from));
}

/// Adds the bumps on both sides. lower: name_step times the name of the lower one; within: the distance from
/// it.
HWY_INLINE void add_both(Words start, Words lower, Floats within, Floats& sum) {
    add_bump(mix(start + lower), within, sum);
    add_bump(mix(start + lower + words(2 * name_step)), within - floats(1.0F), sum);
}

/// From the nearest whole number, the distance to which has all digits, and that to any other is rounded
/// once.
HWY_INLINE Floats noise_at(Words start, const std::array<Floats, 1>& place) {
    const Floats near = within_reach(place[0]);
    const Floats nearest = hn::Round(near);
    const Floats from_nearest = near - nearest;
    const Words name = words_of(nearest) * words(2 * name_step);
    const auto is_below = from_nearest < hn::Zero(as_floats);
    const Words below =
        hn::BitCast(as_words, hn::IfThenElseZero(is_below, hn::BitCast(as_floats, words(2 * name_step))));
    Floats sum = hn::Zero(as_floats);
    add_both(start, name - below, from_nearest + hn::IfThenElseZero(is_below, floats(1.0F)), sum);
    add_both(start, name - words(name_step), from_nearest + floats(0.5F), sum);
    return sum * floats(1.0F / line::bound);
}

// --- In the plane and in space -----------------------------------------------------------------------------

/// The cell around a place along one axis: what slopes climb from its lower and from its upper corners to the
/// place, the weight of the upper ones, and what the names of both add to a hash.
struct Axis {
    Floats lower_climb, upper_climb, upper_weight;
    Words lower_name, upper_name;
};

/// Variance of the sum along the axes so far: by the heights, and by each coordinate of the slopes, if these
/// are of variance 1.
struct Variance {
    Floats heights, slopes;
};

template <std::size_t dimensions>
HWY_INLINE Axis axis_at(Floats number, Variance& variance) {
    const Floats near = within_reach(number), low = hn::Floor(near), one = floats(1.0F);
    const Floats from_lower = near - low, from_upper = from_lower - one;
    const Floats from_middle = from_lower - floats(0.5F), square = from_middle * from_middle;
    const Floats upper =
        floats(0.5F) + from_middle * (floats(1.875F) - square * (floats(5.0F) - floats(6.0F) * square));
    const Floats lower = one - upper;
    const Floats squares = lower * lower + upper * upper;
    const Floats lower_part = lower * from_lower, upper_part = upper * from_upper;
    variance.slopes =
        variance.slopes * squares + variance.heights * (lower_part * lower_part + upper_part * upper_part);
    variance.heights = variance.heights * squares;
    const Words name = words_of(low) * words(name_step);
    // Heights are whole numbers of 32 bits.
    const Floats steepness = floats(Lattice<dimensions>::steepness * 0x1p31F);
    return {steepness * from_lower, steepness * from_upper, upper, name, name + words(name_step)};
}

/// The sum over all corners that lie on these sides of the first axes.
template <std::size_t dimensions, class... Climbs>
HWY_INLINE Floats blended(Words hash, const std::array<Axis, dimensions>& cell, Climbs... climbs) {
    if constexpr (sizeof...(Climbs) == dimensions) {
        Floats plane = hn::ConvertTo(as_floats, hn::BitCast(as_integers, hash));
        int bit = sign_bit;
        ((plane = plane + turn_where(hash, bit--, climbs)), ...);
        return plane;
    } else {
        const Axis& axis = cell[sizeof...(Climbs)];
        const Floats low = blended(stir(hash + axis.lower_name), cell, climbs..., axis.lower_climb);
        const Floats high = blended(stir(hash + axis.upper_name), cell, climbs..., axis.upper_climb);
        return low + axis.upper_weight * (high - low);
    }
}

/// The sum over all corners, and what its square is on the average, by Lattice's softness.
struct Sum {
    Floats sum, expected;
};

template <std::size_t dimensions>
HWY_INLINE Sum sum_at(Words start, const std::array<Floats, dimensions>& place) {
    Variance variance{floats(1.0F), hn::Zero(as_floats)};
    std::array<Axis, dimensions> cell;
    for (std::size_t axis = 0; axis < dimensions; ++axis)
        cell[axis] = axis_at<dimensions>(place[axis], variance);
    return {blended(start, cell) * floats(0x1p-31F),
            floats(Lattice<dimensions>::heights) * variance.heights +
                floats(Lattice<dimensions>::slopes) * variance.slopes};
}

using Mask = hn::Mask<decltype(as_floats)>;

/// are_nan: also of places before, in the same lane.
template <std::size_t dimensions>
HWY_INLINE std::array<Floats, dimensions> places_at(const float* from, Mask& are_nan) {
    std::array<Floats, dimensions> place;
    if constexpr (dimensions == 1)
        place[0] = hn::LoadU(as_floats, from);
    else if constexpr (dimensions == 2)
        hn::LoadInterleaved2(as_floats, from, place[0], place[1]);
    else
        hn::LoadInterleaved3(as_floats, from, place[0], place[1], place[2]);
    for (std::size_t axis = 0; axis < dimensions; ++axis) are_nan = hn::Or(are_nan, hn::IsNaN(place[axis]));
    return place;
}

bool fill_line(const float* places, std::uint32_t seed, float* out) {
    const Words start = words(mixed(seed));
    Mask are_nan = hn::MaskFromVec(hn::Zero(as_floats));
    for (std::size_t i = 0; i < noise_block; i += lanes)
        hn::StoreU(noise_at(start, places_at<1>(places + i, are_nan)), as_floats, out + i);
    return !hn::AllFalse(as_floats, are_nan);
}

/// The root and the quotient, which take long, wait for those of the places before.
template <std::size_t dimensions>
bool fill(const float* places, std::uint32_t seed, float* out) {
    const Words start = words(mixed(seed));
    Mask are_nan = hn::MaskFromVec(hn::Zero(as_floats));
    const auto write = [out](const Sum& found, std::size_t i) HWY_ATTR {
        hn::StoreU(found.sum / hn::Sqrt(found.expected + found.sum * found.sum), as_floats, out + i);
    };
    Sum last = sum_at(start, places_at<dimensions>(places, are_nan));
    for (std::size_t i = lanes; i < noise_block; i += lanes) {
        const Sum next = sum_at(start, places_at<dimensions>(places + dimensions * i, are_nan));
        write(last, i - lanes);
        last = next;
    }
    write(last, noise_block - lanes);
    return !hn::AllFalse(as_floats, are_nan);
}

constexpr NoiseKernel kernel{HWY_STR(HWY_NAMESPACE), {&fill_line, &fill<2>, &fill<3>}};

}  // namespace
}  // namespace motus::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::noise {

std::span<const NoiseKernel> noise_kernels() {
    static const Kernels<NoiseKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::noise
#endif
