#include "pull_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "motus/core/instruction_sets.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pull_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pull_shapes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::sculpt::HWY_NAMESPACE {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Loops go over whole vectors. The rest of the vertices, filled up to one vector, goes through the same
// function once more: a second copy of the loops for it would double the code and the time to compile it.

/// How many of `count` vertices fill whole vectors.
HWY_INLINE std::size_t whole_of(std::size_t count) {
    return count - count % lanes;
}

HWY_INLINE std::array<float, lanes> filled_up(const float* numbers, std::size_t count) {
    std::array<float, lanes> all{};
    std::copy_n(numbers, count, all.begin());
    return all;
}

/// Lanes beyond the last vertex repeat that vertex.
HWY_INLINE std::array<float, 3 * lanes> vertices_filled_up(const float* positions, std::size_t count) {
    std::array<float, 3 * lanes> all{};
    for (std::size_t vertex = 0; vertex < lanes; ++vertex)
        std::copy_n(positions + 3 * std::min(vertex, count - 1), 3, &all[3 * vertex]);
    return all;
}

HWY_NOINLINE void force_whole(const ForceTerms& terms, float* values, std::size_t count) {
    with_shape(
        terms, [&](const auto& shape) HWY_ATTR __attribute__((always_inline)) {
            const float limit = terms.limit;
            for (std::size_t i = 0; i < count; i += lanes)
                hn::StoreU(forces_by(shape, limit, hn::LoadU(as_floats, values + i)), as_floats, values + i);
        });
}

void force(const ForceTerms& terms, float* values, std::size_t count) {
    const std::size_t whole = whole_of(count), rest = count - whole;
    force_whole(terms, values, whole);
    if (rest == 0) return;
    auto last = filled_up(values + whole, rest);
    force_whole(terms, last.data(), lanes);
    std::copy_n(last.begin(), rest, values + whole);
}

// --- Positions ---------------------------------------------------------------------------------------------

/// Something of `lanes` vertices along each axis.
struct Vectors {
    Floats x, y, z;
};

/// The positions of `lanes` vertices as they lie in memory: x, y, z after each other fill three vectors, each
/// with its own pattern.
using Thirds = std::array<Floats, 3>;

HWY_INLINE Thirds thirds_at(const float* positions) {
    return {hn::LoadU(as_floats, positions), hn::LoadU(as_floats, positions + lanes),
            hn::LoadU(as_floats, positions + 2 * lanes)};
}

/// A third of vertices that are all at one place.
HWY_INLINE Floats third_of(const glm::vec3& place, std::size_t third) {
    std::array<float, lanes> numbers{};
    for (std::size_t lane = 0; lane < lanes; ++lane)
        numbers[lane] = place[static_cast<int>((lanes * third + lane) % 3)];
    return hn::LoadU(as_floats, numbers.data());
}

HWY_INLINE Thirds thirds_of(const glm::vec3& place) {
    return {third_of(place, 0), third_of(place, 1), third_of(place, 2)};
}

#if HWY_TARGET <= HWY_AVX3
/// All x (axis 0), y or z. No lane has the axis in two of the thirds, so that one vector takes all of them,
/// in another order.
HWY_INLINE Floats along(int axis, const Thirds& all) {
    const Thirds axes = thirds_of({0.0f, 1.0f, 2.0f});
    const Floats wanted = floats(static_cast<float>(axis));
    const Floats mixed =
        hn::IfThenElse(axes[2] == wanted, all[2], hn::IfThenElse(axes[1] == wanted, all[1], all[0]));
    std::array<std::int32_t, lanes> from{};
    for (std::size_t lane = 0; lane < lanes; ++lane)
        from[lane] = static_cast<std::int32_t>((3 * lane + static_cast<std::size_t>(axis)) % lanes);
    return hn::TableLookupLanes(mixed, hn::SetTableIndices(as_floats, from.data()));
}
#endif

HWY_INLINE Vectors vectors_at(const float* positions) {
#if HWY_TARGET <= HWY_AVX3
    // Masks are registers of their own there: a quarter faster than LoadInterleaved3.
    const Thirds all = thirds_at(positions);
    return {along(0, all), along(1, all), along(2, all)};
#else
    Vectors all;
    hn::LoadInterleaved3(as_floats, positions, all.x, all.y, all.z);
    return all;
#endif
}

// --- Distances ---------------------------------------------------------------------------------------------

/// Squares of straight distances.
struct StraightSquare {
    glm::vec3 root;

    HWY_INLINE Floats operator()(const Vectors& at) const {
        const Floats x = at.x - floats(root.x), y = at.y - floats(root.y), z = at.z - floats(root.z);
        return x * x + y * y + z * z;
    }
};

struct MetricSquare {
    glm::vec3 root;
    glm::mat3 metric;

    HWY_INLINE Floats operator()(const Vectors& at) const {
        const Floats x = at.x - floats(root.x), y = at.y - floats(root.y), z = at.z - floats(root.z);
        const Floats a = floats(metric[0].x) * x + floats(metric[1].x) * y + floats(metric[2].x) * z;
        const Floats b = floats(metric[0].y) * x + floats(metric[1].y) * y + floats(metric[2].y) * z;
        const Floats c = floats(metric[0].z) * x + floats(metric[1].z) * y + floats(metric[2].z) * z;
        return a * a + b * b + c * c;
    }
};

/// work(squared), where squared(vectors) is the squares of distances from the root.
template <class Work>
HWY_INLINE auto with_squares(const glm::mat3* metric, const glm::vec3& root, const Work& work) {
    return metric != nullptr ? work(MetricSquare{root, *metric}) : work(StraightSquare{root});
}

/// Distances of `lanes` vertices, or their squares if the force is a function of these.
template <bool of_squares, class Squared>
HWY_INLINE Floats measured_at(const float* positions, const Squared& squared) {
    const Floats squares = squared(vectors_at(positions));
    return of_squares ? squares : hn::Sqrt(squares);
}

template <bool of_squares, class Squared>
HWY_INLINE bool measure_by(const Squared& squared, float limit, const float* positions, std::size_t count,
                           float* values) {
    Truths is_near = hn::MaskFromVec(hn::Zero(as_floats));
    for (std::size_t i = 0; i < count; i += lanes) {
        const Floats some = measured_at<of_squares>(positions + 3 * i, squared);
        is_near = hn::Or(is_near, some < floats(limit));
        hn::StoreU(some, as_floats, values + i);
    }
    return !hn::AllFalse(as_floats, is_near);
}

HWY_NOINLINE bool measure_whole(const ForceTerms& force, const glm::mat3* metric, const glm::vec3& root,
                                const float* positions, std::size_t count, float* values) {
    return with_squares(
        metric, root, [&](const auto& squared) HWY_ATTR __attribute__((always_inline)) {
            return force.of_squares ? measure_by<true>(squared, force.limit, positions, count, values)
                                    : measure_by<false>(squared, force.limit, positions, count, values);
        });
}

bool measure(const ForceTerms& force, const glm::mat3* metric, const glm::vec3& root, const float* positions,
             std::size_t count, float* values) {
    const std::size_t whole = whole_of(count), rest = count - whole;
    const bool is_near = measure_whole(force, metric, root, positions, whole, values);
    if (rest == 0) return is_near;
    const auto last = vertices_filled_up(positions + 3 * whole, rest);
    std::array<float, lanes> found{};
    const bool is_last_near = measure_whole(force, metric, root, last.data(), lanes, found.data());
    std::copy_n(found.begin(), rest, values + whole);
    return is_near || is_last_near;
}

// --- Checks and weights ------------------------------------------------------------------------------------

bool are_finite(const float* HWY_RESTRICT numbers, std::size_t count) {
    int is_strange = 0;
    for (std::size_t i = 0; i < count; ++i)
        is_strange |= static_cast<int>(!(std::abs(numbers[i]) <= std::numeric_limits<float>::max()));
    return is_strange == 0;
}

bool are_weights(const float* HWY_RESTRICT weights, std::size_t count) {
    int is_outside = 0;
    for (std::size_t i = 0; i < count; ++i)
        is_outside |= static_cast<int>(!(weights[i] >= 0.0f && weights[i] <= 1.0f));
    return is_outside == 0;
}

void weigh(const float* HWY_RESTRICT weights, std::size_t count, float* HWY_RESTRICT forces) {
    for (std::size_t i = 0; i < count; ++i) {
        const float weighed = forces[i] * weights[i];
        forces[i] = weights[i] > 0.0f ? weighed : 0.0f;  // no force becomes NaN by a weight that is
    }
}

// --- Movements ---------------------------------------------------------------------------------------------

/// The thirds of vertices, moved without limits.
struct FreeMove {
    Thirds displacement;

    HWY_INLINE explicit FreeMove(const MoveTerms& terms) : displacement(thirds_of(terms.displacement)) {}

    HWY_INLINE Floats operator()(Floats force, Floats from, std::size_t third) const {
        return from + force * displacement[third];
    }
};

/// A move between limits.
struct ClampedMove {
    FreeMove free;
    Thirds lowest, highest;

    HWY_INLINE explicit ClampedMove(const MoveTerms& terms)
        : free(terms),
          lowest(limits(-infinity, terms.clamp_axis, terms.minimum)),
          highest(limits(infinity, terms.clamp_axis, terms.maximum)) {}

    HWY_INLINE static Thirds limits(float none, int axis, float limit) {
        glm::vec3 all(none);
        all[axis] = limit;
        return thirds_of(all);
    }

    HWY_INLINE Floats operator()(Floats force, Floats from, std::size_t third) const {
        return hn::Min(hn::Max(free(force, from, third), lowest[third]), highest[third]);
    }
};

/// For each number of a third the lane of its vertex.
HWY_INLINE auto vertices_of(std::size_t third) {
    std::array<std::int32_t, lanes> vertices{};
    for (std::size_t lane = 0; lane < lanes; ++lane)
        vertices[lane] = static_cast<std::int32_t>((lanes * third + lane) / 3);
    return hn::SetTableIndices(as_floats, vertices.data());
}

/// `lanes` vertices, from where they are into `positions`. Where a force is 0 the bits stay, of a zero the
/// sign too. In thirds: StoreInterleaved3 takes twice as long.
template <class Move>
HWY_INLINE void move_some(const Move& moved, Floats forces, const Thirds& from, float* positions) {
    for (std::size_t third = 0; third < from.size(); ++third) {
        const Floats force = hn::TableLookupLanes(forces, vertices_of(third));
        const Floats to = moved(force, from[third], third);
        hn::StoreU(hn::IfThenElse(force != hn::Zero(as_floats), to, from[third]), as_floats,
                   positions + third * lanes);
    }
}

template <class Move>
HWY_INLINE void move_all(const Move& moved, const float* forces, std::size_t count, float* positions) {
    for (std::size_t i = 0; i < count; i += lanes)
        move_some(moved, hn::LoadU(as_floats, forces + i), thirds_at(positions + 3 * i), positions + 3 * i);
}

HWY_NOINLINE void move_whole(const MoveTerms& terms, const float* forces, std::size_t count,
                             float* positions) {
    if (terms.minimum == -infinity && terms.maximum == infinity)
        move_all(FreeMove(terms), forces, count, positions);
    else
        move_all(ClampedMove(terms), forces, count, positions);
}

void move(const MoveTerms& terms, const float* forces, std::size_t count, float* positions) {
    const std::size_t whole = whole_of(count), rest = count - whole;
    move_whole(terms, forces, whole, positions);
    if (rest == 0) return;
    auto last = vertices_filled_up(positions + 3 * whole, rest);
    move_whole(terms, filled_up(forces + whole, rest).data(), lanes, last.data());
    std::copy_n(last.begin(), 3 * rest, positions + 3 * whole);
}

/// How far ahead positions are asked for, in numbers: by the time they are needed they are there.
constexpr std::size_t ahead = 1024;

/// Measures, forces and moves some vertices after others, each read and written once; without limits.
/// is_elsewhere: distances are those of `measured`, else of the positions.
template <bool is_elsewhere, class Squared>
HWY_INLINE void pull_by(const ForceTerms& force, const MoveTerms& terms, const Squared& squared,
                        std::size_t count, const float* measured, const float* weights, float* positions) {
    with_shape(
        force, [&](const auto& shape) HWY_ATTR __attribute__((always_inline)) {
            constexpr bool of_squares = std::remove_cvref_t<decltype(shape)>::of_squares;
            const FreeMove moved(terms);
            const float limit = force.limit;
            for (std::size_t i = 0; i < count; i += lanes) {
                float* const some = positions + 3 * i;
                const float* const from = is_elsewhere ? measured + 3 * i : some;
                constexpr std::size_t numbers_a_line = 16;
                for (std::size_t number = 0; number < 3 * lanes; number += numbers_a_line) {
                    __builtin_prefetch(some + ahead + number, 1);
                    if constexpr (is_elsewhere) __builtin_prefetch(from + ahead + number);
                }
                const Thirds old = thirds_at(some);
                Floats values = forces_by(shape, limit, measured_at<of_squares>(from, squared));
                if (weights != nullptr) {
                    const Floats shares = hn::LoadU(as_floats, weights + i);
                    values = hn::IfThenElseZero(shares > hn::Zero(as_floats), values * shares);
                }
                move_some(moved, values, old, some);
            }
        });
}

HWY_NOINLINE void pull_whole(const ForceTerms& force, const MoveTerms& terms, const glm::vec3& root,
                             const glm::mat3* metric, std::size_t count, const float* measured,
                             const float* weights, float* positions) {
    with_squares(
        metric, root, [&](const auto& squared) HWY_ATTR __attribute__((always_inline)) {
            if (measured != nullptr)
                pull_by<true>(force, terms, squared, count, measured, weights, positions);
            else
                pull_by<false>(force, terms, squared, count, nullptr, weights, positions);
        });
}

void pull(const ForceTerms& force, const MoveTerms& terms, const glm::vec3& root, const glm::mat3* metric,
          std::size_t count, const float* measured, const float* weights, float* positions) {
    const std::size_t whole = whole_of(count), rest = count - whole;
    pull_whole(force, terms, root, metric, whole, measured, weights, positions);
    if (rest == 0) return;
    auto last = vertices_filled_up(positions + 3 * whole, rest);
    std::array<float, 3 * lanes> last_measured{};
    std::array<float, lanes> last_weights{};
    if (measured != nullptr) last_measured = vertices_filled_up(measured + 3 * whole, rest);
    if (weights != nullptr) last_weights = filled_up(weights + whole, rest);
    pull_whole(force, terms, root, metric, lanes, measured != nullptr ? last_measured.data() : nullptr,
               weights != nullptr ? last_weights.data() : nullptr, last.data());
    std::copy_n(last.begin(), 3 * rest, positions + 3 * whole);
}

void share(const glm::vec3& displacement, const float* HWY_RESTRICT forces, std::size_t count,
           Shares& shares) {
    const float x = displacement.x, y = displacement.y, z = displacement.z;
    for (std::size_t i = 0; i < count; ++i) shares.x[i] += forces[i] * x;
    for (std::size_t i = 0; i < count; ++i) shares.y[i] += forces[i] * y;
    for (std::size_t i = 0; i < count; ++i) shares.z[i] += forces[i] * z;
    for (std::size_t i = 0; i < count; ++i) {
        const float size = forces[i] < 0.0f ? -forces[i] : forces[i];
        shares.total[i] += size;
        shares.largest[i] = size > shares.largest[i] ? size : shares.largest[i];
    }
}

HWY_INLINE float moved_within(float from, float by, bool moves, float lowest, float highest) {
    float to = from + by;
    to = to > lowest ? to : lowest;
    to = to < highest ? to : highest;
    return moves ? to : from;
}

void move_by(const MoveTerms& terms, const Shares& shares, std::size_t count, float* HWY_RESTRICT positions) {
    std::array<float, 3> lowest{-infinity, -infinity, -infinity};
    std::array<float, 3> highest{infinity, infinity, infinity};
    lowest.at(static_cast<std::size_t>(terms.clamp_axis)) = terms.minimum;
    highest.at(static_cast<std::size_t>(terms.clamp_axis)) = terms.maximum;
    for (std::size_t i = 0; i < count; ++i) {
        const float total = shares.total[i];
        const bool moves = total > 0.0f;
        const float share = shares.largest[i] / (moves ? total : 1.0f);
        float* p = positions + 3 * i;
        p[0] = moved_within(p[0], shares.x[i] * share, moves, lowest[0], highest[0]);
        p[1] = moved_within(p[1], shares.y[i] * share, moves, lowest[1], highest[1]);
        p[2] = moved_within(p[2], shares.z[i] * share, moves, lowest[2], highest[2]);
    }
}

constexpr PullKernel kernel{HWY_STR(HWY_NAMESPACE),
                            &are_finite,
                            &are_weights,
                            &measure,
                            &force,
                            &weigh,
                            &move,
                            &pull,
                            &share,
                            &move_by};

}  // namespace
}  // namespace motus::sculpt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::sculpt {

std::span<const PullKernel> pull_kernels() {
    static const Kernels<PullKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::sculpt
#endif
