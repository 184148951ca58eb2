// Two or four doubles that take part in one computation at once, each with the result that it would have
// alone. For the topics of the library alone. A template over `Real`, double or one of these, solves one
// problem or several by the same lines and to the same bits: it chooses by select() instead of branches, and
// takes sqrt, abs, min and max unqualified.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace motus {

// Always inlined, and so are the templates over Real that several instruction sets share: they are compiled
// to the instructions of the function that they are inlined into.

/// The compiler's vectors of n lanes.
template <int n>
struct LaneTypes;
template <>
struct LaneTypes<2> {
    using Numbers [[gnu::vector_size(16)]] = double;
    using InMemory [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
    using Bits [[gnu::vector_size(16)]] = std::int64_t;
};
template <>
struct LaneTypes<8> {
    using Numbers [[gnu::vector_size(64)]] = double;
    using InMemory [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;
    using Bits [[gnu::vector_size(64)]] = std::int64_t;
};
template <>
struct LaneTypes<4> {
    using Numbers [[gnu::vector_size(32)]] = double;
    using InMemory [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
    using Bits [[gnu::vector_size(32)]] = std::int64_t;
};

/// True or false for each lane.
template <int n>
struct WideMask {
    using Bits = typename LaneTypes<n>::Bits;
    Bits lanes;  ///< of each lane all bits set or none

    [[gnu::always_inline]] friend WideMask operator&(WideMask a, WideMask b) { return {a.lanes & b.lanes}; }
    [[gnu::always_inline]] friend WideMask operator|(WideMask a, WideMask b) { return {a.lanes | b.lanes}; }
    [[gnu::always_inline]] friend WideMask operator!(WideMask a) { return {~a.lanes}; }
};

template <int n>
struct Wide {
    using Numbers = typename LaneTypes<n>::Numbers;
    using Mask = WideMask<n>;
    Numbers lanes;

    Wide() = default;  // NOLINT(*-member-init): not initialised, since glm's vectors are unions
    [[gnu::always_inline]] Wide(double all) : lanes(all - Numbers{}) {}
    template <class... Double>
    requires(sizeof...(Double) == n) [[gnu::always_inline]] Wide(Double... each) : lanes{each...} {}
    [[gnu::always_inline]] explicit Wide(Numbers each) : lanes(each) {}

    // Not by memcpy, of which GCC makes copies of 16 bytes in what is inlined for wider registers.
    [[nodiscard, gnu::always_inline]] static Wide load(const double* from) {
        return Wide(*reinterpret_cast<const typename LaneTypes<n>::InMemory*>(from));
    }
    [[gnu::always_inline]] void store(double* to) const {
        *reinterpret_cast<typename LaneTypes<n>::InMemory*>(to) = lanes;
    }

    [[gnu::always_inline]] friend Wide operator+(Wide a, Wide b) { return Wide(a.lanes + b.lanes); }
    [[gnu::always_inline]] friend Wide operator-(Wide a, Wide b) { return Wide(a.lanes - b.lanes); }
    [[gnu::always_inline]] friend Wide operator*(Wide a, Wide b) { return Wide(a.lanes * b.lanes); }
    [[gnu::always_inline]] friend Wide operator/(Wide a, Wide b) { return Wide(a.lanes / b.lanes); }
    [[gnu::always_inline]] friend Mask operator<(Wide a, Wide b) { return {a.lanes < b.lanes}; }
    [[gnu::always_inline]] friend Mask operator<=(Wide a, Wide b) { return {a.lanes <= b.lanes}; }
    [[gnu::always_inline]] friend Mask operator>(Wide a, Wide b) { return {a.lanes > b.lanes}; }
    [[gnu::always_inline]] friend Mask operator>=(Wide a, Wide b) { return {a.lanes >= b.lanes}; }
    [[gnu::always_inline]] friend Mask operator==(Wide a, Wide b) { return {a.lanes == b.lanes}; }
};

using Pair = Wide<2>;

// The functions that glm's vectors and the templates call for a Real: for one double.

[[nodiscard, gnu::always_inline]] inline bool any(bool mask) {
    return mask;
}
[[nodiscard, gnu::always_inline]] inline bool all(bool mask) {
    return mask;
}
/// `a` if the mask holds, else `b`, even if the one that is not chosen is NaN.
[[nodiscard, gnu::always_inline]] inline double select(bool mask, double a, double b) {
    return mask ? a : b;
}
[[nodiscard, gnu::always_inline]] inline bool lane(bool mask, int /*index*/) {
    return mask;
}
[[nodiscard, gnu::always_inline]] inline double lane(double value, int /*index*/) {
    return value;
}
[[gnu::always_inline]] inline void set_lane(double& value, int /*index*/, double part) {
    value = part;
}

// The functions that glm's vectors and the templates call for a Real: for several doubles.

template <int n>
[[nodiscard, gnu::always_inline]] inline bool any(WideMask<n> mask) {
    // How this is compiled decides over a tenth of the time of two_bone.cpp.
    if constexpr (n > 2) {
        using Half = typename LaneTypes<n / 2>::Bits;
        Half low, high;
        __builtin_memcpy(&low, &mask.lanes, sizeof(Half));
        __builtin_memcpy(&high, reinterpret_cast<const char*>(&mask.lanes) + sizeof(Half), sizeof(Half));
        return any(WideMask<n / 2>{low | high});
    } else {
        return (mask.lanes[0] | mask.lanes[1]) != 0;
    }
}
template <int n>
[[nodiscard, gnu::always_inline]] inline bool all(WideMask<n> mask) {
    return !any(!mask);
}
template <int n>
[[nodiscard, gnu::always_inline]] inline Wide<n> select(WideMask<n> mask, Wide<n> a, Wide<n> b) {
    return Wide<n>(mask.lanes ? a.lanes : b.lanes);
}
template <int n>
[[nodiscard, gnu::always_inline]] inline bool lane(WideMask<n> mask, int index) {
    return mask.lanes[index] != 0;
}
template <int n>
[[nodiscard, gnu::always_inline]] inline double lane(Wide<n> value, int index) {
    return value.lanes[index];
}
template <int n>
[[gnu::always_inline]] inline void set_lane(Wide<n>& value, int index, double part) {
    value.lanes[index] = part;
}

template <int n>
[[nodiscard, gnu::always_inline]] inline Wide<n> min(Wide<n> a, Wide<n> b) {
    return select(b < a, b, a);
}
template <int n>
[[nodiscard, gnu::always_inline]] inline Wide<n> max(Wide<n> a, Wide<n> b) {
    return select(a < b, b, a);
}
template <int n>
[[nodiscard, gnu::always_inline]] inline Wide<n> abs(Wide<n> a) {
    using Numbers = typename Wide<n>::Numbers;
    using Bits = typename WideMask<n>::Bits;
    constexpr std::int64_t all_but_the_sign = std::numeric_limits<std::int64_t>::max();
    return Wide<n>(__builtin_bit_cast(Numbers, __builtin_bit_cast(Bits, a.lanes) & all_but_the_sign));
}
template <int n>
[[nodiscard, gnu::always_inline]] inline Wide<n> sqrt(Wide<n> a) {
    for (int i = 0; i < n; ++i) a.lanes[i] = std::sqrt(a.lanes[i]);
    return a;
}

template <class Real>
inline constexpr int lane_count = 1;
template <int n>
inline constexpr int lane_count<Wide<n>> = n;

// Arrays of C, since GCC 12 keeps what stands in a std::array in memory: two bones then take a third more
// time. NOLINTBEGIN(*-avoid-c-arrays, *-member-init)

/// Rows of as many numbers as there are rows, turned into columns: number j of row i becomes number i of row
/// j.
[[gnu::always_inline]] inline void transpose(Wide<2> (&rows)[2]) {
    const auto a = rows[0].lanes, b = rows[1].lanes;
    rows[0].lanes = __builtin_shufflevector(a, b, 0, 2);
    rows[1].lanes = __builtin_shufflevector(a, b, 1, 3);
}
[[gnu::always_inline]] inline void transpose(Wide<4> (&rows)[4]) {
    const auto a = rows[0].lanes, b = rows[1].lanes, c = rows[2].lanes, d = rows[3].lanes;
    // Halves first: the processor puts them together as it loads them.
    const auto low_ac = __builtin_shufflevector(a, c, 0, 1, 4, 5),
               low_bd = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    const auto high_ac = __builtin_shufflevector(a, c, 2, 3, 6, 7),
               high_bd = __builtin_shufflevector(b, d, 2, 3, 6, 7);
    rows[0].lanes = __builtin_shufflevector(low_ac, low_bd, 0, 4, 2, 6);
    rows[1].lanes = __builtin_shufflevector(low_ac, low_bd, 1, 5, 3, 7);
    rows[2].lanes = __builtin_shufflevector(high_ac, high_bd, 0, 4, 2, 6);
    rows[3].lanes = __builtin_shufflevector(high_ac, high_bd, 1, 5, 3, 7);
}

/// Sets lane(fields[k], i) to number k of structure i, for structures that begin with doubles and stand
/// `step` bytes apart, the first at `from`. count: a multiple of n.
template <int n, std::size_t count>
[[gnu::always_inline]] inline void load_fields(const void* from, std::size_t step, Wide<n> (&fields)[count]) {
    static_assert(count % n == 0);
    for (std::size_t k = 0; k < count; k += n) {
        Wide<n> rows[n];
        for (std::size_t i = 0; i < n; ++i)
            rows[i] =
                Wide<n>::load(reinterpret_cast<const double*>(static_cast<const char*>(from) + i * step) + k);
        transpose(rows);
        for (std::size_t i = 0; i < n; ++i) fields[k + i] = rows[i];
    }
}
/// The reverse: sets number k of structure i to lane(fields[k], i).
template <int n, std::size_t count>
[[gnu::always_inline]] inline void store_fields(const Wide<n> (&fields)[count], void* to, std::size_t step) {
    static_assert(count % n == 0);
    for (std::size_t k = 0; k < count; k += n) {
        Wide<n> rows[n];
        for (std::size_t i = 0; i < n; ++i) rows[i] = fields[k + i];
        transpose(rows);
        for (std::size_t i = 0; i < n; ++i)
            rows[i].store(reinterpret_cast<double*>(static_cast<char*>(to) + i * step) + k);
    }
}

// NOLINTEND(*-avoid-c-arrays, *-member-init)

// For glm's vectors of one or several doubles.

template <class Mask, class Real>
[[nodiscard, gnu::always_inline]] inline glm::vec<3, Real> select(Mask mask, const glm::vec<3, Real>& a,
                                                                  const glm::vec<3, Real>& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <class Real>
[[nodiscard, gnu::always_inline]] inline glm::dvec3 lane(const glm::vec<3, Real>& value, int index) {
    return {lane(value.x, index), lane(value.y, index), lane(value.z, index)};
}

template <class Real>
[[gnu::always_inline]] inline void set_lane(glm::vec<3, Real>& value, int index, const glm::dvec3& part) {
    set_lane(value.x, index, part.x);
    set_lane(value.y, index, part.y);
    set_lane(value.z, index, part.z);
}

}  // namespace motus

/// glm's vectors require that this is true of their numbers.
template <int n>
struct std::numeric_limits<motus::Wide<n>> : std::numeric_limits<double> {};
