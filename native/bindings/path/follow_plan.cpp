// Followers that are prepared once and placed at many times.
#include "follow_plan.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bones/pose_buffer.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "curve/curve.hpp"
#include "motus/path/follow.hpp"
#include "options.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double cost = 300.0;  // ns, rough, of a member
constexpr double lagging_cost = 1e3 * cost;
constexpr std::size_t progress_size = 5;  // numbers of path::Progress

/// A follower with its members, which stand at offsets along the curve, and what it needs at any time.
// The move may allocate, as that of a std::vector of what it holds may; nobody relies on it not to throw.
struct Planned {               // NOLINT(bugprone-exception-escape)
    std::size_t row = 0;       // of its first member's pose
    std::size_t follower = 0;  // row of its progress
    std::size_t place = 0;     // of its curve among those that solve() is given
    path::Timing timing;
    std::optional<double> time{};         // s; none: it follows from the frame
    std::optional<double> start_frame{};  // seconds count from here, and are 0 before; none: from frame 0
    double moved = 0.0;
    double offset = 0.0;
    std::vector<path::Follower> members{};
    bool level = false;
    path::FollowSettings settings{};
    path::FrameSettings frame{};
    curve::Extend reported = curve::Extend::clamp;
    std::optional<path::Frames> frames{};              // of the curve of the last time
    std::optional<path::Frames> aside{};               // likewise
    std::shared_ptr<const curve::ArcLength> framed{};  // which is this one

    [[nodiscard]] double seconds(double at_frame, double fps) const {
        if (time) return *time;
        if (!start_frame) return at_frame / fps;
        const double since = (at_frame - *start_frame) / fps;
        return since > 0.0 ? since : 0.0;
    }
};

[[nodiscard]] std::optional<double> optional_number(const OptionalNumber& given, const char* name) {
    if (given.is_none()) return std::nullopt;
    return number(given, name);
}

using Spaces = Typed<"list[numpy.typing.ArrayLike | None] | None">;

[[nodiscard]] std::vector<std::optional<glm::dmat4>> spaces_of(const Spaces& given) {
    std::vector<std::optional<glm::dmat4>> found;
    if (given.is_none()) return found;
    if (!py::isinstance<py::list>(given)) wrong_type(given, "spaces", "a list");
    for (const py::handle item : py::list(given)) {
        found.emplace_back();
        if (!item.is_none()) found.back() = matrix(item, "spaces");
    }
    return found;
}

/// Takes poses from a space to the world. matrix: of the space, without scale.
void move(const glm::dmat4& matrix, std::span<glm::dvec3> locations, std::span<glm::dquat> rotations) {
    const glm::dquat turn = glm::normalize(glm::quat_cast(glm::dmat3(matrix)));
    for (glm::dvec3& location : locations) location = glm::dvec3(matrix * glm::dvec4(location, 1.0));
    for (glm::dquat& rotation : rotations) rotation = turn * rotation;
}

class FollowPlan {
  public:
    void add(const WholeNumber& place, const Typed<"motus_native.Timing">& timing, const ArrayLike& offsets,
             const FrameModeName& mode, const OptionalNumber& time, const OptionalNumber& start_frame,
             const Number& moved, const Number& offset, const ExtendName& extend, const AxisName& forward,
             const AxisName& up, const Flag& rotate, const Number& lag_rate, const Text& lag_by,
             const Flag& line_up, const ArrayLike& delays, const ArrayLike& wheelbases, const Number& side,
             const Number& height, const Flag& level, const OptionalNumber& start,
             const py::kwargs& options) {
        const int curve = whole_number(place, "place");
        if (curve < 0) value_error("place", "must be 0 or more");
        Planned planned{.row = rows_,
                        .follower = count_,
                        .place = static_cast<std::size_t>(curve),
                        .timing = instance<path::Timing>(timing, "timing", "a Timing")};
        planned.time = optional_number(time, "time");
        planned.start_frame = optional_number(start_frame, "start_frame");
        planned.moved = number(moved, "moved");
        planned.offset = number(offset, "offset");
        planned.members = followers_of(offsets, delays, wheelbases);
        planned.level = flag(level, "level");
        planned.settings =
            follow_settings(extend, forward, up, rotate, lag_rate, lag_by, line_up, side, height, start);
        planned.frame = frames_read(frame_settings(mode, options, false), planned.settings, planned.level);
        // The first member of those that line up stops at the ends.
        planned.reported = planned.settings.line_up ? curve::Extend::clamp : planned.settings.extend;
        rows_ += planned.members.size();
        ++count_;
        followers_.push_back(std::move(planned));
    }

    void skip() {
        ++rows_;
        ++count_;
    }

    void solve(const py::list& curves, const Number& frame, const Number& fps,
               const Typed<"motus_native.PoseBuffer">& poses, const Spaces& spaces) {
        const double at_frame = number(frame, "frame");
        const double rate = number(fps, "fps");
        PoseBuffer& buffer = instance<PoseBuffer>(poses, "poses", "a PoseBuffer");
        const std::span<double> progress = buffer.outputs();
        if (buffer.size() != rows_) value_error("poses", "one for each member is needed");
        if (progress.size() != progress_size * count_)
            value_error("poses", "its outputs must be five numbers for each follower");
        const std::vector<std::optional<glm::dmat4>> found = spaces_of(spaces);
        for (Planned& one : followers_) {
            if (one.place >= curves.size())
                value_error("curves", "one for each place of a follower is needed");
            const py::object held = curves[one.place];  // another thread may take it out of the list
            const BoundCurve& curve = curve_argument(held);
            place(one, curve, one.seconds(at_frame, rate), buffer.locations(), buffer.rotations(),
                  progress.data() + progress_size * one.follower,
                  one.place < found.size() ? found[one.place] : std::nullopt);
        }
    }

    [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
    [[nodiscard]] std::size_t followers() const noexcept { return count_; }

  private:
    /// Writes a follower's poses and progress; NaN if it is nowhere at that time.
    static void place(Planned& one, const BoundCurve& curve, double time, std::span<glm::dvec3> locations,
                      std::span<glm::dquat> rotations, double* told, const std::optional<glm::dmat4>& space) {
        const curve::ArcLength& path = curve.path_by_length();
        const auto places = locations.subspan(one.row, one.members.size());
        const auto turns = rotations.subspan(one.row, one.members.size());
        try {
            if (one.framed != curve.path()) {
                one.frames = frames_on(curve, one.frame);
                one.aside = frames_aside(curve, one.level);
                one.framed = curve.path();
            }
            const path::Frames frames = *one.frames;  // another thread may exchange them meanwhile
            path::FollowSettings settings = one.settings;
            settings.aside = one.aside;
            {
                const ReleaseGil released(one.members.size(),
                                          one.settings.lag_rate > 0.0 ? lagging_cost : cost);
                follow(frames, one.timing, time, one.members, settings, places, turns);
                if (space) move(*space, places, one.settings.rotate ? turns : std::span<glm::dquat>{});
            }
            rows_from_quaternions(turns);
            const path::Progress found =
                path::progress(path, one.timing, time, one.moved, one.offset, one.reported);
            for (const double value :
                 {found.parameter, found.fraction, found.distance, found.speed, found.length})
                *told++ = value;
        } catch (const std::invalid_argument&) {
            constexpr double nan = std::numeric_limits<double>::quiet_NaN();
            std::ranges::fill(places, glm::dvec3(nan));
            std::ranges::fill(turns, glm::dquat(nan, nan, nan, nan));
            std::fill_n(told, progress_size, nan);
        }
    }

    std::deque<Planned> followers_;  // one that is added moves no other, at which a thread may be at work
    std::size_t rows_ = 0;
    std::size_t count_ = 0;
};

}  // namespace

void bind_follow_plan(py::module_& m) {
    py::class_<FollowPlan>(m, "FollowPlan", py::module_local(), R"(
Followers of curves, each with its members, prepared for many frames: poses as of follow(), and how far they have come.)")
        .def(py::init<>())
        .def("add", &FollowPlan::add, "place"_a, "timing"_a, "offsets"_a, "mode"_a, "time"_a = py::none(),
             "start_frame"_a = py::none(), "moved"_a = 0.0, "offset"_a = 0.0, "extend"_a = "clamp",
             "forward"_a = "Y", "up"_a = "Z", "rotate"_a = true, "lag_rate"_a = 0.0,
             "lag_by"_a = "acceleration", "line_up"_a = false, "delays"_a = 0.0, "wheelbases"_a = 0.0,
             "side"_a = 0.0, "height"_a = 0.0, "level"_a = false, "start"_a = py::none(), R"(
Adds a follower, whose members have the next rows.

place: index of its curve among those that solve() is given.  time: s; None: the frame's seconds, counted from start_frame
and 0 before, or from frame 0 if that is None.  moved, offset: added to the timing's distance where progress is told.
Everything else as in follow(). Raises ValueError or TypeError that names the argument.)")
        .def("skip", &FollowPlan::skip, R"(
Leaves out the next follower, of one member: solve() writes neither its pose nor its progress.)")
        .def("solve", &FollowPlan::solve, "curves"_a, "frame"_a, "fps"_a, "poses"_a, "spaces"_a = py::none(),
             R"(
Writes the poses of all members at a frame, as follow() does, and the progress of all followers.

curves: list of Curves.  frame, fps: numbers.  poses: a PoseBuffer of as many poses as there are members, whose outputs are
(followers, 5): parameter on the curve, fraction of its length, distance, speed, the curve's length.
spaces: for each curve the matrix (4, 4), without scale, of the space in which the curve is, or None for the world's; poses
are in the world.
What is nowhere at that time, since its distance or speed is not finite, is NaN.
Raises ValueError or TypeError that names the argument.)")
        .def_property_readonly("rows", &FollowPlan::rows, "How many members all followers have together.")
        .def_property_readonly("followers", &FollowPlan::followers, "How many followers were added.");
}

}  // namespace motus::bindings
