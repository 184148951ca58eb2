// Distances and movements of a block of vertices. As force_loops.hpp: the compiler makes vectors of it, by
// the instruction set of the function that it is inlined into. Private to pull_kernel.cpp.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "pull_kernel.hpp"

namespace motus::loops {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// squared(x, y, z) is the square of the distance of a vertex that lies there, seen from the root.
template <class Squared>
[[gnu::always_inline]] inline Seen measure(const float* __restrict positions, std::size_t count,
                                           const glm::vec3& root, float reach, float* __restrict distances,
                                           Squared&& squared) {
    constexpr float largest = std::numeric_limits<float>::max();
    const float root_x = root.x, root_y = root.y, root_z = root.z;
    int is_near = 0;
    int is_strange = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = positions[3 * i] - root_x;
        const float y = positions[3 * i + 1] - root_y;
        const float z = positions[3 * i + 2] - root_z;
        const float square = squared(x, y, z);
        const float distance = std::sqrt(square);
        distances[i] = distance;
        is_near |= static_cast<int>(distance < reach);
        is_strange |= static_cast<int>(!(square <= largest));
    }
    return {is_near != 0, is_strange != 0};
}

[[gnu::always_inline]] inline Seen measure(const float* positions, std::size_t count, const glm::vec3& root,
                                           float reach, float* distances) {
    return measure(
        positions, count, root, reach, distances,
        [](float x, float y, float z) __attribute__((always_inline)) { return x * x + y * y + z * z; });
}

[[gnu::always_inline]] inline Seen measure_by(const glm::mat3& metric, const float* positions,
                                              std::size_t count, const glm::vec3& root, float reach,
                                              float* distances) {
    const float xx = metric[0].x, xy = metric[0].y, xz = metric[0].z;
    const float yx = metric[1].x, yy = metric[1].y, yz = metric[1].z;
    const float zx = metric[2].x, zy = metric[2].y, zz = metric[2].z;
    return measure(
        positions, count, root, reach,
        distances, [=](float x, float y, float z) __attribute__((always_inline)) {
            const float a = xx * x + yx * y + zx * z;
            const float b = xy * x + yy * y + zy * z;
            const float c = xz * x + yz * y + zz * z;
            return a * a + b * b + c * c;
        });
}

[[gnu::always_inline]] inline bool are_weights(const float* __restrict weights, std::size_t count) {
    int is_outside = 0;
    for (std::size_t i = 0; i < count; ++i)
        is_outside |= static_cast<int>(!(weights[i] >= 0.0f && weights[i] <= 1.0f));
    return is_outside == 0;
}

[[gnu::always_inline]] inline void weigh(const float* __restrict weights, std::size_t count,
                                         float* __restrict forces) {
    for (std::size_t i = 0; i < count; ++i) {
        const float weighed = forces[i] * weights[i];
        forces[i] = weights[i] > 0.0f ? weighed : 0.0f;  // no force becomes NaN by a weight that is
    }
}

/// `lanes` numbers as the compiler's own vectors.
template <int lanes>
struct Vector {
    using Floats [[gnu::vector_size(lanes * sizeof(float))]] = float;
    using Bits [[gnu::vector_size(lanes * sizeof(float))]] = std::int32_t;
};

/// The numbers of `lanes` vertices fill three vectors, each with its own pattern of x, y and z. This is one
/// of them, without limits: moved = old + force * displacement, written such that a force of 0 keeps the sign
/// of a zero too, without looking for it: where the displacement is positive, as -(-old - force *
/// displacement).
template <int lanes, int third>
struct FreeThird {
    using Floats = typename Vector<lanes>::Floats;
    using Bits = typename Vector<lanes>::Bits;
    static constexpr std::ptrdiff_t start = std::ptrdiff_t{lanes} * third;

    Floats size{};
    Bits flip{};  ///< the sign bit where the displacement is positive

    [[gnu::always_inline]] explicit FreeThird(const MoveTerms& terms) {
        for (int lane = 0; lane < lanes; ++lane) {
            const float along = terms.displacement[static_cast<int>((start + lane) % 3)];
            size[lane] = along < 0.0f ? -along : along;
            flip[lane] = along < 0.0f ? 0 : std::numeric_limits<std::int32_t>::min();
        }
    }

    [[gnu::always_inline]] void move(const Floats& force, float* positions) const {
        Bits old{};
        std::memcpy(&old, positions + start, sizeof old);
        const Floats flipped = __builtin_bit_cast(Floats, old ^ flip) - force * size;
        const Bits moved = __builtin_bit_cast(Bits, flipped) ^ flip;
        std::memcpy(positions + start, &moved, sizeof moved);
    }
};

/// The same, between limits.
template <int lanes, int third>
struct ClampedThird {
    using Floats = typename Vector<lanes>::Floats;
    static constexpr std::ptrdiff_t start = std::ptrdiff_t{lanes} * third;

    Floats displacement{}, lowest{}, highest{};

    [[gnu::always_inline]] explicit ClampedThird(const MoveTerms& terms) {
        for (int lane = 0; lane < lanes; ++lane) {
            const int axis = static_cast<int>((start + lane) % 3);
            displacement[lane] = terms.displacement[axis];
            lowest[lane] = axis == terms.clamp_axis ? terms.minimum : -infinity;
            highest[lane] = axis == terms.clamp_axis ? terms.maximum : infinity;
        }
    }

    [[gnu::always_inline]] void move(const Floats& force, float* positions) const {
        Floats old{};
        std::memcpy(&old, positions + start, sizeof old);
        Floats moved = old + force * displacement;
        moved = moved > lowest ? moved : lowest;
        moved = moved < highest ? moved : highest;
        moved = force != 0.0f ? moved : old;
        std::memcpy(positions + start, &moved, sizeof moved);
    }
};

/// Written with vectors, since in place no compiler makes them by itself.
template <int lanes, template <int, int> class Third>
struct Mover {
    Third<lanes, 0> first;
    Third<lanes, 1> second;
    Third<lanes, 2> third;

    [[gnu::always_inline]] explicit Mover(const MoveTerms& terms)
        : first(terms), second(terms), third(terms) {}

    /// `lanes` vertices.
    [[gnu::always_inline]] void move(const float* forces, float* positions) const {
        typename Vector<lanes>::Floats f{};
        std::memcpy(&f, forces, sizeof f);
        if constexpr (lanes == 8) {
            first.move(__builtin_shufflevector(f, f, 0, 0, 0, 1, 1, 1, 2, 2), positions);
            second.move(__builtin_shufflevector(f, f, 2, 3, 3, 3, 4, 4, 4, 5), positions);
            third.move(__builtin_shufflevector(f, f, 5, 5, 6, 6, 6, 7, 7, 7), positions);
        } else {
            first.move(__builtin_shufflevector(f, f, 0, 0, 0, 1), positions);
            second.move(__builtin_shufflevector(f, f, 1, 1, 2, 2), positions);
            third.move(__builtin_shufflevector(f, f, 2, 3, 3, 3), positions);
        }
    }

    [[gnu::always_inline]] void move_all(const float* forces, std::size_t count, float* positions) const {
        std::size_t i = 0;
        for (; i + lanes <= count; i += lanes) move(forces + i, positions + 3 * i);
        if (i == count) return;
        std::array<float, lanes> last_forces{};
        std::array<float, std::size_t{3} * lanes> last_positions{};
        std::memcpy(last_forces.data(), forces + i, (count - i) * sizeof(float));
        std::memcpy(last_positions.data(), positions + 3 * i, 3 * (count - i) * sizeof(float));
        move(last_forces.data(), last_positions.data());
        std::memcpy(positions + 3 * i, last_positions.data(), 3 * (count - i) * sizeof(float));
    }
};

template <int lanes>
[[gnu::always_inline]] inline void move(const MoveTerms& terms, const float* forces, std::size_t count,
                                        float* positions) {
    if (terms.minimum == -infinity && terms.maximum == infinity)
        Mover<lanes, FreeThird>(terms).move_all(forces, count, positions);
    else
        Mover<lanes, ClampedThird>(terms).move_all(forces, count, positions);
}

[[gnu::always_inline]] inline void share(const glm::vec3& displacement, const float* __restrict forces,
                                         std::size_t count, Shares& shares) {
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

[[gnu::always_inline]] inline float moved_within(float from, float by, bool moves, float lowest,
                                                 float highest) {
    float to = from + by;
    to = to > lowest ? to : lowest;
    to = to < highest ? to : highest;
    return moves ? to : from;
}

[[gnu::always_inline]] inline void move_by(const MoveTerms& terms, const Shares& shares, std::size_t count,
                                           float* __restrict positions) {
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

}  // namespace motus::loops
