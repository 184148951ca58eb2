// Chains with limits: what each number of LimitedTuning is worth. Each is made smaller and larger, and the
// same random tasks are solved: how many that can be reached are missed, how often a chain jumps while its
// target moves evenly, and how much work it is. docs/limited_chains.md has the table.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "motus/bones/chains/limited.hpp"
#include "motus/bones/chains/limited_tuning.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;

namespace {

using Rotations = std::vector<glm::dquat>;

/// A chain with random limits, a pose within them, and another pose, whose tip and last frame can be reached.
struct Task {
    Rotations rest, pose, other;
    std::vector<glm::dvec3> offsets;
    std::vector<JointLimits> limits;

    [[nodiscard]] Limited chain() const {
        Limited result;
        result.rest = rest;
        result.offsets = offsets;
        result.limits = limits;
        return result;
    }
    [[nodiscard]] glm::dvec3 tip(const Rotations& rotations) const {
        std::vector<glm::dvec3> joints(offsets.size() + 1);
        joints_of(chain(), rotations, joints);
        return joints.back();
    }
    [[nodiscard]] glm::dquat last_frame(const Rotations& rotations) const {
        glm::dquat frame(1.0, 0.0, 0.0, 0.0);
        for (std::size_t i = 0; i < rest.size(); ++i) frame = frame * rest[i] * rotations[i];
        return glm::normalize(frame);
    }
};

glm::dquat turn(test::Random& random, double most) {
    const glm::dvec3 axis = random.direction();
    return glm::angleAxis(random.between(0.0, most), axis);
}

/// A hinge to one side; narrow on all sides; wide; or wide to one side of each axis.
JointLimits limits_of_kind(test::Random& random, std::size_t kind) {
    JointLimits limits;
    limits.min = limits.max = glm::dvec3(0.0);
    if (kind == 0) {
        const int axis = random.chance(0.5) ? 0 : 2;
        (random.chance(0.5) ? limits.min[axis] = -2.4 : limits.max[axis] = 2.4);
        return limits;
    }
    const double widest = kind == 1 ? 0.3 : 1.5;
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_one_sided = kind == 3 && random.chance(0.5);
        limits.min[axis] = is_one_sided ? 0.0 : -random.between(0.05, widest);
        limits.max[axis] = random.between(0.05, widest);
    }
    return limits;
}

/// Every other pose is as straight as the limits and the rest allow.
Task make_task(test::Random& random, std::size_t fewest, std::size_t most) {
    Task task;
    const std::size_t bones = fewest + random.below(most - fewest + 1);
    const bool is_straight = random.chance(0.5);
    for (std::size_t i = 0; i < bones; ++i) {
        task.offsets.emplace_back(0.0, random.between(0.3, 1.0), 0.0);
        task.rest.push_back(is_straight ? glm::dquat(1.0, 0.0, 0.0, 0.0) : turn(random, 0.4));
        task.limits.push_back(limits_of_kind(random, random.below(4)));
        const glm::dquat pose = turn(random, 1.0), other = turn(random, 2.5);
        task.pose.push_back(is_straight ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                        : clamp_rotation(pose, task.limits[i]));
        task.other.push_back(clamp_rotation(other, task.limits[i]));
    }
    return task;
}

struct Tasks {
    std::vector<Task> short_ones, long_ones, with_orientation, beyond, swept;
};

Tasks make_tasks() {
    test::Random random(17);
    Tasks tasks;
    for (int i = 0; i < 1000; ++i) tasks.short_ones.push_back(make_task(random, 2, 5));
    for (int i = 0; i < 400; ++i) tasks.long_ones.push_back(make_task(random, 6, 16));
    for (int i = 0; i < 600; ++i) tasks.with_orientation.push_back(make_task(random, 3, 6));
    for (int i = 0; i < 400; ++i) tasks.beyond.push_back(make_task(random, 2, 6));
    for (int i = 0; i < 60; ++i) tasks.swept.push_back(make_task(random, 2, 4));
    return tasks;
}

struct Found {
    double missed = 0.0, iterations = 0.0, jumps = 0.0, beyond = 0.0;
};

void solve_all(const std::vector<Task>& tasks, bool oriented, const LimitedTuning& tuning, Found& found) {
    for (const Task& task : tasks) {
        Rotations rotations = task.pose;
        std::optional<glm::dquat> orientation;
        if (oriented) orientation = task.last_frame(task.other);
        const Convergence report =
            solve_limited(task.chain(), task.tip(task.other), {}, rotations, orientation, tuning);
        found.iterations += report.iterations;
        if (report.reason != Reason::reached) ++found.missed;
    }
}

/// Sum of the distances, in lengths of the chains, that are left to targets beyond what is reached at ease.
void reach_beyond(const std::vector<Task>& tasks, const LimitedTuning& tuning, Found& found) {
    for (const Task& task : tasks) {
        Rotations rotations = task.pose;
        double length = 0.0;
        for (const glm::dvec3& offset : task.offsets) length += offset.y;
        const glm::dvec3 target = 1.3 * task.tip(task.other);
        const Convergence report = solve_limited(task.chain(), target, {}, rotations, std::nullopt, tuning);
        found.iterations += report.iterations;
        found.beyond += report.residual / length;
    }
}

/// Steps of a target from the tip of one pose to that of the other, straight and even, at which any bone
/// turns by more than 0.3 rad. Always from the same pose, as in an animation.
void sweep_all(const std::vector<Task>& tasks, const LimitedTuning& tuning, Found& found) {
    constexpr int steps = 60;
    for (const Task& task : tasks) {
        const glm::dvec3 from = task.tip(task.pose), to = task.tip(task.other);
        Rotations before;
        for (int step = 0; step <= steps; ++step) {
            Rotations rotations = task.pose;
            const glm::dvec3 target = glm::mix(from, to, static_cast<double>(step) / steps);
            (void)solve_limited(task.chain(), target, {}, rotations, std::nullopt, tuning);
            bool jumps = false;
            for (std::size_t i = 0; i < before.size(); ++i)
                jumps |= std::abs(glm::dot(before[i], rotations[i])) < std::cos(0.15);
            found.jumps += jumps ? 1.0 : 0.0;
            before = rotations;
        }
    }
}

struct Variation {
    std::string name;
    std::function<void(LimitedTuning&)> change;
};

std::vector<Variation> variations() {
    std::vector<Variation> all{{"as it is", [](LimitedTuning&) {}}};
    const auto number = [&all](const std::string& name, auto member, std::initializer_list<double> values) {
        for (const double value : values) {
            std::array<char, 32> text{};
            std::snprintf(text.data(), text.size(), "%g", value);
            all.push_back({name + " " + text.data(), [member, value](LimitedTuning& tuning) {
                               auto& changed = tuning.*member;
                               changed = static_cast<std::remove_reference_t<decltype(changed)>>(value);
                           }});
        }
    };
    using T = LimitedTuning;
    number("spread_starts", &T::spread_starts, {1, 24});
    number("patience_on_target", &T::patience_on_target, {1, 12});
    number("widest_start", &T::widest_start, {1.0, 3.1});
    number("led_near", &T::led_near, {1e-5, 1e-1});
    for (const double share : {0.05, 1.0})
        all.push_back({"orientation_shares " + std::to_string(share).substr(0, 4), [share](T& tuning) {
                           tuning.orientation_shares = {share, 0.1 * share};
                       }});
    number("turn_steps", &T::turn_steps, {2, 32});
    number("other_side_room", &T::other_side_room, {0.0, 0.9});
    number("shown_bend", &T::shown_bend, {0.1, 1.5});
    number("most_first_bend", &T::most_first_bend, {0.2, 3.0});
    number("most_stretches", &T::most_stretches, {10, 160});
    number("least_room", &T::least_room, {0.0, 0.3});
    number("paying", &T::paying, {0.8, 0.9999});
    number("idle_steps", &T::idle_steps, {1, 20});
    number("most_turned", &T::most_turned, {0.1, 3.0});
    number("step_damping", &T::step_damping, {0.01, 1.0});
    number("most_dual_rounds", &T::most_dual_rounds, {4, 80});
    number("first_damping", &T::first_damping, {1e-6, 1.0});
    number("least_damping", &T::least_damping, {1e-16, 1e-6});
    number("most_damping", &T::most_damping, {1e4, 1e12});
    number("damping_fall", &T::damping_fall, {0.01, 0.5});
    number("damping_rise", &T::damping_rise, {2.0, 100.0});
    number("slow", &T::slow, {0.01, 0.9});
    number("hopeless", &T::hopeless, {0.7, 1.0});
    number("far_above", &T::far_above, {1.0, 10.0});
    number("largest_turn", &T::largest_turn, {0.2, 3.0});
    return all;
}

}  // namespace

int main() {
    const Tasks tasks = make_tasks();
    const bench::Table table("Chains with limits: other numbers of LimitedTuning", {{"missed", "", 0},
                                                                                    {"left beyond", "", 3},
                                                                                    {"jumps", "", 0},
                                                                                    {"iterations", "", 1},
                                                                                    {"a solve", "us", 0}});
    for (const Variation& variation : variations()) {
        LimitedTuning tuning;
        variation.change(tuning);
        Found found;
        const double start = bench::thread_time();
        solve_all(tasks.short_ones, false, tuning, found);
        solve_all(tasks.long_ones, false, tuning, found);
        solve_all(tasks.with_orientation, true, tuning, found);
        reach_beyond(tasks.beyond, tuning, found);
        const double spent = bench::thread_time() - start;
        sweep_all(tasks.swept, tuning, found);
        constexpr double solved = 2400.0;
        table.row(variation.name, {found.missed, found.beyond / static_cast<double>(tasks.beyond.size()),
                                   found.jumps, found.iterations / solved, 1e-3 * spent / solved});
    }
}
