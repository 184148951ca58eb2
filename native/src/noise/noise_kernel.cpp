#include "noise_kernel.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

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

/// The other sign where the first bit of `signs` is set.
HWY_INLINE Floats turned_where(Words signs, Floats all) {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
    // They choose by the first bit alone; others would have to look at it first.
    return hn::IfNegativeThenElse(hn::BitCast(as_floats, signs), hn::Neg(all), all);
#else
    return hn::BitCast(as_floats, hn::BitCast(as_words, all) ^ (signs & words(0x80000000U)));
#endif
}

/// The bits of the hash from sign_bit on, downwards, at the place of signs.
HWY_INLINE Words signs_of(Words hash) {
    return hn::ShiftLeft<31 - sign_bit>(hash);
}

/// What is added to whole numbers that are near: the sum's bits are the number after those of this.
constexpr float to_whole = 0x1.8p23F;
constexpr std::uint32_t to_whole_bits = 0x4b400000U;

/// By `step` for each whole number, from what `first` is at 0.
HWY_INLINE Words names_of(Floats shifted, std::uint32_t step, std::uint32_t first) {
    return hn::BitCast(as_words, shifted) * words(step) + words(first - to_whole_bits * step);
}

// --- Along a line: what it adds up, and in which order, is what noise.cpp does -----------------------------

/// Adds a bump whose middle is at most 1 away.
HWY_INLINE void add_bump(Words hash, Floats from, Floats& sum) {
    const Floats rest = floats(1.0F) - from * from;
    const Floats upper = hn::ConvertTo(as_floats, hn::BitCast(as_integers, hn::ShiftRight<16>(hash)));
    const Floats height = upper * floats(2.0F / 65535.0F) - floats(1.0F);
    const Floats slope = floats(line::steepness) * turned_where(signs_of(hash), from);
    sum = sum + rest * rest * rest * (height + slope);
}

/// Adds the bumps on both sides. lower: mixed(seed) and name_step times the name of the lower one; within:
/// the distance from it.
HWY_INLINE void add_both(Words lower, Floats within, Floats& sum) {
    add_bump(mix(lower), within, sum);
    add_bump(mix(lower + words(2 * name_step)), within - floats(1.0F), sum);
}

/// From the nearest whole number, the distance to which has all digits, and that to any other is rounded
/// once.
HWY_INLINE Floats noise_at(std::uint32_t start, Floats place) {
    const Floats shifted = place + floats(to_whole);
    const Floats from_nearest = place - (shifted - floats(to_whole));
    const Words name = names_of(shifted, 2 * name_step, start);
    const auto is_below = from_nearest < hn::Zero(as_floats);
    const Words below =
        hn::BitCast(as_words, hn::IfThenElseZero(is_below, hn::BitCast(as_floats, words(2 * name_step))));
    Floats sum = hn::Zero(as_floats);
    add_both(name - below, from_nearest + hn::IfThenElseZero(is_below, floats(1.0F)), sum);
    add_both(name - words(name_step), from_nearest + floats(0.5F), sum);
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

/// Of the sum along an axis alone, by the weights of both corners and the distances from them.
HWY_INLINE Variance variance_of(Floats lower, Floats upper, Floats from_lower, Floats from_upper) {
    const Floats lower_part = lower * from_lower, upper_part = upper * from_upper;
    return {lower * lower + upper * upper, lower_part * lower_part + upper_part * upper_part};
}

/// Sets `variance` to that along the first axes and this one. hash: what is added to the names.
template <std::size_t dimensions, bool is_first>
HWY_INLINE Axis axis_at(Floats number, std::uint32_t hash, Variance& variance) {
    const Floats low = hn::Floor(number), one = floats(1.0F);
    const Floats from_lower = number - low, from_upper = from_lower - one;
    const Floats from_middle = from_lower - floats(0.5F), square = from_middle * from_middle;
    const Floats upper =
        floats(0.5F) + from_middle * (floats(1.875F) - square * (floats(5.0F) - floats(6.0F) * square));
    const Variance here = variance_of(one - upper, upper, from_lower, from_upper);
    if constexpr (is_first)
        variance = here;
    else
        variance = {variance.heights * here.heights,
                    variance.slopes * here.heights + variance.heights * here.slopes};
    const Floats shifted = low + floats(to_whole);
    // Heights are whole numbers of 32 bits.
    const Floats steepness = floats(Lattice<dimensions>::steepness * 0x1p31F);
    return {steepness * from_lower, steepness * from_upper, upper, names_of(shifted, name_step, hash),
            names_of(shifted, name_step, hash + name_step)};
}

HWY_INLINE Floats height_of(Words hash) {
    return hn::ConvertTo(as_floats, hn::BitCast(as_integers, hash));
}

HWY_INLINE Floats blended(Floats low, Floats high, const Axis& axis) {
    return low + axis.upper_weight * (high - low);
}

/// The sum over the four corners that lie on these sides of the axes before, along which their slopes climb
/// `before`. The corners a and b are lower on the first axis, a and c on the second. All go step by step
/// together, so that the processor need not wait for the results of one.
template <class... Climbs>
HWY_INLINE Floats sum_of_four(Words hash, const Axis& first, const Axis& second, Climbs... before) {
    const Words lower = stir(hash + first.lower_name), upper = stir(hash + first.upper_name);
    const Words a = stir(lower + second.lower_name), b = stir(lower + second.upper_name);
    const Words c = stir(upper + second.lower_name), d = stir(upper + second.upper_name);
    Floats of_a = height_of(a), of_b = height_of(b), of_c = height_of(c), of_d = height_of(d);
    Words signs_a = signs_of(a), signs_b = signs_of(b), signs_c = signs_of(c), signs_d = signs_of(d);
    const auto climb = [&](Floats by_a, Floats by_b, Floats by_c, Floats by_d) HWY_ATTR {
        of_a = of_a + turned_where(signs_a, by_a);
        of_b = of_b + turned_where(signs_b, by_b);
        of_c = of_c + turned_where(signs_c, by_c);
        of_d = of_d + turned_where(signs_d, by_d);
        // Those along the next axis.
        signs_a = signs_a + signs_a;
        signs_b = signs_b + signs_b;
        signs_c = signs_c + signs_c;
        signs_d = signs_d + signs_d;
    };
    (climb(before, before, before, before), ...);
    climb(first.lower_climb, first.lower_climb, first.upper_climb, first.upper_climb);
    climb(second.lower_climb, second.upper_climb, second.lower_climb, second.upper_climb);
    const Floats low = blended(of_a, of_b, second), high = blended(of_c, of_d, second);
    return blended(low, high, first);
}

/// The sum over all corners.
HWY_INLINE Floats sum_in(const std::array<Axis, 2>& cell) {
    return sum_of_four(hn::Zero(as_words), cell[0], cell[1]);
}

HWY_INLINE Floats sum_in(const std::array<Axis, 3>& cell) {
    const auto& [x, y, z] = cell;
    const Words lower = stir(x.lower_name), upper = stir(x.upper_name);
    const Floats low = sum_of_four(lower, y, z, x.lower_climb);
    const Floats high = sum_of_four(upper, y, z, x.upper_climb);
    return blended(low, high, x);
}

/// The sum over all corners, and what its square is on the average, by Lattice's softness.
struct Sum {
    Floats sum, expected;
};

template <std::size_t dimensions>
using Axes = std::make_index_sequence<dimensions>;

template <std::size_t dimensions, std::size_t... axis>
HWY_INLINE Sum sum_at(std::uint32_t start, const std::array<Floats, dimensions>& place,
                      std::index_sequence<axis...> /*axes*/) {
    Variance variance;
    const std::array<Axis, dimensions> cell{
        axis_at<dimensions, axis == 0>(place[axis], axis == 0 ? start : 0U, variance)...};
    return {sum_in(cell) * floats(0x1p-31F), floats(Lattice<dimensions>::heights) * variance.heights +
                                                 floats(Lattice<dimensions>::slopes) * variance.slopes};
}

template <std::size_t dimensions>
HWY_INLINE std::array<Floats, dimensions> places_at(const float* from) {
    std::array<Floats, dimensions> place;
    if constexpr (dimensions == 1)
        place[0] = hn::LoadU(as_floats, from);
    else if constexpr (dimensions == 2)
        hn::LoadInterleaved2(as_floats, from, place[0], place[1]);
    else
        hn::LoadInterleaved3(as_floats, from, place[0], place[1], place[2]);
    return place;
}

/// Whether as many numbers are near.
bool are_near(const float* numbers, std::size_t count) {
    Integers largest = hn::Zero(as_integers);
    // Sizes order as their bits do; those of NaN are the largest.
    for (std::size_t i = 0; i < count; i += lanes)
        largest = hn::Max(largest, hn::BitCast(as_integers, hn::Abs(hn::LoadU(as_floats, numbers + i))));
    return hn::AllFalse(as_integers, largest > hn::Set(as_integers, std::bit_cast<std::int32_t>(near)));
}

bool fill_line(const float* places, std::uint32_t seed, float* out) {
    const std::uint32_t start = mixed(seed);
    for (std::size_t i = 0; i < noise_block; i += lanes)
        hn::StoreU(noise_at(start, hn::LoadU(as_floats, places + i)), as_floats, out + i);
    return are_near(places, noise_block);
}

/// The root and the quotient, which take long, wait for those of the places before.
template <std::size_t dimensions>
bool fill(const float* places, std::uint32_t seed, float* out) {
    const std::uint32_t start = mixed(seed);
    const auto write = [out](const Sum& found, std::size_t i) HWY_ATTR {
        hn::StoreU(found.sum / hn::Sqrt(found.expected + found.sum * found.sum), as_floats, out + i);
    };
    Sum last = sum_at<dimensions>(start, places_at<dimensions>(places), Axes<dimensions>());
    for (std::size_t i = lanes; i < noise_block; i += lanes) {
        const Sum next =
            sum_at<dimensions>(start, places_at<dimensions>(places + dimensions * i), Axes<dimensions>());
        write(last, i - lanes);
        last = next;
    }
    write(last, noise_block - lanes);
    return are_near(places, dimensions * noise_block);
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
