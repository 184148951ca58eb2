#include "motus/bones/ik/ik.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <stdexcept>

#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"
#include "solution.hpp"
#include "world.hpp"

namespace motus::bones::ik {
namespace {

bool has_valid_limits(std::span<const chains::JointLimits> limits) {
    return std::all_of(limits.begin(), limits.end(), [](const chains::JointLimits& limit) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(limit.min[axis] <= limit.max[axis])) return false;
            if (limit.min[axis] == chains::JointLimits::free || limit.max[axis] == -chains::JointLimits::free)
                return false;
        }
        return true;
    });
}

/// The chain's task in pose space; nothing if a number is not finite.
std::optional<Task> read_task(const ChainInput& input, const RigWorld& world, std::size_t index,
                              const ChainPlan::Chain& chain) {
    const glm::dmat4& target = input.targets[index];
    const ChainSettings& settings = input.settings[index];
    if (!world.is_valid || !is_finite(target) || !has_finite_numbers(settings)) return {};
    Task task;
    task.settings = within_domains(settings);
    task.target = world.to_pose(glm::dvec3(target[3]));
    if (settings.rotation_weight > 0.0) task.orientation = frame_of(world.inverse * glm::dmat3(target));
    const glm::dvec3& pole = input.poles[index];
    if (!std::isnan(pole.x) && !std::isnan(pole.y) && !std::isnan(pole.z)) {
        if (!is_finite(pole)) return {};
        task.pole = world.to_pose(pole);
    }
    if (settings.use_limits && !input.limits.empty()) {
        task.limits = input.limits.subspan(chain.first_row, chain.bones.size());
        if (!has_valid_limits(task.limits)) return {};
    }
    return task;
}

/// Writes rows that have no effect; rows in pose space are those of the rest pose of a rig at the origin.
void write_neutral(const ChainPlan::Chain& chain, const ChainOutput& output) {
    const auto clear = [&output](std::size_t row) {
        output.rotations[row] = no_turn;
        output.scales[row] = glm::dvec3(1.0);
    };
    const std::size_t end = chain.first_row + chain.bones.size();
    for (std::size_t row = chain.first_row - chain.left_out; row < end; ++row) clear(row);
    if (chain.has_free_effector) clear(chain.effector.row);
    for (const ChainPlan::Hanging& guard : chain.guards) clear(guard.row);
}

bool is_chain_finite(const ChainPlan::Chain& chain, const ChainOutput& output,
                     const ChainDiagnostics& report) {
    const auto is_row_finite = [&output](std::size_t row) {
        return is_finite(output.rotations[row]) && is_finite(output.scales[row]);
    };
    bool all = has_finite_numbers(report) && (!chain.has_free_effector || is_row_finite(chain.effector.row));
    for (std::size_t i = 0; i < chain.bones.size(); ++i) all = all && is_row_finite(chain.first_row + i);
    for (const ChainPlan::Hanging& guard : chain.guards) all = all && is_row_finite(guard.row);
    return all;
}

bool are_guards_finite(const ChainInput& input, const ChainPlan::Chain& chain) {
    return std::all_of(chain.guards.begin(), chain.guards.end(), [&input](const ChainPlan::Hanging& guard) {
        return input.bones.rows()[guard.row].is_finite;
    });
}

void report_solution(ChainDiagnostics& report, const AimReport& aim, const Pose& pose, const Task& task,
                     const RigWorld& world) {
    const glm::dvec3 miss = task.target - pose.tip();
    Reason reason = aim.reason;
    if (glm::length(miss) <= task.settings.tolerance * aim.reach)
        reason = Reason::reached;
    else if (reason == Reason::reached)
        reason = aim.distance > aim.end ? Reason::too_far : Reason::iterations;
    const glm::dvec3 to_target = task.target - pose.root();
    const glm::dvec3 along = direction_or(to_target, direction_or(pose.tip() - pose.root(), {0.0, 1.0, 0.0}));
    report.residual = world.length(miss);
    report.reason = reason;
    report.iterations = aim.iterations;
    report.distance = world.length(to_target);
    report.reach = aim.reach * world.length(along);
    report.tip = world.to_world(pose.tip());
}

void solve_one(const ChainPlan& plan, const ChainInput& input, std::size_t index, const RigWorld& world,
               Solution& solution, const ChainOutput& output) {
    const ChainPlan::Chain chain = plan.chain(index, input.settings[index].left_out);
    ChainDiagnostics& report = output.report[index];
    report = {.reason = std::nullopt};
    if (!are_guards_finite(input, chain) || !solution.read(input, chain)) {
        write_neutral(chain, output);
        return;
    }
    std::optional<Task> task = read_task(input, world, index, chain);
    const bool is_on = task && task->settings.is_on;
    if (is_on) {
        std::optional<AimReport> aim;
        try {
            aim = solution.solve(chain, *task);
        } catch (const std::invalid_argument&) {
            // The numbers are finite, but so large that the positions of the joints are not, which the solver
            // of chains refuses.
            write_neutral(chain, output);
            return;
        }
        report_solution(report, *aim, solution.pose(), *task, world);
    } else {
        if (task) report.reason = Reason::reached;
        task = Task{};
        solution.stay();
    }
    if (!is_on) task->settings.position_weight = 0.0;
    report.angle = solution.write(input.bones.rows(), chain, *task, output);
    if (!is_chain_finite(chain, output, report)) {  // numbers so large that their products are not
        write_neutral(chain, output);
        report = {.reason = std::nullopt};
    }
}

void check_sizes(const ChainPlan& plan, const ChainInput& input, const ChainOutput& output) {
    check_rig(plan, input);
    const std::size_t chains = plan.chain_count();
    require(input.settings.size() == chains, "settings: one entry per chain is needed");
    require(input.targets.size() == chains, "targets: one entry per chain is needed");
    require(input.poles.size() == chains, "poles: one entry per chain is needed");
    require(output.report.size() == chains, "report: one entry per chain is needed");
    require(input.limits.empty() || input.limits.size() == plan.chain_bone_count(),
            "limits: one entry per chain bone is needed");
    require(output.rotations.size() == plan.rows().size(), "rotations: one entry per row is needed");
    require(output.scales.size() == plan.rows().size(), "scales: one entry per row is needed");
}

}  // namespace

void solve(const ChainPlan& plan, const ChainInput& input, const ChainOutput& output) {
    check_sizes(plan, input, output);
    const RigWorld world(input.world);
    Solution solution(plan.longest_chain());
    for (std::size_t i = 0; i < plan.chain_count(); ++i) solve_one(plan, input, i, world, solution, output);
}

}  // namespace motus::bones::ik
