#include "motus/bones/chains/limited.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "limited_descent.hpp"
#include "limited_lead.hpp"
#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/chains/limited_tuning.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"
#include "per_bone.hpp"
#include "swing_twist.hpp"

namespace motus::bones::chains {
namespace {

/// A chain's length, and the least and the greatest distance of its tip from the root.
struct Reach {
    double length = 0.0;
    double inner = 0.0;

    [[nodiscard]] double unit() const { return length > 0.0 ? length : 1.0; }
};

Reach reach_of(const Limited& chain) {
    Reach reach;
    double longest = 0.0;
    for (const glm::dvec3& offset : chain.offsets) {
        const double length = length_of(offset);
        reach.length += length;
        longest = std::max(longest, length);
    }
    reach.inner = std::max(0.0, 2.0 * longest - reach.length);
    return reach;
}

/// A number in [0, 1) for each index, spread evenly: multiples of the golden ratio, generalized to several
/// dimensions.
double spread(std::size_t start, std::size_t dimension) {
    std::uint64_t bits = (start + 1) * 0x9E3779B97F4A7C15ull + (dimension + 1) * 0xD1B54A32D192ED03ull;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
    bits ^= bits >> 31;
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// The value at a share of the way between two limits; an unlimited side counts as `widest` at most.
double between(double low, double high, double widest, double share) {
    return std::lerp(std::max(low, std::min(high, 0.0) - widest), std::min(high, std::max(low, 0.0) + widest),
                     share);
}

SwingTwist clamped(const SwingTwist& angles, const JointLimits& limits) {
    return {clamp_swing(angles.swing, limits), clamp_twist(angles.twist, limits)};
}

/// Tries several starting poses and keeps the best result. Lengths in units of the chain's length, positions
/// relative to its root.
class Search {
  public:
    Search(const Limited& chain, const Reach& reach, const glm::dvec3& target, const SolverSettings& settings,
           const std::optional<glm::dquat>& orientation, const LimitedTuning& tuning)
        : chain_(chain), tuning_(tuning), pose_(chain, reach.unit()), settings_(settings) {
        // Targets are brought within this distance, beyond which only the direction counts, so that squares
        // stay in range.
        constexpr double far = 1e6;
        const glm::dvec3 half_way = 0.5 * target - 0.5 * chain.root;  // the whole might overflow
        const double distance = 2.0 * (length_of(half_way) / reach.unit());
        goal_.target = distance <= far ? 2.0 * (half_way / reach.unit()) : far * unit_vector(half_way);
        goal_.orientation = orientation;
        goal_.tolerance = 0.999999 * settings.tolerance;  // room for the rounding of the joints' places
        const double inner = reach.inner / reach.unit();
        bound_ = std::max({0.0, std::min(distance, far) - 1.0, inner - distance});
        settings_.pole.reset();
        if (settings.pole) settings_.pole = unit_vector(0.5 * *settings.pole - 0.5 * chain.root);
        // No farther and no nearer than the bones' lengths let the tip come.
        led_.target = std::clamp(glm::length(goal_.target), inner, 1.0) * unit_vector(goal_.target);
        led_.tolerance = goal_.tolerance;
    }

    /// Writes the best rotations found into `rotations`. Returns the number of iterations.
    int run(std::span<glm::dquat> rotations);
    /// Whether the best result is a minimum, as far as small steps can tell.
    [[nodiscard]] bool is_at_rest() const { return is_best_at_rest_; }
    /// Whether the tip came as near to the target as the lengths of the bones allow.
    [[nodiscard]] bool is_on_target() const { return best_residual_ <= bound_ + goal_.tolerance; }

  private:
    void find_bend(std::span<const glm::dquat> rotations);
    void start_from(std::span<const glm::dquat> rotations);
    void bend_to_middle();
    bool lead_from_pose();
    void run_leads(std::span<const glm::dquat> rotations);
    void start_from_unlimited(std::span<const glm::dquat> rotations);
    void start_from_spread(std::size_t start);
    void descend_to_goal();
    [[nodiscard]] bool is_enough() const;

    const Limited& chain_;
    const LimitedTuning& tuning_;
    LimitedPose pose_;
    SolverSettings settings_;
    Goal goal_;
    LeadGoal led_;
    double bound_ = 0.0;  // no chain of these lengths comes nearer to the target
    Angles best_;
    double best_residual_ = std::numeric_limits<double>::infinity();
    double best_angle_ = std::numeric_limits<double>::infinity();
    bool is_best_at_rest_ = false;
    int same_ = 0;  // starts that ended no better than the best did
    int iterations_ = 0;
};

void Search::start_from(std::span<const glm::dquat> rotations) {
    for (std::size_t i = 0; i < pose_.count(); ++i) {
        const glm::dquat allowed = clamp_rotation(rotations[i], pose_.limits(i));
        pose_.set_bone(i, clamped(swing_twist_of(allowed), pose_.limits(i)));
    }
}

/// Finds the side to which the given pose bends, and the side that the pole asks for.
void Search::find_bend(std::span<const glm::dquat> rotations) {
    glm::dvec3 tip(0.0);
    glm::dquat frame = chain_.base;
    for (std::size_t i = 0; i < pose_.count(); ++i) {
        frame = frame * chain_.rest[i] * rotations[i];
        tip += frame * pose_.offset(i);
    }
    const glm::dvec3 from = unit_vector(tip);
    const glm::dvec3 to = unit_vector(goal_.target);
    led_.normal = settings_.plane;
    if (from == glm::dvec3(0.0) || to == glm::dvec3(0.0)) return;
    led_.normal = glm::conjugate(smallest_turn(from, to, normal_across(from, glm::dvec3(0.0)))) * led_.normal;
    if (!settings_.pole) return;
    const glm::dvec3 pole = unit_vector(*settings_.pole);
    const glm::dvec3 side = pole - glm::dot(pole, to) * to;
    led_.certainty = smooth_step(glm::length(side) / pole_band);
    if (led_.certainty > 0.0) led_.side = unit_vector(side);
}

/// Sets the joints after the root to the middles of their limits.
void Search::bend_to_middle() {
    const SwingTwist root = pose_.angles()[0];
    start_from_spread(0);
    Angles angles;
    std::copy_n(pose_.angles().begin(), pose_.count(), angles.begin());
    angles[0] = root;
    pose_.set(angles);
}

/// Leads the given pose to the target. Returns whether it comes so near that a descent needs few steps, or
/// whether an orientation is asked for too.
bool Search::lead_from_pose() {
    iterations_ += lead(pose_, led_, tuning_, settings_.max_iterations);
    return length_of(pose_.tip() - goal_.target) <= bound_ + tuning_.led_near || goal_.orientation;
}

/// Solves the chain without limits, then turns each bone towards its next joint of that solution as far as
/// the bone's limits allow.
void Search::start_from_unlimited(std::span<const glm::dquat> rotations) {
    PerJoint joints;
    joints[0] = glm::dvec3(0.0);
    glm::dquat frame = chain_.base;
    for (std::size_t i = 0; i < pose_.count(); ++i) {
        frame = frame * chain_.rest[i] * rotations[i];
        joints[i + 1] = joints[i] + frame * pose_.offset(i);
    }
    solve({joints.data(), pose_.count() + 1}, goal_.target, settings_);
    frame = chain_.base;
    for (std::size_t i = 0; i < pose_.count(); ++i) {
        const glm::dquat socket = frame * chain_.rest[i];
        const glm::dvec3 wanted = unit_vector(joints[i + 1] - pose_.joint(i));
        const glm::dvec3 given = unit_vector(socket * (rotations[i] * pose_.offset(i)));
        glm::dquat rotation = rotations[i];
        if (wanted != glm::dvec3(0.0) && given != glm::dvec3(0.0))
            rotation = glm::conjugate(socket) *
                       smallest_turn(given, wanted, normal_across(given, glm::dvec3(0.0))) * socket *
                       rotation;
        rotation = clamp_rotation(glm::normalize(rotation), pose_.limits(i));
        pose_.set_bone(i, clamped(swing_twist_of(rotation), pose_.limits(i)));
        frame = pose_.frame(i);
    }
}

/// Sets a starting pose: start 0 is the middle of all limits, all others lie anywhere within the limits.
void Search::start_from_spread(std::size_t start) {
    for (std::size_t i = 0; i < pose_.count(); ++i) {
        const JointLimits& limits = pose_.limits(i);
        const auto share = [&](int axis) {
            return start == 0 ? 0.5 : spread(start, 3 * i + static_cast<std::size_t>(axis));
        };
        const auto angle = [&](int axis) {
            return between(limits.min[axis], limits.max[axis], tuning_.widest_start, share(axis));
        };
        const SwingTwist angles{{angle(0), angle(2)}, angle(1)};
        pose_.set_bone(i, clamped(angles, limits));
    }
}

void Search::descend_to_goal() {
    bool is_at_rest = false;
    if (std::isfinite(best_residual_) && !goal_.orientation) goal_.rival = best_residual_;
    if (goal_.orientation) {
        // First position and orientation together, then the orientation with falling weight, at last the
        // position alone.
        for (const double share : tuning_.orientation_shares) {
            goal_.orientation_weight = share;
            iterations_ += descend(pose_, goal_, tuning_, settings_.max_iterations, is_at_rest);
        }
        goal_.orientation_weight = 0.0;
    }
    iterations_ += descend(pose_, goal_, tuning_, settings_.max_iterations, is_at_rest);

    const double residual = length_of(pose_.tip() - goal_.target);
    const double angle = goal_.orientation ? glm::length(orientation_error(pose_, *goal_.orientation)) : 0.0;
    const double gain = best_residual_ - std::max(residual, goal_.tolerance);
    const bool is_nearer = gain > 1e-6;
    const bool is_turned_better = gain > -1e-6 && angle < best_angle_ - 1e-6;
    ++same_;
    if (is_nearer || is_turned_better) {
        if (gain > 1e-5 || is_turned_better) same_ = 0;
        std::copy_n(pose_.angles().begin(), pose_.count(), best_.begin());
        best_residual_ = residual;
        best_angle_ = angle;
        is_best_at_rest_ = is_at_rest;
    }
}

bool Search::is_enough() const {
    return is_on_target() && (best_angle_ <= 1e-5 || same_ >= tuning_.patience_on_target);
}

/// Leads the chain to the target from the given pose and, if that fails, from the middle of the limits, since
/// a pose may bend to the side that its limits hardly allow. A descent, which may change sides, is made only
/// if both fail.
void Search::run_leads(std::span<const glm::dquat> rotations) {
    std::array<Angles, 2> ends;
    std::size_t left = 0;
    for (const bool is_from_pose : {true, false}) {
        if (is_enough()) return;
        start_from(rotations);
        if (!is_from_pose) bend_to_middle();
        if (lead_from_pose()) {
            descend_to_goal();
        } else {
            std::copy_n(pose_.angles().begin(), pose_.count(), ends[left++].begin());
        }
    }
    for (std::size_t i = 0; i < left && !is_enough(); ++i) {
        pose_.set(ends[i]);
        descend_to_goal();
    }
}

int Search::run(std::span<glm::dquat> rotations) {
    find_bend(rotations);
    run_leads(rotations);
    for (int start = 0; start < tuning_.spread_starts + 2 && !is_enough(); ++start) {
        if (start == 0 && !settings_.pole) {
            start_from(rotations);
        } else if (start <= 1) {
            start_from_unlimited(rotations);
        } else {
            start_from_spread(static_cast<std::size_t>(start - 2));
        }
        descend_to_goal();
    }
    for (std::size_t i = 0; i < pose_.count(); ++i) rotations[i] = rotation_of(best_[i]);
    return iterations_;
}

}  // namespace

namespace {

[[nodiscard]] bool is_rotation(const glm::dquat& q) {
    constexpr double rounding = 1e-3;
    return std::abs(glm::dot(q, q) - 1.0) < rounding;  // false for NaN
}

[[nodiscard]] bool is_limit(const JointLimits& limit) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(limit.min[axis] <= limit.max[axis]) || limit.min[axis] == JointLimits::free ||
            limit.max[axis] == -JointLimits::free)
            return false;
    return true;
}

void check(const Limited& chain, std::span<const glm::dquat> rotations) {
    const std::size_t count = chain.offsets.size();
    require(chain.rest.size() == count, "rest: must be as many as offsets");
    require(chain.limits.size() == count, "limits: must be as many as offsets");
    require(rotations.size() == count, "rotations: must be as many as offsets");
    require(is_in_reach_of_doubles(chain.root), "root: must be finite, and 1e300 at most");
    require(is_rotation(chain.base), "base: must be a unit quaternion");
    require(std::ranges::all_of(chain.rest, is_rotation), "rest: must be unit quaternions");
    require(std::ranges::all_of(chain.offsets, is_in_reach_of_doubles),
            "offsets: must be finite, and 1e300 at most");
    require(std::ranges::all_of(chain.limits, is_limit), "limits: each minimum must be at most its maximum");
    require(std::ranges::all_of(rotations, is_rotation), "rotations: must be unit quaternions");
}

}  // namespace

void joints_of(const Limited& chain, std::span<const glm::dquat> rotations, std::span<glm::dvec3> joints) {
    const std::size_t count = chain.offsets.size();
    require(chain.rest.size() == count, "rest: must be as many as offsets");
    require(rotations.size() == count, "rotations: must be as many as offsets");
    require(joints.size() == count + 1, "joints: must be one more than the bones");
    require(is_in_reach_of_doubles(chain.root), "root: must be finite, and 1e300 at most");
    require(is_rotation(chain.base), "base: must be a unit quaternion");
    require(std::ranges::all_of(chain.rest, is_rotation), "rest: must be unit quaternions");
    require(std::ranges::all_of(chain.offsets, is_in_reach_of_doubles),
            "offsets: must be finite, and 1e300 at most");
    require(std::ranges::all_of(rotations, is_rotation), "rotations: must be unit quaternions");
    glm::dquat frame = chain.base;
    joints[0] = chain.root;
    for (std::size_t i = 0; i < count; ++i) {
        frame = frame * chain.rest[i] * rotations[i];
        joints[i + 1] = joints[i] + frame * chain.offsets[i];
    }
}

void bone_frames(std::span<const glm::dvec3> joints, std::span<glm::dquat> frames) {
    require(!frames.empty(), "frames: one at least is needed");
    require(joints.size() == frames.size() + 1, "joints: must be one more than the frames");
    require(std::ranges::all_of(joints, is_in_reach_of_doubles), "joints: must be finite, and 1e300 at most");
    glm::dvec3 along(0.0, 1.0, 0.0);
    glm::dquat frame(1.0, 0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const glm::dvec3 next = unit_vector(0.5 * joints[i + 1] - 0.5 * joints[i]);
        if (next != glm::dvec3(0.0)) {
            frame = glm::normalize(smallest_turn(along, next, frame * glm::dvec3(1.0, 0.0, 0.0)) * frame);
            along = next;
        }
        frames[i] = frame;
    }
}

Convergence solve_limited(const Limited& chain, const glm::dvec3& target, const SolverSettings& settings,
                          std::span<glm::dquat> rotations, const std::optional<glm::dquat>& orientation) {
    return solve_limited(chain, target, settings, rotations, orientation, LimitedTuning{});
}

Convergence solve_limited(const Limited& chain, const glm::dvec3& target, const SolverSettings& settings,
                          std::span<glm::dquat> rotations, const std::optional<glm::dquat>& orientation,
                          const LimitedTuning& tuning) {
    const std::size_t count = chain.offsets.size();
    require(count >= 1 && count <= most_bones, "offsets: a chain has 1 to 255 bones");
    check(chain, rotations);
    check(target, settings);
    require(!orientation || is_rotation(*orientation), "orientation: must be a unit quaternion");
    const Reach reach = reach_of(chain);
    PerBone<glm::dquat> given;
    std::copy(rotations.begin(), rotations.end(), given.begin());
    Search search(chain, reach, target, settings, orientation, tuning);
    Convergence report;
    report.iterations = search.run(rotations);
    bool is_at_rest = search.is_at_rest();
    if (orientation && !search.is_on_target()) {
        // The way to position and orientation may end beside a target that the way to the position alone
        // reaches.
        Search plain(chain, reach, target, settings, std::nullopt, tuning);
        report.iterations += plain.run({given.data(), count});
        if (plain.is_on_target()) {
            std::copy_n(given.begin(), count, rotations.begin());
            is_at_rest = plain.is_at_rest();
        }
    }

    PerJoint joints;
    joints_of(chain, rotations, {joints.data(), count + 1});
    report.residual = length_of(joints[count] - target);
    const double rounding = 1e-15 * (length_of(chain.root) + length_of(target));
    const double enough = settings.tolerance * reach.length + rounding;
    if (report.residual > enough) {
        const double distance = length_of(target - chain.root);
        if (distance > reach.length + enough) {
            report.reason = Reason::too_far;
        } else if (distance < reach.inner - enough) {
            report.reason = Reason::too_near;
        } else {
            report.reason = is_at_rest ? Reason::limit : Reason::iterations;
        }
    }
    return report;
}

}  // namespace motus::bones::chains
