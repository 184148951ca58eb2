// The inner loops: runs of flakes that differ in nothing but their number and their age within a short
// interval, compiled for several instruction sets. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motus/core/unfilled.hpp"
#include "motus/snow/snow.hpp"
#include "philox.hpp"

namespace motus::snow {

/// Flakes worked on at once, and a multiple of every set's lanes.
inline constexpr std::size_t block_size = 256;

/// What is drawn: the counter's third word.
enum class Stream : std::uint32_t { place, life, depth, spin, waves, grip };

/// c0 + c1 u + c2 u^2 + c3 u^3 for u in [0, 1].
struct Cubic {
    float c0 = 0.0F, c1 = 0.0F, c2 = 0.0F, c3 = 0.0F;
};

/// By the values and slopes at its ends, the latter by whatever changes by `step` from the one to the other.
[[nodiscard]] inline Cubic cubic(double start, double slope_start, double end, double slope_end,
                                 double step) {
    const double m0 = step * slope_start, m1 = step * slope_end;
    return {static_cast<float>(start), static_cast<float>(m0),
            static_cast<float>(3.0 * (end - start) - 2.0 * m0 - m1),
            static_cast<float>(2.0 * (start - end) + m0 + m1)};
}

/// Rows of three, single precision for the loops.
using Rows = std::array<float, 9>;

/// An emitter's pose over a part of its motion, where w goes from 0 to 1: a stretch, then a turn about an
/// axis, then a rotation and a translation.
struct Glide {
    bool is_moving = false;
    Rows stretch{}, stretch_change{};
    std::array<float, 3> axis{};
    float turn = 0.0F;  ///< in whole turns
    Rows rotation{};
    std::array<float, 4> quaternion{1.0F, 0.0F, 0.0F, 0.0F};  ///< of the rotation, w, x, y, z
    std::array<float, 3> location{}, location_change{};
    std::array<float, 3> velocity{};        ///< of the location, m/s
    float w_start = 0.0F, w_change = 0.0F;  ///< at u = 0, and from there to u = 1
};

/// Entries of the integral of Rx(a) Ry(b) that are not 0 for all ages, by rows: 00 02 10 11 12 20 21 22.
inline constexpr std::size_t entries = 8;

/// A number of each flake.
using FloatRow = Unfilled<float, block_size>;

/// What Kernel::fill() keeps between its loops.
struct alignas(64) Scratch {
    FloatRow x, y, speed, size;                         ///< drawn by Stream::place,
    FloatRow life, color, tilt, turn;                   ///< by Stream::life,
    FloatRow one, two, three, offset;                   ///< by Stream::depth,
    FloatRow axis_height, axis_turn, spin, spin_phase;  ///< and by Stream::spin
    FloatRow u, age;
    std::array<FloatRow, 3> birth, direction;  ///< in the emitter's space; the former later in the world
    std::array<FloatRow, 3> velocity;          ///< the first one, in the world
    std::array<FloatRow, 3> air;               ///< what the air alone makes of the way, or of its rate
    std::array<FloatRow, 2> angles;            ///< of the steering's two turns
    Unfilled<float, entries * block_size> integral;  ///< the entries of each flake side by side
};

/// A triangle of an emitter's surface: a draw that falls on it goes to `other` unless a second one is below
/// `kept`.
struct Facet {
    std::array<float, 3> corner{}, edge1{}, edge2{}, normal{};
    float kept = 1.0F;
    std::uint32_t other = 0;
};

/// Of Shape::frustum.
struct Frustum {
    float wide = 0.0F, high = 0.0F;  ///< tangents of the half angles
    float far = 1.0F;                ///< m
    float nearest = 0.0F;            ///< cube of the least distance over the farthest
};

/// Air that moves by velocity * cos(2 pi (vector x + frequency t + phase)).
struct Wave {
    std::array<float, 3> vector{};    ///< whole turns a metre
    std::array<float, 3> velocity{};  ///< across the vector
    double frequency = 0.0;           ///< whole turns a second
    double phase = 0.0;
    float rate = 0.0F;  ///< whole turns a second, for a flake that moves as all do
};
inline constexpr std::size_t wave_count = 8;

/// Of the steering's table: the integral and its derivative by u, the rotation times the step. The angles of
/// the two turns, and their derivatives by u, in whole turns.
struct Node {
    std::array<double, entries> integral{};
    std::array<double, entries> slope{};
    std::array<double, 2> angle{}, angle_slope{};
};

/// The same table for flakes that begin at nodes of their own and so read it at random: in a cache line, the
/// integral in whole numbers of Run::unit, which keep their digits in the difference of two nodes.
struct alignas(64) OwnNode {
    std::array<std::int32_t, entries> integral{};
    std::array<float, entries> slope{};
};
struct OwnAngles {
    std::array<float, 2> angle{}, slope{};
};

/// What flakes have in common. Colours: stop s is at places[s], and from there to the next one the colour
/// changes by changes[s], in 1 / scales[s].
struct Kind {
    Key key;
    Shape shape = Shape::square;
    float radius = 1.0F;
    std::span<const Facet> facets;  ///< of Shape::surface
    Frustum frustum;                ///< of Shape::frustum
    bool turns_out = false;         ///< random_orientation, and there is a cone
    float cone_depth = 0.0F;        ///< 1 - cos(cone_angle)
    float cone_turn = 0.0F;         ///< cone_angle in whole turns
    float speed = 0.0F, speed_range = 0.0F;
    float inherited = 0.0F;  ///< share of the emitter's velocity that is added
    float size = 1.0F, size_range = 0.0F;
    bool random_color = false;
    std::array<float, 4> first_color{};
    std::span<const float> places, scales;
    std::span<const std::array<float, 4>> changes;
    bool snow = false;
    bool snow_offsets = false;
    float offset_count = 1.0F;
    float tumble = 0.0F;  ///< whole turns a second
    bool is_turbulent = false;
    float carried = 1.0F;  ///< share of its first velocity with which a flake goes through the waves
    std::array<Wave, wave_count> waves{};
};

/// Flakes of ages within one interval, u = (age - start) / step going from 0 to 1; the step is a power of
/// two.
struct Run {
    const double* ages = nullptr;         ///< block_size of them, whatever follows the first `count`
    const std::uint32_t* lows = nullptr;  ///< lower words of flake numbers, as many
    std::uint32_t high = 0;               ///< the upper word
    std::size_t count = 0;
    double start = 0.0, step = 1.0;
    Glide glide;
    Cubic way, way_rate;         ///< without steering: distance along the direction, per speed; its rate
    const Node* node = nullptr;  ///< with it: the table's node at u = 0
    const OwnNode* own_origin = nullptr;  ///< with offsets: their table's first node,
    const OwnNode* own_node = nullptr;    ///< and the one at u = 0 of a flake without offset
    const OwnAngles* own_angles = nullptr;
    float unit = 1.0F;             ///< s
    std::array<Cubic, 3> drift{};  ///< gravity's and the wind's part of the way
    std::array<Cubic, 3> drift_velocity{};
    std::array<float, wave_count> phases{}, phase_changes{};  ///< at birth, at u = 0, and from there to u = 1
    // Where to write, nullptr for what is not wanted.
    float* position = nullptr;
    float* velocity = nullptr;
    float* size = nullptr;
    float* color = nullptr;
    float* age = nullptr;
    float* rotation = nullptr;
    std::int64_t* id = nullptr;
};

/// Loops for one instruction set; all sets give the same bits.
struct Kernel {
    const char* name;
    /// time - (delay + (j + 1) / rate) of flakes j = streamed, streamed + 1, ... of the stream.
    void (*ages)(double time, double delay, double rate, std::uint64_t streamed, std::size_t count,
                 double* out);
    /// What is added to a random lifetime, in [-1, 1). count <= block_size, and both arrays go on to the next
    /// multiple of 16.
    void (*lives)(Key key, std::uint32_t high, const std::uint32_t* lows, std::size_t count, float* out);
    void (*fill)(const Kind& kind, const Run& run, Scratch& scratch);
};

/// Those that this processor can run, the fastest last.
[[nodiscard]] std::span<const Kernel> kernels();

}  // namespace motus::snow
