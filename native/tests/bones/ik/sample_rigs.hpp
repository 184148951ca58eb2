// Rigs for the tests of solvers of bones, and Blender's computation of a pose from relative results.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "motus/bones/bone.hpp"
#include "motus/bones/ik/ik.hpp"
#include "motus/bones/rig.hpp"
#include "motus/bones/turns.hpp"
#include "pose.hpp"
#include "random.hpp"

namespace motus::bones::ik::checks {

class RandomRig : public test::Random {
  public:
    using Random::Random;
    glm::dvec3 vector() { return around_origin(); }
    glm::dquat rotation() {
        const double angle = between(0.0, 3.1);
        return turn(angle);
    }
    glm::dvec3 scale() { return {between(0.6, 1.6), between(0.6, 1.6), between(0.6, 1.6)}; }
    /// At any place, turned in any way.
    glm::dmat4 place(const glm::dvec3& scale = glm::dvec3(1.0));
};

/// location * rotation * scale.
inline glm::dmat4 transform(const glm::dvec3& location, const glm::dquat& rotation,
                            const glm::dvec3& scale = glm::dvec3(1.0)) {
    return glm::translate(glm::dmat4(1.0), location) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1.0), scale);
}

inline glm::dmat4 RandomRig::place(const glm::dvec3& scale) {
    const glm::dvec3 location = vector();
    return transform(location, rotation(), scale);
}

/// A rig's arrays, as Blender would fill them.
struct Rig {
    std::vector<int> parents;
    std::vector<float> rest, poses, basis, lengths;
    std::vector<int> inheritance;

    [[nodiscard]] RigView view() const { return {{parents, rest, poses, basis, lengths, inheritance}}; }
    [[nodiscard]] int size() const { return static_cast<int>(parents.size()); }

    static void store(std::vector<float>& values, const glm::dmat4& matrix) {
        for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(matrix[i / 4][i % 4]));
    }

    /// A bone in its animated pose; its parent has been added before. `rest`: seen from the parent's tail.
    int add(int parent, const glm::dmat4& place, double length, const glm::dmat4& own = glm::dmat4(1.0),
            InheritScale scale = InheritScale::full, int flags = inherits_rotation | has_local_location) {
        const auto index = static_cast<std::size_t>(parent);
        const glm::dmat4 before =
            parent < 0 ? glm::dmat4(1.0)
                       : matrix_at(rest, index) *
                             glm::translate(glm::dmat4(1.0),
                                            glm::dvec3(0.0, static_cast<double>(lengths[index]), 0.0));
        parents.push_back(parent);
        store(rest, before * place);
        store(basis, own);
        lengths.push_back(static_cast<float>(length));
        inheritance.push_back(static_cast<int>(scale) | flags);
        const std::size_t bone = parents.size() - 1;
        const glm::dmat4 parent_pose = parent < 0 ? glm::dmat4(1.0) : matrix_at(poses, index);
        const RigView at_rest({parents, rest, {}, {}, {}, inheritance});
        store(poses, to_pose(parent_space(rest_of(at_rest, bone), parent_pose), matrix_at(basis, bone)));
        return static_cast<int>(bone);
    }
};

/// Input and output of one solve.
struct Solve {
    Rig rig;
    std::vector<ChainBones> chains;
    std::vector<Guard> guards;
    glm::dmat4 world{1.0};
    std::vector<ChainSettings> settings;
    std::vector<glm::dmat4> targets;
    std::vector<glm::dvec3> poles;
    std::vector<chains::JointLimits> limits;
    // results
    std::vector<int> rows;
    std::vector<glm::dquat> rotations;
    std::vector<glm::dvec3> scales;
    std::vector<ChainDiagnostics> report;

    void add_chain(ChainBones chain, const glm::dvec3& target, const ChainSettings& chain_settings = {}) {
        chains.push_back(std::move(chain));
        settings.push_back(chain_settings);
        targets.push_back(glm::translate(glm::dmat4(1.0), target));
        poles.emplace_back(std::numeric_limits<double>::quiet_NaN());
    }
    [[nodiscard]] ChainInput input(const ChainPlan& plan) const {
        return {AnimatedBones(plan, RestBones(plan, rig.view()), rig.basis),
                rig.poses,
                world,
                settings,
                targets,
                poles,
                limits};
    }
    void run() {
        const ChainPlan plan(rig.parents, chains, guards);
        rows.assign(plan.rows().begin(), plan.rows().end());
        rotations.assign(rows.size(), glm::dquat(0.0, 0.0, 0.0, 0.0));
        scales.assign(rows.size(), glm::dvec3(0.0));
        report.assign(chains.size(), ChainDiagnostics{});
        solve(plan, input(plan), {rotations, scales, report});
    }
    [[nodiscard]] std::size_t row_of(int bone) const {
        return static_cast<std::size_t>(std::find(rows.begin(), rows.end(), bone) - rows.begin());
    }

    /// Pose of a bone with its own transform as animated.
    [[nodiscard]] glm::dmat4 posed(int bone, const glm::dmat4& parent_pose, const glm::dquat& rotation,
                                   const glm::dvec3& scale) const {
        const auto index = static_cast<std::size_t>(bone);
        const OwnTransform own = own_transform(rig.basis, index);
        const glm::dmat4 basis = transform(own.location, own.rotation * rotation, own.scale * scale);
        return to_pose(parent_space(rest_of(rig.view(), index), parent_pose), basis);
    }
    /// Poses of a chain's bones, with the results on them or, `is_fk`, without.
    [[nodiscard]] std::vector<glm::dmat4> chain_poses(std::size_t chain, bool is_fk = false) const {
        std::size_t row = 0;
        for (std::size_t i = 0; i < chain; ++i) row += chains[i].bones.size();
        const int parent = rig.parents[static_cast<std::size_t>(chains[chain].bones.front())];
        glm::dmat4 pose =
            parent < 0 ? glm::dmat4(1.0) : matrix_at(rig.poses, static_cast<std::size_t>(parent));
        std::vector<glm::dmat4> poses;
        for (const int bone : chains[chain].bones) {
            pose = is_fk ? posed(bone, pose, glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dvec3(1.0))
                         : posed(bone, pose, rotations[row], scales[row]);
            ++row;
            poses.push_back(pose);
        }
        return poses;
    }
    /// The effector's pose if it is relative.
    [[nodiscard]] glm::dmat4 effector_pose(std::size_t chain, bool is_fk = false) const {
        const std::vector<glm::dmat4> poses = chain_poses(chain, is_fk);
        const int effector = chains[chain].effector;
        if (effector == chains[chain].bones.back()) return poses.back();
        if (is_fk) return posed(effector, poses.back(), glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dvec3(1.0));
        return posed(effector, poses.back(), rotations[row_of(effector)], scales[row_of(effector)]);
    }
    /// The chain's tip, in the world.
    [[nodiscard]] glm::dvec3 tip(std::size_t chain, bool is_fk = false) const {
        glm::dvec4 place;
        if (chains[chain].effector == chains[chain].bones.back()) {
            const double length =
                static_cast<double>(rig.lengths[static_cast<std::size_t>(chains[chain].bones.back())]);
            place = chain_poses(chain, is_fk).back() * glm::dvec4(0.0, length, 0.0, 1.0);
        } else {
            place = effector_pose(chain, is_fk)[3];
        }
        return glm::dvec3(world * place);
    }
    [[nodiscard]] double miss(std::size_t chain) const {
        return glm::distance(tip(chain), glm::dvec3(targets[chain][3]));
    }
};

inline constexpr std::array modes{InheritScale::full,    InheritScale::fix_shear, InheritScale::aligned,
                                  InheritScale::average, InheritScale::none,      InheritScale::none_legacy};
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A chain of `count` bones that hangs on a shoulder, animated by random turns of up to `bend` rad; each
/// bone's next one is connected. With a hand at its end if it is not the tail that goes to the target.
struct Limb {
    std::vector<int> bones;
    int hand = -1;
};
inline Limb add_limb(Rig& rig, RandomRig& random, int count, double bend, const glm::dmat4& shoulder_own,
                     InheritScale mode = InheritScale::full,
                     int flags = inherits_rotation | has_local_location) {
    Limb limb;
    const int shoulder = rig.add(-1, random.place(), 0.5, shoulder_own);
    int parent = shoulder;
    for (int i = 0; i < count; ++i) {
        const glm::dmat4 own = transform(glm::dvec3(0.0), random.turn(bend));
        const glm::dmat4 rest = transform(glm::dvec3(0.0), random.turn(0.3));
        parent = rig.add(parent, rest, random.between(0.5, 1.5), own, mode, flags);
        limb.bones.push_back(parent);
    }
    const glm::dmat4 rest = transform(glm::dvec3(0.02, 0.0, 0.01), random.turn(0.2));
    limb.hand = rig.add(parent, rest, 0.4, transform(glm::dvec3(0.0), random.turn(bend)), mode, flags);
    return limb;
}

inline double length_of(const Solve& solve, std::size_t chain) {
    double sum = 0.0;
    for (const int bone : solve.chains[chain].bones)
        sum += static_cast<double>(solve.rig.lengths[static_cast<std::size_t>(bone)]);
    return sum;
}

inline glm::dvec3 root_of(const Solve& solve, std::size_t chain) {
    return glm::dvec3(solve.world * solve.chain_poses(chain, true).front()[3]);
}

inline glm::dquat orientation(const glm::dmat4& matrix) {
    return frame_of(glm::dmat3(matrix));
}

inline double angle_between(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

inline ChainSettings exact() {
    ChainSettings settings;
    settings.tolerance = 1e-12;
    return settings;
}

/// A limb and a chain on it with the target at `share` of its length from its root, in a random direction.
inline Solve sample(unsigned seed, int count, bool use_tail, double share, double bend = 1.0) {
    RandomRig random(seed);
    Solve solve;
    const double size = random.between(0.5, 2.0);
    const glm::dmat4 shoulder = random.place(glm::dvec3(size));
    const Limb limb = add_limb(solve.rig, random, count, bend, shoulder);
    const double world_size = random.between(0.5, 2.0);
    solve.world = random.place(glm::dvec3(world_size));
    solve.add_chain({limb.bones, use_tail ? limb.bones.back() : limb.hand}, glm::dvec3(0.0), exact());
    const double reach = share * length_of(solve, 0) * size * glm::length(glm::dvec3(solve.world[0]));
    const glm::dvec3 target = root_of(solve, 0) + reach * random.direction();
    solve.targets[0] = transform(target, random.rotation());
    return solve;
}

/// Every bone's pose, as the results of a solve with guards have it: absolute rows replace rotation and
/// scale.
inline glm::dmat4 hanging_pose(const Solve& solve, int bone, const glm::dmat4& parent_pose) {
    const glm::dmat4 own = solve.posed(bone, parent_pose, no_turn, glm::dvec3(1.0));
    const std::size_t row = solve.row_of(bone);
    return transform(glm::dvec3(own[3]), solve.rotations[row], solve.scales[row]);
}

inline double difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0.0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a[i / 3][i % 3] - b[i / 3][i % 3]));
    return largest;
}

}  // namespace motus::bones::ik::checks
