// Several doubles that take part in one computation at once, each with the result that it would have alone,
// in the instructions of one of Highway's targets: once for each of these, in a source that
// <hwy/foreach_target.h> includes; in other sources, for what all processors have. For the topics of the
// library alone. A template over `Real`, double or one of these, solves one problem or several by the same
// lines and to the same bits: it chooses by select() instead of branches, and takes sqrt, abs, min and max
// unqualified.
#if defined(MOTUS_CORE_WIDE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_CORE_WIDE_INL_HPP
#undef MOTUS_CORE_WIDE_INL_HPP
#else
#define MOTUS_CORE_WIDE_INL_HPP
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

HWY_BEFORE_NAMESPACE();
namespace motus::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Doubles in one vector.
inline constexpr int most_lanes = static_cast<int>(hn::MaxLanes(hn::ScalableTag<double>()));

template <class Real>
inline constexpr int lane_count = 1;

// --- One double --------------------------------------------------------------------------------------------

HWY_INLINE bool any(bool mask) {
    return mask;
}
HWY_INLINE bool all(bool mask) {
    return mask;
}
/// `a` if the mask holds, else `b`, even if the one that is not chosen is NaN.
HWY_INLINE double select(bool mask, double a, double b) {
    return mask ? a : b;
}
HWY_INLINE bool lane(bool mask, int /*index*/) {
    return mask;
}
HWY_INLINE double lane(double value, int /*index*/) {
    return value;
}
HWY_INLINE void set_lane(double& value, int /*index*/, double part) {
    value = part;
}
HWY_INLINE void load(const double* from, double& to) {
    to = *from;
}
HWY_INLINE void store(double value, double* to) {
    *to = value;
}

// --- Several -----------------------------------------------------------------------------------------------

#if HWY_TARGET == HWY_SCALAR

/// As many doubles as a vector holds, up to `most`.
template <int most>
using UpTo = double;

#else

HWY_INLINE hn::Vec<hn::FixedTag<double, 2> > vector_of(double a, double b) {
    constexpr hn::FixedTag<double, 2> pair;
    return hn::InterleaveLower(pair, hn::Set(pair, a), hn::Set(pair, b));
}
#if HWY_MAX_BYTES >= 32
HWY_INLINE hn::Vec<hn::FixedTag<double, 4> > vector_of(double a, double b, double c, double d) {
    return hn::Combine(hn::FixedTag<double, 4>(), vector_of(c, d), vector_of(a, b));
}
#endif

/// True or false for each lane.
template <int n>
struct WideMask {
    hn::Mask<hn::FixedTag<double, n> > lanes;

    HWY_INLINE friend WideMask operator&(WideMask a, WideMask b) { return {hn::And(a.lanes, b.lanes)}; }
    HWY_INLINE friend WideMask operator|(WideMask a, WideMask b) { return {hn::Or(a.lanes, b.lanes)}; }
    HWY_INLINE friend WideMask operator!(WideMask a) { return {hn::Not(a.lanes)}; }
};

template <int n>
struct Wide {
    using Tag = hn::FixedTag<double, n>;
    using Mask = WideMask<n>;
    hn::Vec<Tag> lanes;

    HWY_INLINE Wide() = default;  // not initialised, nor by {}: Highway's vectors for NEON are not either
    HWY_INLINE Wide(double all) : lanes(hn::Set(Tag(), all)) {}
    template <class... Double>
    requires(sizeof...(Double) == n) HWY_INLINE Wide(Double... each) : lanes(vector_of(each...)) {}
    HWY_INLINE explicit Wide(hn::Vec<Tag> each) : lanes(each) {}

    HWY_INLINE friend Wide operator+(Wide a, Wide b) { return Wide(hn::Add(a.lanes, b.lanes)); }
    HWY_INLINE friend Wide operator-(Wide a, Wide b) { return Wide(hn::Sub(a.lanes, b.lanes)); }
    HWY_INLINE friend Wide operator*(Wide a, Wide b) { return Wide(hn::Mul(a.lanes, b.lanes)); }
    HWY_INLINE friend Wide operator/(Wide a, Wide b) { return Wide(hn::Div(a.lanes, b.lanes)); }
    HWY_INLINE friend Mask operator<(Wide a, Wide b) { return {hn::Lt(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator<=(Wide a, Wide b) { return {hn::Le(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator>(Wide a, Wide b) { return {hn::Gt(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator>=(Wide a, Wide b) { return {hn::Ge(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator==(Wide a, Wide b) { return {hn::Eq(a.lanes, b.lanes)}; }
};

template <int most>
using UpTo = Wide<std::min(most, most_lanes)>;

template <int n>
inline constexpr int lane_count<Wide<n> > = n;

template <int n>
HWY_INLINE bool any(WideMask<n> mask) {
    return !hn::AllFalse(hn::FixedTag<double, n>(), mask.lanes);
}
template <int n>
HWY_INLINE bool all(WideMask<n> mask) {
    return hn::AllTrue(hn::FixedTag<double, n>(), mask.lanes);
}
template <int n>
HWY_INLINE Wide<n> select(WideMask<n> mask, Wide<n> a, Wide<n> b) {
    return Wide<n>(hn::IfThenElse(mask.lanes, a.lanes, b.lanes));
}
template <int n>
HWY_INLINE void load(const double* from, Wide<n>& to) {
    to = Wide<n>(hn::LoadU(hn::FixedTag<double, n>(), from));
}
template <int n>
HWY_INLINE void store(Wide<n> value, double* to) {
    hn::StoreU(value.lanes, hn::FixedTag<double, n>(), to);
}
template <int n>
HWY_INLINE double lane(Wide<n> value, int index) {
    alignas(64) double each[n];  // NOLINT(*-avoid-c-arrays): std::array's functions are of no target
    hn::Store(value.lanes, hn::FixedTag<double, n>(), each);
    return each[index];
}
template <int n>
HWY_INLINE bool lane(WideMask<n> mask, int index) {
    return lane(select(mask, Wide<n>(1.0), Wide<n>(0.0)), index) != 0.0;
}
template <int n>
HWY_INLINE void set_lane(Wide<n>& value, int index, double part) {
    alignas(64) double each[n];  // NOLINT(*-avoid-c-arrays): as in lane()
    hn::Store(value.lanes, hn::FixedTag<double, n>(), each);
    each[index] = part;
    value = Wide<n>(hn::Load(hn::FixedTag<double, n>(), each));
}

// Arrays of C: std::array's functions are of no target, and GCC 12 keeps what stands in one in memory.
// NOLINTBEGIN(*-avoid-c-arrays, *-member-init)

/// Rows of as many numbers as there are rows, turned into columns: number j of row i becomes number i of row
/// j.
HWY_INLINE void transpose(Wide<2> (&rows)[2]) {
    constexpr hn::FixedTag<double, 2> tag;
    const auto a = rows[0].lanes, b = rows[1].lanes;
    rows[0].lanes = hn::InterleaveLower(tag, a, b);
    rows[1].lanes = hn::InterleaveUpper(tag, a, b);
}
#if HWY_MAX_BYTES >= 32
HWY_INLINE void transpose(Wide<4> (&rows)[4]) {
    constexpr hn::FixedTag<double, 4> tag;
    const auto a = rows[0].lanes, b = rows[1].lanes, c = rows[2].lanes, d = rows[3].lanes;
    // Halves first: the processor puts them together as it loads them.
    const auto low_ac = hn::ConcatLowerLower(tag, c, a), low_bd = hn::ConcatLowerLower(tag, d, b);
    const auto high_ac = hn::ConcatUpperUpper(tag, c, a), high_bd = hn::ConcatUpperUpper(tag, d, b);
    rows[0].lanes = hn::InterleaveLower(tag, low_ac, low_bd);
    rows[1].lanes = hn::InterleaveUpper(tag, low_ac, low_bd);
    rows[2].lanes = hn::InterleaveLower(tag, high_ac, high_bd);
    rows[3].lanes = hn::InterleaveUpper(tag, high_ac, high_bd);
}
#endif

/// Sets lane(fields[k], i) to number k of structure i, for structures that begin with doubles and stand
/// `step` bytes apart, the first at `from`. count: a multiple of n.
template <int n, std::size_t count>
HWY_INLINE void load_fields(const void* from, std::size_t step, Wide<n> (&fields)[count]) {
    static_assert(count % n == 0);
    for (std::size_t k = 0; k < count; k += n) {
        Wide<n> rows[n];
        for (std::size_t i = 0; i < n; ++i)
            load(reinterpret_cast<const double*>(static_cast<const char*>(from) + i * step) + k, rows[i]);
        transpose(rows);
        for (std::size_t i = 0; i < n; ++i) fields[k + i] = rows[i];
    }
}
/// The reverse: sets number k of structure i to lane(fields[k], i).
template <int n, std::size_t count>
HWY_INLINE void store_fields(const Wide<n> (&fields)[count], void* to, std::size_t step) {
    static_assert(count % n == 0);
    for (std::size_t k = 0; k < count; k += n) {
        Wide<n> rows[n];
        for (std::size_t i = 0; i < n; ++i) rows[i] = fields[k + i];
        transpose(rows);
        for (std::size_t i = 0; i < n; ++i)
            store(rows[i], reinterpret_cast<double*>(static_cast<char*>(to) + i * step) + k);
    }
}

// NOLINTEND(*-avoid-c-arrays, *-member-init)

template <int n>
HWY_INLINE Wide<n> min(Wide<n> a, Wide<n> b) {
    return select(b < a, b, a);
}
template <int n>
HWY_INLINE Wide<n> max(Wide<n> a, Wide<n> b) {
    return select(a < b, b, a);
}
template <int n>
HWY_INLINE Wide<n> abs(Wide<n> a) {
    return Wide<n>(hn::Abs(a.lanes));
}
template <int n>
HWY_INLINE Wide<n> sqrt(Wide<n> a) {
    return Wide<n>(hn::Sqrt(a.lanes));
}

#endif

// --- Vectors in space --------------------------------------------------------------------------------------

/// What glm's vectors of doubles are, for several at once: glm's own functions are of no target.
template <class Real>
struct WideVector {
    Real x, y, z;

    HWY_INLINE friend WideVector operator+(const WideVector& a, const WideVector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    HWY_INLINE friend WideVector operator-(const WideVector& a, const WideVector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    HWY_INLINE friend WideVector operator*(const WideVector& a, Real by) {
        return {a.x * by, a.y * by, a.z * by};
    }
};

template <class Real>
struct VectorOf {
    using Type = WideVector<Real>;
};
template <>
struct VectorOf<double> {
    using Type = glm::dvec3;
};
template <class Real>
using Vector = typename VectorOf<Real>::Type;

// In the order of glm's sums. For one, dot() and cross() are glm's. What glm's vectors hold is taken number
// by number: GCC keeps them in memory where they are copied as a whole, which costs a seventh of a chain's
// time.

template <class Real>
HWY_INLINE Real dot(const WideVector<Real>& a, const WideVector<Real>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
HWY_INLINE WideVector<Real> cross(const WideVector<Real>& a, const WideVector<Real>& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

HWY_INLINE glm::dvec3 select(bool mask, const glm::dvec3& a, const glm::dvec3& b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}
template <class Mask, class Real>
HWY_INLINE WideVector<Real> select(Mask mask, const WideVector<Real>& a, const WideVector<Real>& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
HWY_INLINE glm::dvec3 lane(const glm::dvec3& value, int /*index*/) {
    return {value.x, value.y, value.z};
}
template <class Real>
HWY_INLINE glm::dvec3 lane(const WideVector<Real>& value, int index) {
    return {lane(value.x, index), lane(value.y, index), lane(value.z, index)};
}
HWY_INLINE void set_lane(glm::dvec3& value, int /*index*/, const glm::dvec3& part) {
    value.x = part.x;
    value.y = part.y;
    value.z = part.z;
}
template <class Real>
HWY_INLINE void set_lane(WideVector<Real>& value, int index, const glm::dvec3& part) {
    set_lane(value.x, index, part.x);
    set_lane(value.y, index, part.y);
    set_lane(value.z, index, part.z);
}

}  // namespace motus::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
