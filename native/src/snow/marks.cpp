#include "motus/snow/marks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/mesh/picker.hpp"
#include "movers.hpp"

namespace motus::snow {
namespace {

constexpr std::size_t grain = 256;
constexpr int most_steps = 64;
constexpr std::size_t most_looks = 10'000'000;
/// Most faces on a way that are counted.
constexpr int most_faces = 64;
/// Share of the greatest height: what presses less deep than this beyond what has pressed before is no event.
constexpr double least_share = 1.0 / 4096.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A box around a mover's triangles, in its own space.
struct Bounds {
    glm::dvec3 low{infinite};
    glm::dvec3 high{-infinite};

    explicit Bounds(const Collider& collider) {
        for (const glm::ivec3& triangle : collider.triangles()) {
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 corner(collider.positions()[static_cast<std::size_t>(triangle[i])]);
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
    }
    [[nodiscard]] bool are_any() const { return low.x <= high.x; }
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (low + high); }
    [[nodiscard]] glm::dvec3 half() const { return 0.5 * (high - low); }
    /// Longest way of a corner between two places of the mover.
    [[nodiscard]] double way(const glm::dmat4& from, const glm::dmat4& to) const {
        const glm::dmat4 change = to - from;
        double longest = 0.0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec4 at((corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                                (corner & 4U) != 0 ? high.z : low.z, 1.0);
            longest = std::max(longest, length_of(glm::dvec3(change * at)));
        }
        return longest;
    }
};

void check(const SnowLayer& layer, std::span<const double> times, std::span<const float> heights,
           const MarksSettings& settings) {
    require(!times.empty() && are_finite(times) &&
                std::ranges::adjacent_find(times, std::ranges::greater_equal{}) == times.end(),
            "times: must be finite and rise, and at least one");
    require(heights.size() == times.size() * layer.vertex_count(),
            "heights: must have one for each vertex at each time");
    require(
        std::ranges::all_of(heights, [](float height) { return height >= 0.0F && std::isfinite(height); }),
        "heights: must be at least 0 and finite");
    require(settings.packed >= 0.0 && std::isfinite(settings.packed),
            "packed: must be at least 0 and finite");
    require(settings.step > 0.0 && std::isfinite(settings.step), "step: must be greater than 0 and finite");
}

/// Whether a way out of a mover leaves more of its closed shells than it enters. skip: share of the way
/// within which faces that touch are met once.
[[nodiscard]] bool starts_inside(const Collider& mover, const glm::dvec3& start, const glm::dvec3& end,
                                 double skip) {
    int left = 0;
    double part = 0.0;
    for (int face = 0; face < most_faces && part < 1.0; ++face) {
        const auto met = mover.first_hit(start + part * (end - start), end);
        if (!met) return false;
        left += glm::dot(mover.normal(met->triangle), end - start) > 0.0 ? 1 : -1;
        if (left > 0) return true;
        part += met->part * (1.0 - part) + skip;
    }
    return false;
}

/// Clearance of a mover over the foot of a column of snow, m along the column; infinite where none of it is
/// above the foot. `inverse`: from the column's space to the mover's.
[[nodiscard]] double clearance(const Collider& mover, const Bounds& bounds, const glm::dmat4& inverse,
                               const SnowLayer::Column& column) {
    const glm::dvec3 foot(inverse * glm::dvec4(glm::dvec3(column.foot), 1.0));
    const glm::dvec3 up(inverse * glm::dvec4(glm::dvec3(column.up), 0.0));
    const double scale = length_of(up);
    if (!(scale > 0.0) || !is_finite(foot)) return infinite;
    // To beyond all of the mover, from a little below the foot, so that what lies on the foot is above it.
    const double far = (length_of(foot - bounds.middle()) + length_of(bounds.half())) / scale;
    const double below = 4.0 * mover.rounding() / scale + 1e-9 * far;
    if (!std::isfinite(far)) return infinite;
    const glm::dvec3 start = foot - below * up;
    const auto above = mover.first_hit(start, foot + far * up);
    if (!above) return infinite;
    const double found = std::max(0.0, above->part * (far + below) - below);
    // Inside of a shell, also where further ones begin within it. What is open above or below has no inside.
    const double skip = below / (far + below);
    const bool is_inside = starts_inside(mover, foot + below * up, foot - far * up, skip) &&
                           starts_inside(mover, start, foot + far * up, skip);
    return is_inside ? 0.0 : found;
}

}  // namespace

/// Looks at the movers, step by step.
class Marks::Maker {
  public:
    Maker(const SnowLayer& layer, const std::vector<Mover>& given, std::span<const double> times,
          std::span<const float> heights, const MarksSettings& settings, const Executor& executor)
        : columns_(layer.columns()),
          movers_(given),
          given_(given),
          times_(times),
          heights_(heights),
          vertex_count_(layer.vertex_count()),
          settings_(settings),
          executor_(executor) {
        std::erase_if(columns_, [&](const SnowLayer::Column& column) {
            return !(highest(column.vertex) > settings_.packed);
        });
        std::vector<glm::vec3> feet;
        feet.reserve(columns_.size());
        for (const SnowLayer::Column& column : columns_) {
            feet.push_back(column.foot);
            highest_.push_back(highest(column.vertex));
            reach_ = std::max(reach_, highest_.back());
        }
        picker_.emplace(feet, std::span<const glm::ivec3>(), executor);
        before_.assign(columns_.size(), 0.0);
        for (const Mover& mover : given) bounds_.emplace_back(*mover.collider);
    }

    /// An event and the number of its column.
    struct Found {
        std::uint32_t column = 0;
        Event event;
    };

    void make(Marks& marks) {
        if (!columns_.empty()) look();
        // By column, and within it as they came.
        std::vector<std::size_t> starts(columns_.size() + 1);
        for (const Found& found : found_) ++starts[found.column + 1];
        for (std::size_t i = 0; i < columns_.size(); ++i) starts[i + 1] += starts[i];
        std::vector<std::size_t> order(columns_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::erase_if(order, [&](std::size_t i) { return starts[i] == starts[i + 1]; });
        std::vector<Event> events(found_.size());
        std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
        for (const Found& found : found_) events[next[found.column]++] = found.event;
        std::ranges::sort(order, {}, [&](std::size_t i) { return columns_[i].vertex; });
        marks.starts_.push_back(0);
        for (const std::size_t i : order) {
            marks.vertices_.push_back(columns_[i].vertex);
            for (std::size_t at = starts[i]; at < starts[i + 1]; ++at) marks.events_.push_back(events[at]);
            marks.starts_.push_back(marks.events_.size());
        }
        marks.vertex_count_ = vertex_count_;
    }

  private:
    [[nodiscard]] double highest(std::size_t vertex) const {
        float found = 0.0F;
        for (std::size_t row = 0; row < times_.size(); ++row)
            found = std::max(found, heights_[row * vertex_count_ + vertex]);
        return static_cast<double>(found);
    }

    /// Heights at a time: of the rows before and after it, as much of the second as `share` says.
    struct Between {
        std::size_t row = 0;
        std::size_t next = 0;
        double share = 0.0;
    };
    [[nodiscard]] Between between(double time) const {
        const auto after = std::ranges::upper_bound(times_, time);
        const auto row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - times_.begin())) - 1;
        if (after == times_.begin() || after == times_.end()) return {row, row, 0.0};
        return {row, row + 1, (time - times_[row]) / (*after - times_[row])};
    }
    [[nodiscard]] double height(std::size_t vertex, const Between& at) const {
        const auto from = static_cast<double>(heights_[at.row * vertex_count_ + vertex]);
        const auto to = static_cast<double>(heights_[at.next * vertex_count_ + vertex]);
        return from + at.share * (to - from);
    }

    /// A mover's even way from one of its samples to the next.
    struct Leg {
        double start = 0.0, end = 0.0;  ///< s
        int steps = 0;                  ///< looks on the way; 0 if the mover rests
    };

    /// The legs of a mover within the stretch.
    [[nodiscard]] std::vector<Leg> legs_of(std::size_t mover) const {
        std::vector<Leg> legs;
        double before = times_.front();
        const auto go = [&](double time) {
            const double way = bounds_[mover].way(movers_.matrix(mover, before), movers_.matrix(mover, time));
            legs.push_back({before, time, way > 0.0 ? steps_of(way) : 0});
            before = time;
        };
        for (const double time : given_[mover].times)
            if (time > before && time < times_.back()) go(time);
        if (before < times_.back()) go(times_.back());
        return legs;
    }

    /// Has movers that go from the same time to the same time looked at as often as the fastest of them.
    static void look_together(std::vector<std::vector<Leg>>& legs) {
        std::vector<Leg*> moving;
        for (std::vector<Leg>& of_mover : legs)
            for (Leg& leg : of_mover)
                if (leg.steps > 0) moving.push_back(&leg);
        std::ranges::sort(moving, [](const Leg* one, const Leg* other) {
            return std::pair(one->start, one->end) < std::pair(other->start, other->end);
        });
        for (std::size_t first = 0, next = 0; first < moving.size(); first = next) {
            int steps = 0;
            for (; next < moving.size() && moving[next]->start == moving[first]->start &&
                   moving[next]->end == moving[first]->end;
                 ++next)
                steps = std::max(steps, moving[next]->steps);
            for (std::size_t i = first; i < next; ++i) moving[i]->steps = steps;
        }
    }

    /// The next look at a mover.
    struct Look {
        double time = 0.0;
        std::size_t mover = 0;
        std::size_t leg = 0;  ///< its number,
        int step = 0;         ///< and how many of its looks there are to this one

        [[nodiscard]] bool operator>(const Look& other) const {
            return std::pair(time, mover) > std::pair(other.time, other.mover);
        }
    };

    void look() {
        const std::size_t count = given_.size();
        std::vector<std::vector<Leg>> legs;
        for (std::size_t mover = 0; mover < count; ++mover) legs.push_back(legs_of(mover));
        look_together(legs);
        std::size_t looks = count;
        for (const std::vector<Leg>& of_mover : legs)
            for (const Leg& leg : of_mover) looks += static_cast<std::size_t>(leg.steps);
        require(looks <= most_looks,
                "movers: must be fewer, have fewer samples, or go less far, or step be greater: more than "
                "10,000,000 looks would be made");

        // The number of the first leg from one on in which a mover does not rest.
        const auto rests_to = [&](std::size_t mover, std::size_t leg) {
            while (leg < legs[mover].size() && legs[mover][leg].steps == 0) ++leg;
            return leg;
        };
        const auto begin_of = [&](std::size_t mover, std::size_t leg) {
            return leg < legs[mover].size() ? legs[mover][leg].start : times_.back();
        };
        const auto time_of = [&](const Look& look) {
            const Leg& leg = legs[look.mover][look.leg];
            return look.step == leg.steps ? leg.end
                                          : leg.start + (leg.end - leg.start) * look.step / leg.steps;
        };
        std::priority_queue<Look, std::vector<Look>, std::greater<>> next;
        const auto go_on = [&](std::size_t mover, std::size_t leg) {
            if (leg == legs[mover].size()) return;
            Look look{0.0, mover, leg, 1};
            look.time = time_of(look);
            next.push(look);
        };
        for (std::size_t mover = 0; mover < count; ++mover) {
            const std::size_t leg = rests_to(mover, 0);
            look_at(mover, times_.front(), begin_of(mover, leg));
            go_on(mover, leg);
        }
        while (!next.empty()) {
            Look look = next.top();
            next.pop();
            if (look.step < legs[look.mover][look.leg].steps) {
                look_at(look.mover, look.time, look.time);
                ++look.step;
                look.time = time_of(look);
                next.push(look);
            } else {
                const std::size_t leg = rests_to(look.mover, look.leg + 1);
                look_at(look.mover, look.time, begin_of(look.mover, leg));
                go_on(look.mover, leg);
            }
        }
    }

    /// Looks at a mover that goes so far, m, > 0.
    [[nodiscard]] int steps_of(double way) const {
        const double wanted = std::ceil(way / settings_.step);
        return wanted < most_steps ? std::max(1, static_cast<int>(wanted)) : most_steps;
    }

    /// Notes what a mover presses that is at a place from `start` to `end`.
    void look_at(std::size_t mover, double start, double end) {
        const Bounds& bounds = bounds_[mover];
        const glm::dmat4 matrix = movers_.matrix(mover, start), inverse = glm::inverse(matrix);
        if (!bounds.are_any() || !is_finite(inverse)) return;
        // An ellipsoid around the box and the snow that is as high as any.
        const glm::dmat3 turned(inverse);
        glm::dvec3 half = bounds.half();
        for (int axis = 0; axis < 3; ++axis)
            half[axis] += reach_ * length_of({turned[0][axis], turned[1][axis], turned[2][axis]});
        glm::mat3 metric(0.0F);
        for (int column = 0; column < 3; ++column) metric[column] = glm::vec3(turned[column] / half);
        const glm::vec3 middle(matrix * glm::dvec4(bounds.middle(), 1.0));
        constexpr float radius = 1.7322F;  // more than the root of 3
        const std::vector<std::uint32_t> near = picker_->within(middle, radius, metric);

        clearances_.resize(near.size());
        const Collider& collider = *given_[mover].collider;
        in_parts(
            near.size(), grain,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    clearances_[i] = is_beneath(columns_[near[i]], highest_[near[i]], bounds, inverse)
                                         ? clearance(collider, bounds, inverse, columns_[near[i]])
                                         : infinite;
            },
            executor_);
        const Between then = between(start), later = between(end);
        for (std::size_t i = 0; i < near.size(); ++i) {
            const std::uint32_t column = near[i];
            const double clear = std::max(clearances_[i], settings_.packed);
            const double fallen = height(columns_[column].vertex, later);
            if (!(fallen - clear > before_[column] + least_share * highest_[column])) continue;
            // What rests presses the more the more snow has fallen.
            before_[column] = std::max(before_[column], height(columns_[column].vertex, then) - clear);
            found_.push_back({column, {start, end, static_cast<float>(fallen), static_cast<float>(clear)}});
        }
    }

    /// Whether a box meets a column of snow.
    [[nodiscard]] static bool is_beneath(const SnowLayer::Column& column, double height, const Bounds& bounds,
                                         const glm::dmat4& inverse) {
        const glm::dvec3 foot(inverse * glm::dvec4(glm::dvec3(column.foot), 1.0));
        const glm::dvec3 top = foot + height * glm::dvec3(inverse * glm::dvec4(glm::dvec3(column.up), 0.0));
        constexpr double slack = 1e-6;  // of the box
        const glm::dvec3 more = slack * (glm::abs(bounds.low) + glm::abs(bounds.high));
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::min(foot[axis], top[axis]) <= bounds.high[axis] + more[axis] &&
                  std::max(foot[axis], top[axis]) >= bounds.low[axis] - more[axis]))
                return false;
        return true;
    }

    std::vector<SnowLayer::Column> columns_;  ///< on which snow comes to lie
    Movers movers_;
    const std::vector<Mover>& given_;
    std::span<const double> times_;
    std::span<const float> heights_;
    std::size_t vertex_count_;
    MarksSettings settings_;
    Executor executor_;
    std::vector<double> highest_;  ///< of each column,
    double reach_ = 0.0;           ///< and of all
    std::optional<mesh::Picker> picker_;
    std::vector<Bounds> bounds_;
    std::vector<double> before_;  ///< what was pressed away, of each column
    std::vector<double> clearances_;
    std::vector<Found> found_;
};

Marks::Marks(const SnowLayer& layer, const std::vector<Mover>& movers, std::span<const double> times,
             std::span<const float> heights, const MarksSettings& settings, const Executor& executor) {
    check(layer, times, heights, settings);
    in_ieee_floats([&] { Maker(layer, movers, times, heights, settings, executor).make(*this); });
}

void Marks::press(double time, std::span<const float> depths, std::span<const float> shares,
                  std::span<float> pressed) const {
    require(std::isfinite(time), "time: must be finite");
    require(depths.size() == vertex_count(), "depths: must be as many as the vertices");
    require(shares.empty() || shares.size() == vertex_count(),
            "shares: must be as many as the vertices, or none");
    require(pressed.size() == vertex_count(), "pressed: must be as many as the vertices");
    require(are_finite(depths), "depths: must be finite");
    require(std::ranges::all_of(shares, [](float share) { return share >= 0.0F && share <= 1.0F; }),
            "shares: must be from 0 to 1");
    in_ieee_floats([&] {
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const std::size_t vertex = vertices_[i];
            const float share = shares.empty() ? 1.0F : shares[vertex];
            if (!(share > 0.0F)) continue;
            float most = pressed[vertex];
            for (std::size_t at = starts_[i]; at < starts_[i + 1] && events_[at].start <= time; ++at) {
                const Event& event = events_[at];
                const float height = time <= event.end ? depths[vertex] : event.height;
                most = std::max(most, height - event.clearance / share);
            }
            pressed[vertex] = most;
        }
    });
}

}  // namespace motus::snow
