// Two doubles that are computed with at once, each as it would be alone. Private to the library.
// A template over `Real`, double or Pair, solves one problem or two by the same lines and to the same bits:
// it chooses by select() instead of branches, and takes sqrt, abs, min and max unqualified.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace motus {

/// A truth for each lane of a Pair.
struct PairMask {
    using Lanes __attribute__((vector_size(16))) = std::int64_t;
    Lanes lanes;  ///< all bits or none

    friend PairMask operator&(PairMask a, PairMask b) { return {a.lanes & b.lanes}; }
    friend PairMask operator|(PairMask a, PairMask b) { return {a.lanes | b.lanes}; }
    friend PairMask operator!(PairMask a) { return {~a.lanes}; }
};

struct Pair {
    using Lanes __attribute__((vector_size(16))) = double;
    Lanes lanes;

    Pair() = default;  // without values: glm's vectors are unions
    Pair(double both) : lanes{both, both} {}
    Pair(double first, double second) : lanes{first, second} {}
    explicit Pair(Lanes both) : lanes(both) {}

    friend Pair operator+(Pair a, Pair b) { return Pair(a.lanes + b.lanes); }
    friend Pair operator-(Pair a, Pair b) { return Pair(a.lanes - b.lanes); }
    friend Pair operator*(Pair a, Pair b) { return Pair(a.lanes * b.lanes); }
    friend Pair operator/(Pair a, Pair b) { return Pair(a.lanes / b.lanes); }
    friend PairMask operator<(Pair a, Pair b) { return {a.lanes < b.lanes}; }
    friend PairMask operator<=(Pair a, Pair b) { return {a.lanes <= b.lanes}; }
    friend PairMask operator>(Pair a, Pair b) { return {a.lanes > b.lanes}; }
    friend PairMask operator>=(Pair a, Pair b) { return {a.lanes >= b.lanes}; }
    friend PairMask operator==(Pair a, Pair b) { return {a.lanes == b.lanes}; }
};

// What glm's vectors and the templates ask of a Real, for one.

[[nodiscard]] inline bool any(bool mask) {
    return mask;
}
[[nodiscard]] inline bool all(bool mask) {
    return mask;
}
/// `a` where the mask holds, else `b`, whatever the other one is.
[[nodiscard]] inline double select(bool mask, double a, double b) {
    return mask ? a : b;
}
[[nodiscard]] inline bool lane(bool mask, int /*index*/) {
    return mask;
}
[[nodiscard]] inline double lane(double value, int /*index*/) {
    return value;
}
inline void set_lane(double& value, int /*index*/, double part) {
    value = part;
}

// The same for two.

[[nodiscard]] inline bool any(PairMask mask) {
    return (mask.lanes[0] | mask.lanes[1]) != 0;
}
[[nodiscard]] inline bool all(PairMask mask) {
    return (mask.lanes[0] & mask.lanes[1]) != 0;
}
[[nodiscard]] inline Pair select(PairMask mask, Pair a, Pair b) {
    return Pair(mask.lanes ? a.lanes : b.lanes);
}
[[nodiscard]] inline bool lane(PairMask mask, int index) {
    return mask.lanes[index] != 0;
}
[[nodiscard]] inline double lane(Pair value, int index) {
    return value.lanes[index];
}
inline void set_lane(Pair& value, int index, double part) {
    value.lanes[index] = part;
}

[[nodiscard]] inline Pair min(Pair a, Pair b) {
    return select(b < a, b, a);
}
[[nodiscard]] inline Pair max(Pair a, Pair b) {
    return select(a < b, b, a);
}
[[nodiscard]] inline Pair abs(Pair a) {
    return {std::abs(a.lanes[0]), std::abs(a.lanes[1])};
}
[[nodiscard]] inline Pair sqrt(Pair a) {
    return {std::sqrt(a.lanes[0]), std::sqrt(a.lanes[1])};
}

template <class Real>
inline constexpr int lane_count = 1;
template <>
inline constexpr int lane_count<Pair> = 2;

// And for vectors of either.

template <class Mask, class Real>
[[nodiscard]] inline glm::vec<3, Real> select(Mask mask, const glm::vec<3, Real>& a,
                                              const glm::vec<3, Real>& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <class Real>
[[nodiscard]] inline glm::dvec3 lane(const glm::vec<3, Real>& value, int index) {
    return {lane(value.x, index), lane(value.y, index), lane(value.z, index)};
}

template <class Real>
inline void set_lane(glm::vec<3, Real>& value, int index, const glm::dvec3& part) {
    set_lane(value.x, index, part.x);
    set_lane(value.y, index, part.y);
    set_lane(value.z, index, part.z);
}

}  // namespace motus

/// glm asks whether its vectors are of real numbers.
template <>
struct std::numeric_limits<motus::Pair> : std::numeric_limits<double> {};
