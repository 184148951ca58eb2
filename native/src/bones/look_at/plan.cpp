#include "motus/bones/look_at/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "gaze_bone.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::look_at {
namespace {

constexpr double same_place = 1e-12;  // of the distances from the origin
constexpr double least_sine = 1e-9;   // between forward and up
constexpr glm::dvec3 along_bone{0.0, 1.0, 0.0};

double largest_part(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Direction from a place to the target; none if the two coincide.
std::optional<glm::dvec3> towards(const glm::dvec3& place, const glm::dvec3& target) {
    const glm::dvec3 way = target - place;
    if (largest_part(way) <= same_place * (largest_part(place) + largest_part(target))) return std::nullopt;
    return direction_of(way);
}

bool has_finite_numbers(const SideLimits& s) {
    return are_finite(s.left, s.right, s.up, s.down);
}

bool has_finite_numbers(const GazeSettings& s) {
    return are_finite(s.weight, s.body_weight, s.head_weight, s.eyes_weight, s.clamp, s.body_limit,
                      s.head_limit, s.eyes_limit) &&
           has_finite_numbers(s.head_sides) && has_finite_numbers(s.eyes_sides);
}

bool has_finite_numbers(const GazeTarget& target) {
    return is_finite(target.place) && std::isfinite(target.weight);
}

double share(double weight) {
    return std::clamp(weight, 0.0, 1.0);
}

double weight_of(double weight) {
    return std::max(weight, 0.0);
}

double weight_of(const GazeTarget& target) {
    return weight_of(target.weight);
}

/// A power of two, by its exponent, from which the weights are not far and which they do not exceed: of
/// weights in its unit the sum is finite.
int unit_of_weights(const GazeInput& input) {
    double largest = weight_of(input.target_weight);
    for (const GazeTarget& target : input.further) largest = std::max(largest, weight_of(target));
    int exponent = 0;
    static_cast<void>(std::frexp(largest, &exponent));
    return exponent;
}

double sum_of_weights(const GazeInput& input) {
    double sum = weight_of(input.target_weight);
    for (const GazeTarget& target : input.further) sum += weight_of(target);
    return sum;
}

}  // namespace

/// The solver of one entry at one moment.
class GazePlan::Solver {
  public:
    /// input: its head_forward and up are unit, its target is in the rig's space.
    /// to_rig: from the world, of further targets.
    Solver(const RigView& rig, const Entry& entry, const GazeInput& input, const glm::dmat4& to_rig,
           std::span<glm::dquat> rotations)
        : rig_(rig),
          entry_(entry),
          input_(input),
          to_rig_(to_rig),
          settings_(input.settings),
          rotations_(rotations) {}

    /// None if something is not finite, or a bone that looks has no size.
    [[nodiscard]] std::optional<GazeDiagnostics> run() {
        const Link& first = entry_.body.empty() ? entry_.head : entry_.body.front();
        const int parent = rig_.parents()[first.bone];
        if (parent >= 0) base_ = matrix_at(rig_.poses(), static_cast<std::size_t>(parent));

        const GazeBone animated(rig_, entry_.head.bone, carried(entry_.body, base_));
        const std::optional<glm::dvec3> gaze = animated.gaze(input_.head_forward);
        if (!animated.is_finite() || !gaze || !set_chart(animated)) return std::nullopt;
        const glm::dvec2 from = chart_->place(*gaze);

        GazeBone head = turn_body(animated, from);
        if (!turn_head(head, from)) return std::nullopt;
        const bool eyes_turn = settings_.eyes_weight > 0.0 || input_.eyes_beside != glm::dvec2(0.0);
        if (eyes_turn && !turn_eyes(animated, head)) return std::nullopt;
        if (report_.angle > reached_angle && is_limited_) report_.reason = Reason::limit;
        return report_;
    }

  private:
    /// Pose of the last of these bones as they are animated; the pose of their parent if there are no bones.
    [[nodiscard]] glm::dmat4 carried(std::span<const Link> links, glm::dmat4 pose) const {
        for (const Link& link : links) pose = GazeBone(rig_, link.bone, pose).pose();
        return pose;
    }

    /// Direction from a place to look in; none if no target of weight lies apart from the place.
    [[nodiscard]] std::optional<glm::dvec3> wanted(const glm::dvec3& place) const {
        if (input_.further.empty()) return towards(place, input_.target);
        glm::dvec2 sum(0.0);
        double weights = 0.0;
        const int unit = unit_of_weights(input_);
        const auto add = [&](const glm::dvec3& target, double given) {
            const std::optional<glm::dvec3> direction = towards(place, target);
            const double weight = std::scalbn(given, -unit);
            if (!direction || weight == 0.0) return;
            sum += weight * chart_->place(*direction);
            weights += weight;
        };
        add(input_.target, weight_of(input_.target_weight));
        for (const GazeTarget& target : input_.further)
            add(glm::dvec3(to_rig_ * glm::dvec4(target.place, 1.0)), weight_of(target));
        if (weights == 0.0) return std::nullopt;
        return chart_->direction(sum / weights);
    }

    [[nodiscard]] bool set_chart(const GazeBone& head) {
        const std::optional<glm::dvec3> forward = head.gaze_at_rest(input_.head_forward);
        const std::optional<glm::dvec3> up = direction_of(head.up_at_rest(input_.head_forward, input_.up));
        if (!forward || !up || glm::length(glm::cross(*up, *forward)) < least_sine) return false;
        chart_.emplace(*forward, *up, level_for(settings_));
        return true;
    }

    void write(const Link& link, const std::optional<glm::dquat>& turn) {
        if (turn) rotations_[*link.row] = *turn;
    }

    /// The step that a bone whose animated gaze is at `animated` takes of the turn from `present` to a
    /// direction.
    [[nodiscard]] GazeStep step(const glm::dvec3& direction, const glm::dvec2& animated,
                                const glm::dvec2& present, const GazePart& part) {
        const glm::dvec2 target = chart_->place(direction);
        const GazeStep result = gaze_share(present, gaze_goal(animated, target, settings_), target, part);
        is_limited_ = is_limited_ || result.is_limited;
        return result;
    }

    /// Turns the body; returns the head as the turned body carries it.
    [[nodiscard]] GazeBone turn_body(const GazeBone& animated, const glm::dvec2& from) {
        if (entry_.turning == 0) return animated;
        const std::optional<glm::dvec3> direction = wanted(animated.place());
        if (!direction) return animated;
        const glm::dvec2 by = step(*direction, from, from, {settings_.body_weight, settings_.body_limit}).by;
        if (by == glm::dvec2(0.0)) return animated;
        glm::dmat4 pose = base_;
        glm::dquat last = chart_->level(from);
        double turned = 0.0;
        for (const Link& link : entry_.body) {
            GazeBone bone(rig_, link.bone, pose);
            if (link.row) {
                const double part = ++turned / static_cast<double>(entry_.turning);
                const glm::dquat next = chart_->level(from + part * by);
                write(link, bone.turn(next * glm::conjugate(last), along_bone));
                last = next;
            }
            pose = bone.pose();
        }
        return {rig_, entry_.head.bone, pose};
    }

    [[nodiscard]] bool turn_head(GazeBone& head, const glm::dvec2& from) {
        const std::optional<glm::dvec3> direction = wanted(head.place());
        const std::optional<glm::dvec3> gaze = head.gaze(input_.head_forward);
        if (!head.is_finite() || !gaze) return false;
        if (!direction) return true;
        const glm::dvec2 seen = chart_->yaw_pitch(*direction);
        report_.yaw = seen.x;
        report_.pitch = seen.y;
        report_.angle = turn(head, entry_.head, input_.head_forward, *direction, from,
                             {settings_.head_weight, settings_.head_limit, settings_.head_sides});
        return true;
    }

    /// Turns each eye, from its own place. An eye without size stays as it is.
    [[nodiscard]] bool turn_eyes(const GazeBone& animated_head, const GazeBone& head) {
        std::optional<double> worst;
        for (std::size_t i = 0; i < entry_.eyes.size(); ++i) {
            const std::vector<Link>& links = entry_.eyes[i];
            const std::optional<glm::dvec3> forward = direction_of(input_.eyes_forward[i]);
            if (!forward) return false;
            const Link& last = links.back();
            const std::span<const Link> between(links.data(), links.size() - 1);
            const GazeBone animated(rig_, last.bone, carried(between, animated_head.pose()));
            GazeBone eye(rig_, last.bone, carried(between, head.pose()));
            if (!animated.is_finite() || !eye.is_finite()) return false;
            const std::optional<glm::dvec3> from = animated.gaze(*forward);
            const std::optional<glm::dvec3> direction = wanted(eye.place());
            if (!from || !eye.gaze(*forward) || !direction) continue;
            const GazePart part{settings_.eyes_weight, settings_.eyes_limit, settings_.eyes_sides};
            const double angle =
                input_.eyes_beside == glm::dvec2(0.0)
                    ? turn(eye, last, *forward, *direction, chart_->place(*from), part)
                    : turn_beside(eye, last, *forward, *direction, chart_->place(*from), part);
            worst = std::max(worst.value_or(0.0), angle);
        }
        if (settings_.eyes_weight > 0.0) report_.angle = worst.value_or(report_.angle);
        return true;
    }

    /// Turns an eye beside what it turns to; returns the angle that would be left to the target otherwise.
    double turn_beside(GazeBone& eye, const Link& link, const glm::dvec3& axis, const glm::dvec3& direction,
                       const glm::dvec2& animated, const GazePart& part) {
        const glm::dvec2 present = chart_->place(*eye.gaze(axis));
        const glm::dvec2 target = chart_->place(direction);
        const glm::dvec2 goal = gaze_goal(animated, target, settings_).by;
        // The share and what comes beside it are limited together, so that the sum begins at the share
        // itself.
        const glm::dvec2 beside =
            present + share(part.weight) * (goal - present) + share(settings_.weight) * input_.eyes_beside;
        const glm::dvec2 by = gaze_share(present, {beside, false}, target, {1.0, part.limit, part.sides}).by;
        if (by != glm::dvec2(0.0)) write(link, eye.turn(chart_->turn(present, present + by), axis));
        const glm::dvec2 without = step(direction, animated, present, part).by;
        return angle_between(chart_->direction(present + without), direction);
    }

    /// Turns the head or an eye; returns the angle that is left to the target.
    double turn(GazeBone& bone, const Link& link, const glm::dvec3& axis, const glm::dvec3& direction,
                const glm::dvec2& animated, const GazePart& part) {
        const glm::dvec2 present = chart_->place(*bone.gaze(axis));
        const glm::dvec2 by = step(direction, animated, present, part).by;
        if (by != glm::dvec2(0.0)) write(link, bone.turn(chart_->turn(present, present + by), axis));
        return angle_between(bone.gaze(axis).value_or(direction), direction);
    }

    const RigView& rig_;
    const Entry& entry_;
    const GazeInput& input_;
    const glm::dmat4& to_rig_;
    const GazeSettings& settings_;
    std::span<glm::dquat> rotations_;
    glm::dmat4 base_{1.0};
    std::optional<GazeChart> chart_;
    GazeDiagnostics report_;
    bool is_limited_ = false;
};

std::vector<GazePlan::Link> GazePlan::way(int from, int above, const char* what) const {
    const auto count = static_cast<int>(parents_.size());
    if (from < 0 || from >= count)
        throw std::invalid_argument(std::string(what) + ": there is no bone " + std::to_string(from));
    std::vector<Link> links;
    for (int bone = from; bone != above; bone = parents_[static_cast<std::size_t>(bone)]) {
        if (bone < 0 || links.size() == parents_.size())
            throw std::invalid_argument(std::string(what) + ": bone " + std::to_string(from) +
                                        " is not above bone " + std::to_string(above));
        links.push_back({static_cast<std::size_t>(bone), std::nullopt});
    }
    std::reverse(links.begin(), links.end());
    return links;
}

void GazePlan::add(const GazeBones& bones) {
    Entry entry;
    entry.first_row = rows_.size();
    const auto give_row = [&](Link& link) {
        link.row = rows_.size() - entry.first_row;
        rows_.push_back(static_cast<int>(link.bone));
    };
    if (way(bones.head, -1, "heads").empty()) throw std::invalid_argument("heads: no bone");
    int below = -1;
    for (const int bone : bones.body) {
        std::vector<Link> links = way(bone, below, "bodies");
        if (links.empty()) throw std::invalid_argument("bodies: a bone is there twice");
        give_row(links.back());
        const auto first = below < 0 ? links.end() - 1 : links.begin();
        entry.body.insert(entry.body.end(), first, links.end());
        below = bone;
    }
    if (below >= 0) {
        std::vector<Link> links = way(bones.head, below, "bodies");
        if (links.empty()) throw std::invalid_argument("bodies: the head is one of them");
        entry.body.insert(entry.body.end(), links.begin(), links.end() - 1);
    }
    entry.turning = bones.body.size();
    entry.head.bone = static_cast<std::size_t>(bones.head);
    give_row(entry.head);
    for (const int eye : bones.eyes) {
        entry.eyes.push_back(way(eye, bones.head, "eyes"));
        if (entry.eyes.back().empty()) throw std::invalid_argument("eyes: an eye is the head");
        give_row(entry.eyes.back().back());
    }
    entry.row_count = rows_.size() - entry.first_row;
    eye_counts_.push_back(bones.eyes.size());
    entries_.push_back(std::move(entry));
}

GazePlan::GazePlan(std::span<const int> parents, std::span<const GazeBones> entries)
    : parents_(parents.begin(), parents.end()) {
    const auto count = static_cast<int>(parents_.size());
    for (const int parent : parents_) {
        if (parent < -1 || parent >= count)
            throw std::invalid_argument("parents: there is no bone " + std::to_string(parent));
    }
    for (const GazeBones& bones : entries) add(bones);
}

void GazePlan::solve(const RigView& rig, const glm::dmat4& world, std::span<const GazeInput> inputs,
                     std::span<glm::dquat> rotations, std::span<GazeDiagnostics> reports) const {
    if (inputs.size() != size()) throw std::invalid_argument("inputs: one per entry is needed");
    if (reports.size() != size()) throw std::invalid_argument("reports: one per entry is needed");
    if (rotations.size() != rows_.size()) throw std::invalid_argument("rotations: one per row is needed");
    const std::size_t bones = parents_.size();
    const bool has_own_parents = rig.parents().data() == parents_.data() && rig.size() == bones;
    if (!has_own_parents && !std::ranges::equal(rig.parents(), parents_))
        throw std::invalid_argument("rig: its parents must be the plan's");
    if (rig.poses().size() != 16 * bones || rig.basis().size() != 16 * bones)
        throw std::invalid_argument("rig: must have poses and basis");

    const glm::dmat4 to_rig = glm::inverse(world);
    const GazeDiagnostics meaningless{0.0, std::nullopt, 0.0, 0.0};
    for (std::size_t i = 0; i < size(); ++i) {
        if (inputs[i].eyes_forward.size() != entries_[i].eyes.size())
            throw std::invalid_argument("eyes_forward: one per eye is needed");
    }
    for (std::size_t i = 0; i < size(); ++i) {
        const Entry& entry = entries_[i];
        const std::span<glm::dquat> rows = rotations.subspan(entry.first_row, entry.row_count);
        std::fill(rows.begin(), rows.end(), no_turn);
        reports[i] = inputs[i].is_on ? meaningless : GazeDiagnostics{};
        if (!inputs[i].is_on) continue;

        GazeInput input = inputs[i];
        const std::optional<glm::dvec3> head_forward = direction_of(input.head_forward);
        const std::optional<glm::dvec3> up = direction_of(input.up);
        input.target = glm::dvec3(to_rig * glm::dvec4(input.target, 1.0));
        if (!has_finite_numbers(input.settings) ||
            !has_finite_numbers(GazeTarget{input.target, input.target_weight}) ||
            !is_finite(input.eyes_beside) ||
            !std::ranges::all_of(input.further,
                                 [](const GazeTarget& one) { return has_finite_numbers(one); }) ||
            !head_forward || !up)
            continue;
        input.settings.weight *= std::min(sum_of_weights(input), 1.0);
        input.head_forward = *head_forward;
        input.up = *up;
        if (const std::optional<GazeDiagnostics> report = Solver(rig, entry, input, to_rig, rows).run())
            reports[i] = *report;
        else
            std::fill(rows.begin(), rows.end(), no_turn);
    }
}

}  // namespace motus::bones::look_at
