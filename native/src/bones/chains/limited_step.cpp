#include "limited_step.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace motus::bones::chains {
namespace {

using std::numbers::pi;

/// How the tip moves by a radian of each of a joint's angles.
struct Lever {
    glm::dvec3 x, z, twist;
};

double kept_twist(double twist, const JointLimits& limits) {
    return limits.max.y - limits.min.y >= 2.0 * pi ? twist : std::clamp(twist, limits.min.y, limits.max.y);
}

/// The step dq that makes |dq|^2 + |error - J dq|^2 / damping least within the limits, which are convex: of
/// all such problems the solution is dq = nearest_within(q + J^T y) - q, and y, a vector of three numbers,
/// the root of J dq(y) + damping y - error, a monotone function (the dual of a quadratic program). Found by
/// Newton's method.
class Step {
  public:
    /// A step of the joints from `first` on.
    Step(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& error, std::size_t first)
        : pose_(pose),
          tuning_(tuning),
          error_(error),
          first_(first),
          damping_(tuning.step_damping * glm::length(error) + 1e-14) {
        for (std::size_t i = first; i < pose_.count(); ++i) {
            const glm::dquat& socket = pose_.socket(i);
            const SwingRates rates = swing_rates(pose_.angles()[i].swing);
            const glm::dvec3 arm = pose_.tip() - pose_.joint(i);
            levers_[i] = {glm::cross(socket * rates.x, arm), glm::cross(socket * rates.z, arm),
                          glm::cross(pose_.twist_axis(i), arm)};
        }
    }

    /// Keeps only the part of the step that moves the tip along a unit vector.
    void keep_along(const glm::dvec3& along) {
        const glm::dmat3 kept = glm::outerProduct(along, along);
        for (std::size_t i = first_; i < pose_.count(); ++i)
            levers_[i] = {kept * levers_[i].x, kept * levers_[i].z, kept * levers_[i].twist};
        idle_ = glm::dmat3(1.0) - kept;
    }

    bool run() {
        glm::dvec3 pull(0.0);
        double miss = evaluate(pull);
        const double exact = 1e-10 * miss;
        for (int round = 0; round < tuning_.most_dual_rounds && miss > exact; ++round) {
            const glm::dvec3 way = glm::inverse(slope_) * value_;
            double share = 1.0;
            double now = evaluate(pull - way);
            for (; now > miss && share > 0.01; now = evaluate(pull - share * way)) share *= 0.5;
            pull -= share * way;
            miss = now;
        }
        return apply();
    }

  private:
    /// Evaluates the function of the dual problem at `pull`: the turns are left in turned_, the value in
    /// value_, the slope in slope_.
    double evaluate(const glm::dvec3& pull) {
        value_ = damping_ * pull + idle_ * pull - error_;
        slope_ = glm::dmat3(damping_) + idle_;
        for (std::size_t i = first_; i < pose_.count(); ++i) {
            const Lever& lever = levers_[i];
            const SwingTwist& at = pose_.angles()[i];
            const JointLimits& limits = pose_.limits(i);
            const glm::dvec2 swing = at.swing + glm::dvec2(glm::dot(lever.x, pull), glm::dot(lever.z, pull));
            const double twist = at.twist + glm::dot(lever.twist, pull);
            const glm::dvec2 kept = clamp_swing(swing, limits);
            turned_[i] = {kept - at.swing, kept_twist(twist, limits) - at.twist};
            value_ +=
                turned_[i].swing.x * lever.x + turned_[i].swing.y * lever.z + turned_[i].twist * lever.twist;
            const glm::dmat2 slope = slope_of_clamp(swing, kept, limits);
            const glm::dvec3 x = slope[0][0] * lever.x + slope[0][1] * lever.z;
            const glm::dvec3 z = slope[1][0] * lever.x + slope[1][1] * lever.z;
            slope_ += glm::outerProduct(lever.x, x) + glm::outerProduct(lever.z, z);
            if (kept_twist(twist, limits) == twist) slope_ += glm::outerProduct(lever.twist, lever.twist);
        }
        return glm::length(value_);
    }

    bool apply() {
        double largest = 0.0;
        for (std::size_t i = first_; i < pose_.count(); ++i)
            largest = std::max({largest, glm::length(turned_[i].swing), std::abs(turned_[i].twist)});
        if (!(largest > 1e-13) || !std::isfinite(largest)) return false;
        const double share = std::min(1.0, tuning_.most_turned / largest);
        Angles angles;
        std::copy_n(pose_.angles().begin(), first_, angles.begin());
        for (std::size_t i = first_; i < pose_.count(); ++i) {
            const SwingTwist& at = pose_.angles()[i];
            const JointLimits& limits = pose_.limits(i);
            angles[i] = {clamp_swing(at.swing + share * turned_[i].swing, limits),
                         kept_twist(at.twist + share * turned_[i].twist, limits)};
            unwind(angles[i].swing, limits);
        }
        pose_.set(angles);
        return true;
    }

    /// Replaces a swing by the one that gives an equal rotation the other way round, if that is allowed and
    /// shorter.
    static void unwind(glm::dvec2& swing, const JointLimits& limits) {
        const double angle = glm::length(swing);
        if (angle <= pi) return;
        const glm::dvec2 other = swing * ((angle - 2.0 * pi) / angle);
        if (clamp_swing(other, limits) == other) swing = other;
    }

    LimitedPose& pose_;
    const LimitedTuning& tuning_;
    glm::dvec3 error_;
    std::size_t first_;
    double damping_;
    glm::dmat3 idle_{0.0};  // across the only way that counts
    glm::dvec3 value_{0.0};
    glm::dmat3 slope_{1.0};
    PerBone<Lever> levers_;
    PerBone<SwingTwist> turned_;
};

}  // namespace

bool step_towards(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& error) {
    return Step(pose, tuning, error, 0).run();
}

bool step_along(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& along, double error) {
    Step step(pose, tuning, error * along, 1);
    step.keep_along(along);
    return step.run();
}

}  // namespace motus::bones::chains
