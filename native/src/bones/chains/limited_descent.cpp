#include "limited_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace motus::bones::chains {
namespace {

using std::numbers::pi;

/// The error or the velocity of the last joint: position, and orientation times its weight.
struct Error {
    glm::dvec3 position;
    glm::dvec3 orientation;
};

double dot(const Error& a, const Error& b) {
    return glm::dot(a.position, b.position) + glm::dot(a.orientation, b.orientation);
}

/// One degree of freedom of a joint.
struct Freedom {
    std::size_t bone;
    glm::dvec2 swing;  // by one radian of it
    double twist;
    Error move;        // of the chain's end
    glm::dvec3 rate;   // angular velocity
    double curvature;  // second derivative of the cost by it that is not in `move`, if the cost curves up
};

class Descent {
  public:
    Descent(LimitedPose& pose, const Goal& goal, const LimitedTuning& tuning)
        : pose_(pose), goal_(goal), tuning_(tuning), error_(error_of(pose)), damping_(tuning.first_damping) {}

    int run(int max_iterations, bool& is_at_rest) {
        double cost = dot(error_, error_);
        if (!std::isfinite(cost)) return 0;  // nothing compares with it
        int stalls = 0;
        int iteration = 0;
        is_at_rest = is_done();
        while (!is_at_rest && iteration < max_iterations) {
            find_freedoms();
            std::copy_n(pose_.angles().begin(), pose_.count(), before_.begin());
            double now = cost;
            for (; now >= cost && iteration < max_iterations && damping_ < tuning_.most_damping;
                 ++iteration) {
                if (!(is_slow_ && count_ <= most_exact ? step_exactly() : step())) {
                    damping_ *= tuning_.damping_rise;
                    continue;
                }
                const Error error = error_of(pose_);
                now = dot(error, error);
                if (now < cost) {
                    error_ = error;
                    damping_ = std::max(tuning_.damping_fall * damping_, tuning_.least_damping);
                } else {
                    pose_.set(before_);
                    damping_ *= tuning_.damping_rise;
                }
            }
            is_slow_ = now > tuning_.slow * cost;
            if (goal_.rival >= 0.0 && now > tuning_.hopeless * cost &&
                now > tuning_.far_above * goal_.rival * goal_.rival)
                break;
            stalls = now > (1.0 - 1e-7) * cost ? stalls + 1 : 0;
            cost = std::min(cost, now);
            is_at_rest = is_done() || count_ == 0 || stalls >= 2 || damping_ >= tuning_.most_damping;
        }
        return iteration;
    }

  private:
    [[nodiscard]] bool is_done() const {
        return glm::length(error_.position) <= goal_.tolerance &&
               glm::length(error_.orientation) <= 1e-6 * goal_.orientation_weight;
    }

    [[nodiscard]] Error error_of(const LimitedPose& pose) const {
        Error error{goal_.target - pose.tip(), glm::dvec3(0.0)};
        if (goal_.orientation_weight > 0.0)
            error.orientation = goal_.orientation_weight * orientation_error(pose, *goal_.orientation);
        return error;
    }

    void add(std::size_t bone, const glm::dvec2& swing, double twist, const glm::dvec3& rate,
             double curvature) {
        const Error move{glm::cross(rate, pose_.tip() - pose_.joint(bone)), goal_.orientation_weight * rate};
        freedoms_[count_++] = {bone, swing, twist, move, rate, curvature};
        scale_ = std::max(scale_, dot(move, move));
    }

    void find_freedoms() {
        count_ = 0;
        scale_ = 1e-300;
        for (std::size_t i = 0; i < pose_.count(); ++i) {
            const JointLimits& limits = pose_.limits(i);
            const SwingTwist& at = pose_.angles()[i];
            const glm::dquat& socket = pose_.socket(i);
            const SwingRates rates = swing_rates(at.swing);
            // The torque of the error on the joint, in the space of the joint's socket.
            const glm::dvec3 moment =
                glm::conjugate(socket) * (glm::cross(pose_.tip() - pose_.joint(i), error_.position) +
                                          goal_.orientation_weight * error_.orientation);
            const Ways ways =
                swing_ways(at.swing, limits, {glm::dot(rates.x, moment), glm::dot(rates.z, moment)});
            for (std::size_t k = 0; k < ways.count; ++k) {
                const glm::dvec2 w = ways.directions[k];
                const double bend = w.x * w.x * glm::dot(rates.x_by_x, moment) +
                                    2.0 * w.x * w.y * glm::dot(rates.x_by_z, moment) +
                                    w.y * w.y * glm::dot(rates.z_by_z, moment);
                add(i, w, 0.0, socket * (w.x * rates.x + w.y * rates.z), ways.curvature - bend);
            }
            if (ways.count == 2) crossed_[i] = -glm::dot(rates.x_by_z, moment);
            const glm::dvec3 twist = pose_.twist_axis(i);
            if (may_twist(at.twist, limits, glm::dot(twist, socket * moment)))
                add(i, {0.0, 0.0}, 1.0, twist, 0.0);
        }
    }

    /// One step of damped least squares (Gauss-Newton), solved in the space of the error. False if nothing
    /// moves.
    bool step() {
        glm::dmat3 pp(0.0), po(0.0), oo(0.0);
        const bool is_oriented = goal_.orientation_weight > 0.0;
        for (std::size_t k = 0; k < count_; ++k) {
            const Error& move = freedoms_[k].move;
            pp += glm::outerProduct(move.position, move.position);
            if (!is_oriented) continue;
            po += glm::outerProduct(move.orientation, move.position);
            oo += glm::outerProduct(move.orientation, move.orientation);
        }
        for (int k = 0; k < 3; ++k) {
            pp[k][k] += damping_ * scale_;
            oo[k][k] += damping_ * scale_;
        }
        const glm::dmat3 inverse = glm::inverse(pp);
        Error pull{inverse * error_.position, glm::dvec3(0.0)};
        if (is_oriented) {
            // po couples orientation and position; the equations are eliminated by blocks.
            const glm::dmat3 rest = oo - po * inverse * glm::transpose(po);
            pull.orientation = glm::inverse(rest) * (error_.orientation - po * pull.position);
            pull.position = inverse * (error_.position - glm::transpose(po) * pull.orientation);
        }
        for (std::size_t k = 0; k < count_; ++k) turn_[k] = dot(freedoms_[k].move, pull);
        return apply();
    }

    /// A step of Newton's method with all second derivatives of
    /// the position, which a target out of reach needs. False if the cost is not convex enough for it.
    bool step_exactly() {
        const bool is_oriented = goal_.orientation_weight > 0.0;
        for (std::size_t k = 0; k < count_; ++k) {
            const Freedom& outer = freedoms_[k];
            const glm::dvec3 turned = glm::cross(error_.position, outer.rate);
            const glm::dvec3 outer_move = outer.move.position - turned;
            for (std::size_t l = k; l < count_; ++l)
                matrix_[k][l] = glm::dot(outer_move, freedoms_[l].move.position);
            for (std::size_t l = k; l < count_ && is_oriented; ++l)
                matrix_[k][l] += glm::dot(outer.move.orientation, freedoms_[l].move.orientation);
            matrix_[k][k] += outer.curvature + damping_ * scale_;
            if (k + 1 < count_ && freedoms_[k + 1].bone == outer.bone && freedoms_[k + 1].twist == 0.0) {
                const Freedom& other =
                    freedoms_[k + 1];  // both angles of one swing: neither is the outer one
                matrix_[k][k + 1] +=
                    crossed_[outer.bone] +
                    0.5 * (glm::dot(turned, other.move.position) -
                           glm::dot(glm::cross(error_.position, other.rate), outer.move.position));
            }
            turn_[k] = dot(outer.move, error_);
        }
        return solve() && apply();
    }

    /// turn_ = matrix_^-1 turn_ by elimination of the symmetric matrix of which the upper triangle is given.
    /// False if it is not positive definite.
    bool solve() {
        for (std::size_t j = 0; j < count_; ++j) {
            const std::array<double, most_exact>& row = matrix_[j];
            if (!(row[j] > 1e-14 * scale_)) return false;
            const double inverse = 1.0 / row[j];
            for (std::size_t i = j + 1; i < count_; ++i) {
                const double share = row[i] * inverse;
                std::array<double, most_exact>& below = matrix_[i];
                for (std::size_t k = i; k < count_; ++k) below[k] -= share * row[k];
                turn_[i] -= share * turn_[j];
            }
        }
        for (std::size_t j = count_; j-- > 0;) {
            for (std::size_t k = j + 1; k < count_; ++k) turn_[j] -= matrix_[j][k] * turn_[k];
            turn_[j] /= matrix_[j][j];
        }
        return true;
    }

    /// Turns the joints by turn_, as far as their limits allow.
    bool apply() {
        std::copy_n(pose_.angles().begin(), pose_.count(), tried_.begin());
        for (std::size_t k = 0; k < count_; ++k) {
            const Freedom& freedom = freedoms_[k];
            if (!std::isfinite(turn_[k])) return false;
            const double turn = std::clamp(turn_[k], -tuning_.largest_turn, tuning_.largest_turn);
            tried_[freedom.bone].swing += turn * freedom.swing;
            tried_[freedom.bone].twist += turn * freedom.twist;
        }
        for (std::size_t i = 0; i < pose_.count(); ++i) {
            const JointLimits& limits = pose_.limits(i);
            tried_[i].swing = clamp_swing(tried_[i].swing, limits);
            const double angle = glm::length(tried_[i].swing);
            if (angle > pi) {  // the same rotation the other way round, if that is allowed
                const glm::dvec2 other = tried_[i].swing * ((angle - 2.0 * pi) / angle);
                if (clamp_swing(other, limits) == other) tried_[i].swing = other;
            }
            tried_[i].twist = clamp_twist(tried_[i].twist, limits);
        }
        pose_.set(tried_);
        return true;
    }

    static constexpr std::size_t most_exact = 48;  // freedoms, for steps by all second derivatives

    LimitedPose& pose_;
    const Goal& goal_;
    const LimitedTuning& tuning_;
    Error error_;
    double damping_;
    double scale_ = 1.0;
    bool is_slow_ = false;
    std::size_t count_ = 0;
    Angles before_;
    Angles tried_;
    Unfilled<Freedom, 3 * most_bones> freedoms_;
    Unfilled<double, 3 * most_bones> turn_;
    PerBone<double> crossed_;  // second derivative by both angles of a swing
    Unfilled<std::array<double, most_exact>, most_exact> matrix_;
};

}  // namespace

void LimitedPose::set_bone(std::size_t i, const SwingTwist& angles) {
    angles_[i] = angles;
    sockets_[i] = (i == 0 ? chain_.base : frames_[i - 1]) * chain_.rest[i];
    frames_[i] = sockets_[i] * rotation_of(angles);
    joints_[i + 1] = joints_[i] + frames_[i] * offsets_[i];
}

void LimitedPose::set(const Angles& angles) {
    for (std::size_t i = 0; i < count(); ++i) set_bone(i, angles[i]);
}

glm::dvec3 orientation_error(const LimitedPose& pose, const glm::dquat& wanted) {
    glm::dquat turn = wanted * glm::conjugate(pose.last_frame());
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 v(turn.x, turn.y, turn.z);
    const double sine = glm::length(v);
    return sine > 1e-150 ? v * (2.0 * std::atan2(sine, turn.w) / sine) : 2.0 * v;
}

int descend(LimitedPose& pose, const Goal& goal, const LimitedTuning& tuning, int max_iterations,
            bool& is_at_rest) {
    return Descent(pose, goal, tuning).run(max_iterations, is_at_rest);
}

}  // namespace motus::bones::chains
