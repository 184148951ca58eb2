// A particle emitter without a state: everything that a flake does follows from its number and its age.
//
// Birth is a formula (births.hpp), random numbers are drawn by flake number (Philox 4x32-10, key the seed,
// counter the number and what is drawn). The flake steers through the air as noise of its age turns it about
// the world's X and Y, the integral of which is tabulated; drag, wind and gusts act by the closed form of
// linear drag: c' = g + k (W - c), piece by piece where the wind is keyed. Turbulent air is a sum of waves,
// each moving across its direction, integrated along a straight line, that of the first velocity and the
// wind. Where a flake lands first is looked for once, along its whole way, and kept with those of the flakes
// that are numbered next to it. The same bits by the same compiler (docs/library.md), for any number of
// threads, whichever time is asked for first.
//
// Costs: O(living flakes), 8 to 21 ms a million, and 10 us more for each whose landing is not known yet.
// Allocates what is returned, the landings, and some memory for its work. Any number of threads may share
// one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/snow/births.hpp"
#include "motus/snow/collider.hpp"

namespace motus::snow {

/// Where flakes are born, in the emitter's space, evenly spread; r is SnowSettings::radius. They leave along
/// +Z but where said.
enum class Shape : std::uint8_t {
    square,   ///< |x|, |y| <= r, z = 0
    disc,     ///< about Z
    box,      ///< |x|, |y|, |z| <= r
    sphere,   ///< the ball; away from its middle
    cone,     ///< the disc; leaning outwards, from 0 in the middle to cone_angle at the edge
    surface,  ///< surface_triangles; along their normals
    frustum,  ///< what a camera sees that looks along -Z, up being Y; down along the world's -Z
};

/// What a flake does from where it landed on: nothing; slide down the triangle and those beyond its edges; or
/// become smaller and vanish.
enum class Collision : std::uint8_t { stay, slide, melt };

struct GradientStop {
    float position = 0.0F;
    glm::vec4 color{1.0F};
};

/// What flakes land on, from either side, that goes from place to place as it is, and carries them along.
struct Mover {
    std::shared_ptr<const Collider> collider;  ///< triangles in the mover's own space
    std::vector<double> times;  ///< strictly rising; matrices go evenly from each to the next, and are held
    std::vector<glm::dmat4> matrices;  ///< to world space, one for each time, at least one
};

/// Metres, seconds, radians, world space; every number finite.
struct SnowSettings {
    double start_speed = 5.0;
    double lifetime = 2.0;  ///< >= 0
    double start_size = 1.0;
    std::vector<GradientStop> start_color =
        std::vector<GradientStop>(1);  ///< positions rising; linear between; its first colour counts

    double rate = 5.0;      ///< flakes a second, >= 0
    RateKeys rate_keys;     ///< in place of it, by the time of the snow
    double delay = 0.0;     ///< >= 0
    double duration = 5.0;  ///< >= 0
    bool looping = true;    ///< flakes are born for ever, whatever the duration is
    std::vector<Burst> bursts;

    Shape shape = Shape::square;
    std::vector<glm::vec3> surface_positions;   ///< vertices, in the emitter's space
    std::vector<glm::ivec3> surface_triangles;  ///< of which at least one has an area, of Shape::surface
    glm::dvec2 frustum_angles{0.4, 0.25};       ///< half the angles in X and in Y, [0, pi / 2)
    double frustum_near = 0.1;                  ///< [0, frustum_far], m along -Z
    double frustum_far = 20.0;                  ///< > 0
    double cone_angle = 0.0;                    ///< half the opening, [0, pi]
    double cone_radius = 1.0;                   ///< >= 0, r above

    bool random_speed = false;        ///< start_speed +-1 m/s
    bool random_orientation = false;  ///< leaving anywhere within cone_angle of where it would leave
    bool random_lifetime = false;     ///< lifetime +-1 s, at least 0
    bool random_size = false;         ///< start_size +-10 %
    bool random_color = false;        ///< anywhere on the gradient

    bool snow = false;                      ///< flakes turn as they fly
    double max_angle = 1.3962634015954636;  ///< of the turn about X and about Y, [-1e6, 1e6]
    double snow_frequency = 1.0;            ///< of the noise that turns them, 1/s, (0, 1000]
    bool snow_offsets = false;              ///< each flake begins at a time of its own in the noise

    bool gravity = false;
    glm::dvec3 acceleration{0.0, 0.0, -9.81};  ///< of gravity, m/s^2

    double drag = 0.0;                    ///< 1/s, [0, 1000]; without it there is no wind
    glm::dvec3 wind{0.0};                 ///< velocity of the air, m/s
    std::vector<double> wind_times;       ///< strictly rising; with them the wind goes evenly from each of
    std::vector<glm::dvec3> wind_values;  ///< these to the next, held before the first and after the last
    double gusts = 0.0;                   ///< how much the wind varies, fraction of it, >= 0
    double gust_frequency = 0.3;          ///< 1/s, (0, 1000]

    double period = 0.0;  ///< s, after which gusts and turbulent air are as they were, [1e-6, 1e30]; 0: never

    double turbulence = 0.0;       ///< root mean square of the velocity of turbulent air, m/s, >= 0
    double turbulence_size = 1.0;  ///< of its eddies, m, > 0

    double tumble = 0.0;  ///< rad/s: each flake turns about an axis of its own at up to this speed, >= 0

    std::optional<double> ground;  ///< height that flakes land on from above, if no triangle is there
    std::shared_ptr<const Collider> collider;  ///< triangles that they land on from either side
    std::vector<Mover> movers;  ///< which nothing slides down, and no snow lies on for touchdowns()
    Collision collision = Collision::stay;
    double rest_time = std::numeric_limits<double>::infinity();  ///< how long a landed flake lives at most
    double melt_time = 1.0;  ///< the same of one that melts, and how long it takes to
    double friction = 0.5;   ///< of what slides, as `acceleration` pulls it, with gravity or without, >= 0

    std::uint64_t seed = 0;

    std::vector<double> emitter_times;         ///< strictly rising; held before the first and after the last
    std::vector<glm::dmat4> emitter_matrices;  ///< one for each time; none: the identity
    double inherited = 0.0;  ///< share of the velocity of the emitter's origin that flakes leave with as well
};

/// Arrays of as many rows as there are living flakes; empty ones are not filled.
struct Fields {
    std::span<glm::vec3> position{};
    std::span<glm::vec3> velocity{};  ///< derivative of the position
    std::span<float> size{};
    std::span<glm::vec4> color{};
    std::span<float> age{};
    std::span<glm::vec4> rotation{};  ///< unit quaternion w, x, y, z: turns +Z to where the flake heads
    std::span<std::int64_t> id{};
};

/// Where and when a flake lands: a collision event.
struct Touchdown {
    double time = 0.0;
    std::uint64_t id = 0;
    glm::vec3 point{0.0F};
    std::int32_t triangle = -1;  ///< of the collider; -1: the ground
    bool is_behind = false;      ///< it came from where the triangle's normal does not point to
};

struct LandingPage;  ///< where the flakes of a block of 256 numbers land; private to the library

/// The flakes of one snow that live at a time. An immutable value; what is moved from has none.
class Living {
  public:
    Living() = default;  // of no snow

    [[nodiscard]] double time() const noexcept { return parts_ ? parts_->time : 0.0; }
    /// Number of the oldest that may be living.
    [[nodiscard]] std::uint64_t first() const noexcept { return parts_ ? parts_->first : 0; }
    /// Number after the youngest.
    [[nodiscard]] std::uint64_t last() const noexcept { return parts_ ? parts_->last : 0; }
    /// How many live.
    [[nodiscard]] std::size_t count() const noexcept { return parts_ ? parts_->count : 0; }

  private:
    friend class Snow;
    struct Parts {
        double time = 0.0;
        std::uint64_t first = 0, last = 0;
        std::size_t count = 0;
        std::vector<std::size_t>
            before{};  ///< that live before each block of 256 numbers; empty: all of them
        std::vector<std::shared_ptr<const LandingPage>> pages{};  ///< of Snow::known(): null: left out
        std::shared_ptr<const void> snow{};                       ///< what all copies of its snow share
    };
    explicit Living(Parts parts) : parts_(std::make_shared<const Parts>(std::move(parts))) {}

    std::shared_ptr<const Parts> parts_;
};

/// Immutable but for where flakes land, which is kept for the 18 million of all snows looked up last (1 GB),
/// as long as the snow or a copy is there, so that several threads may ask at once. Copies share all that
/// they have, and to move one is to copy it.
class Snow {
  public:
    static constexpr double most_flakes = 1e8;      ///< living at once
    static constexpr double most_touchdowns = 1e7;  ///< flakes born until the end of touchdowns()

    /// Throws std::invalid_argument, naming the argument, where a value is outside its domain, or more flakes
    /// than most_flakes would live at once.
    explicit Snow(const SnowSettings& settings);
    ~Snow() = default;
    Snow(const Snow&) noexcept = default;
    Snow& operator=(const Snow&) noexcept = default;
    // What is moved from stays the snow that it was.
    // NOLINTNEXTLINE(performance-move-constructor-init): copying is what it is for, and costs a counter
    Snow(Snow&& other) noexcept : Snow(std::as_const(other)) {}
    Snow& operator=(Snow&& other) noexcept { return *this = std::as_const(other); }

    /// Flakes with 0 <= age < lifetime that have not rested, or melted, for their time. Throws
    /// std::invalid_argument where the time is not finite.
    [[nodiscard]] Living living(double time, const Executor& executor = {}) const;

    /// Those of them whose landing place is known by now. To find one takes some 10 us, once for each flake;
    /// living() finds them all.
    [[nodiscard]] Living known(double time, const Executor& executor = {}) const;
    /// Finds where flakes land of up to `most` blocks of 256 of those that live at a time. Returns how many
    /// blocks remain. Throws as living() does.
    [[nodiscard]] std::size_t find_landings(double time, std::size_t most,
                                            const Executor& executor = {}) const;

    /// Fills the fields in the order of flake numbers. Throws std::invalid_argument, before anything is
    /// written, where the living flakes are not of this snow or a copy, or a field that is not empty has
    /// another number of rows than there are of them.
    void evaluate(const Living& living, const Fields& out, const Executor& executor = {}) const;

    /// Where flakes land until the end, but for movers, by time and then by number. Throws
    /// std::invalid_argument where the end is not finite, or more than most_touchdowns flakes are born until
    /// then.
    [[nodiscard]] std::vector<Touchdown> touchdowns(double end, const Executor& executor = {}) const;

    // SnowSettings.
    [[nodiscard]] const std::shared_ptr<const Collider>& collider() const noexcept;
    [[nodiscard]] const glm::dvec3& acceleration() const noexcept;

  private:
    struct Parts;
    class Rows;
    std::shared_ptr<const Parts> parts_;  ///< never null
};

}  // namespace motus::snow
