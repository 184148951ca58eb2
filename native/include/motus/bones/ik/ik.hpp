// Inverse kinematics of many chains of one rig, beside their animated (FK) pose.
//
// A chain starts from its FK pose: the evaluated pose of the first bone's parent and the bones' own
// transforms. Its bones are turned so that the tip comes to the target; results are relative to the bones'
// own rotations, so that the identity means the FK pose. Bones point along their +Y. Pose
// space is the armature's.
//
// Costs: as the solvers of chains, for each chain. Making a plan or bones allocates them; solve() and
// match() allocate some memory for their work, once a call. All objects are immutable: any number of
// threads may share them.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "motus/bones/chains/limited.hpp"
#include "motus/bones/reason.hpp"
#include "motus/bones/rig.hpp"
#include "motus/config.hpp"
#include "motus/core/leaves_zero.hpp"

namespace motus::bones::ik {

/// Bones from root to tip, and the effector. If the effector is the last of these bones, the chain's tip is
/// its tail, and it is turned to the target's orientation as far as the tip's place allows. If it is a child
/// of the last one, the tip is the effector's head, and the effector turns freely.
struct ChainBones {
    std::vector<int> bones;
    int effector = -1;
};

/// A bone outside a chain whose parent is one of the chain's bones, and that shall not be stretched with it.
struct Guard {
    int bone = -1;
    int chain = -1;
};

/// The settings of one chain. Numbers beyond what is said of them count as the nearest within.
struct ChainSettings {
    double position_weight = 1.0;  ///< 0 to 1, between the FK rotations and the solution
    double rotation_weight = 0.0;  ///< 0 to 1, between the effector's orientation and the target's
    double softness = 0.0;         ///< see soft_reach(); fraction of the chain's length
    double stretch = 0.0;          ///< 0 to 1, share of the missing length that the bones stretch by
    double volume = 0.0;       ///< 0 to 1, share of its volume that a bone stretched by s keeps: across it is
                               ///< scaled by s^(-volume / 2), 1 / sqrt(s) if it keeps it whole
    double pole_angle = 0.0;   ///< rad, about the line from root to target
    int bend = 1;              ///< 1: towards the pole; -1: away from it
    double hinge_angle = 0.0;  ///< rad; the axis that a straight chain bends about is the first bone's X,
                               ///< turned by this about its Y. Two bones whose FK pose bends by less than 8
                               ///< degrees about another axis keep that axis while they are as straight, even
                               ///< with a pole, so that match() is exact. From three times that bend on they
                               ///< are on the pole's side
    double tolerance = 1e-6;   ///< residual that counts as reached, as a fraction of the chain's length
    int max_iterations = 100;  ///< as in SolverSettings
    bool use_limits = false;   ///< joints keep within their limits
    bool is_on = true;         ///< else the chain stands in its FK pose
    std::size_t left_out = 0;  ///< how many of the chain's first bones stay in their FK pose; at least one
                               ///< is solved
};

/// How well a chain was solved. Residual, reason, distance, reach and tip are those of the solution with
/// position_weight 1.
struct ChainDiagnostics {
    double residual = 0.0;  ///< |tip - target|, world
    double angle =
        0.0;  ///< rad, between the effector as it is turned and the target; 0 without rotation_weight
    std::optional<Reason> reason = Reason::reached;  ///< none: a number was not finite, or the rig has no
                                                     ///< extent
    int iterations = 0;
    double distance = 0.0;  ///< root to target, world
    double reach = 0.0;     ///< of the straight chain, unstretched, in the target's direction, world
    glm::dvec3 tip{0.0};    ///< world
};

/// Which bones of a rig are chains, and where the results of each bone go. Immutable. A copy is the same
/// plan; one that is constructed anew is a different plan, even if its bones are the same. What is moved from
/// has no bones.
class ChainPlan {
  public:
    /// std::invalid_argument, with the argument's name, for bones that do not exist or are not parent and
    /// child.
    ChainPlan(std::vector<int> parents, std::vector<ChainBones> chains, const std::vector<Guard>& guards);

    /// Bone of each result row: the chains' bones, chain by chain; effectors that are no chain bones; guards.
    [[nodiscard]] std::span<const int> rows() const noexcept { return rows_; }
    /// Whether a row is the bone's rotation and scale in pose space, rather than relative to the bone's own
    /// transform. True of guards, and of effectors outside the chain if their chain has a guard. (The
    /// effector itself may be listed as a guard; it still has one row.)
    [[nodiscard]] std::span<const unsigned char> is_absolute() const noexcept { return is_absolute_; }
    [[nodiscard]] std::span<const int> parents() const noexcept { return parents_; }
    [[nodiscard]] std::size_t chain_count() const noexcept { return chains_.size(); }
    /// Bones of all chains together: the first rows.
    [[nodiscard]] std::size_t chain_bone_count() const noexcept { return chain_bone_count_; }
    [[nodiscard]] std::size_t longest_chain() const noexcept { return longest_chain_; }
    /// A token that the plan and its copies share, and no different plan has.
    [[nodiscard]] const std::shared_ptr<const void>& identity() const noexcept { return identity_; }

    /// A bone that hangs on a chain, and where its result goes.
    struct Hanging {
        std::size_t bone = 0;
        std::size_t on = 0;  ///< index of its parent in the chain, left out bones included
        std::size_t row = 0;
    };
    struct Chain {
        std::span<const int> bones;
        int parent = -1;           ///< of the first bone of all, -1 for none
        std::size_t left_out = 0;  ///< bones before these that stay in their FK pose
        std::size_t first_row = 0;
        bool has_free_effector = false;  ///< the effector is outside the chain
        bool is_effector_absolute = false;
        Hanging effector;                 ///< read only if it is free
        std::span<const Hanging> guards;  ///< without the effector
    };
    /// left_out: as in ChainSettings.
    [[nodiscard]] Chain chain(std::size_t index, std::size_t left_out = 0) const;

  private:
    struct Entry {
        bool has_free_effector = false;
        bool is_effector_absolute = false;
        std::size_t first_row = 0;
        std::size_t first_guard = 0;
        std::size_t guard_count = 0;
        Hanging effector;
    };
    void check_chains() const;
    void add_effectors(const std::vector<Guard>& guards);
    void add_guards(const std::vector<Guard>& guards);

    std::vector<int> parents_;
    std::vector<ChainBones> chains_;
    std::vector<Entry> entries_;
    std::vector<Hanging> guards_;  // chain by chain
    std::vector<int> rows_;
    std::vector<unsigned char> is_absolute_;
    LeavesZero<std::size_t> chain_bone_count_, longest_chain_;
    std::shared_ptr<const void> identity_ = std::make_shared<const char>();
};

struct RestBone;
struct AnimatedBone;

/// The bones of a plan's rows at rest, each relative to its parent. An immutable value, valid until the
/// armature is edited; copies share its data.
class RestBones {
  public:
    RestBones() = default;  // belongs to no plan
    /// Reads neither poses nor basis. Numbers that are not finite are allowed. std::invalid_argument if
    /// the rig's parents are not the plan's, or its arrays do not have as many bones.
    RestBones(const ChainPlan& plan, const RigView& rig);

    /// In the order of the plan's rows.
    [[nodiscard]] std::span<const RestBone> rows() const noexcept;
    [[nodiscard]] bool is_of(const ChainPlan& plan) const noexcept {
        return plan_ != nullptr && plan_ == plan.identity();
    }

  private:
    std::shared_ptr<const void> plan_;  ///< its identity
    std::shared_ptr<const std::vector<RestBone>> rows_;
};

/// The bones of a plan's rows as they are animated (FK): all that a solve reads except the pose of the
/// chains' parents. An immutable value, valid until a bone's own transform changes; copies share its data.
class AnimatedBones {
  public:
    AnimatedBones() = default;  // belongs to no plan
    /// basis: as in RigView, of all bones. std::invalid_argument if `rest` or `basis` are not the plan's.
    AnimatedBones(const ChainPlan& plan, RestBones rest, std::span<const float> basis);

    /// In the order of the plan's rows.
    [[nodiscard]] std::span<const AnimatedBone> rows() const noexcept;
    [[nodiscard]] bool is_of(const ChainPlan& plan) const noexcept { return rest_.is_of(plan); }

  private:
    RestBones rest_;
    std::shared_ptr<const std::vector<AnimatedBone>> rows_;
};

/// The input of a solve. Sizes are checked by solve(); numbers that are not finite are allowed.
struct ChainInput {
    AnimatedBones bones;                          ///< of the plan
    std::span<const float> poses;                 ///< as in RigView; read for the parents of chains
    glm::dmat4 world{1.0};                        ///< the rig's matrix_world
    std::span<const ChainSettings> settings;      ///< one per chain
    std::span<const glm::dmat4> targets;          ///< one per chain, world
    std::span<const glm::dvec3> poles;            ///< one per chain, world; a NaN in it: no pole
    std::span<const chains::JointLimits> limits;  ///< one per chain bone, chain by chain; or empty: no limits
};

/// The output of a solve.
struct ChainOutput {
    std::span<glm::dquat> rotations;     ///< one per row
    std::span<glm::dvec3> scales;        ///< one per row
    std::span<ChainDiagnostics> report;  ///< one per chain
};

/// Solves every chain independently. std::invalid_argument if sizes do not fit. Always finite; rows of a
/// chain that is off are neutral (identity and 1; the FK pose if they are absolute), and so are those of one
/// with numbers that are not finite (identity and 1 everywhere).
void solve(const ChainPlan& plan, const ChainInput& input, const ChainOutput& output);

/// Targets (rigid matrices) and poles, world, for which the solution of each chain is the FK pose. With
/// both stretch and softness an almost straight FK pose has no such target: the tip is right, but the bones
/// are a little longer. Reads no targets, poles and limits; a chain with numbers that are not finite gets the
/// identity and a pole of NaN.
void match(const ChainPlan& plan, const ChainInput& input, std::span<glm::dmat4> targets,
           std::span<glm::dvec3> poles);

}  // namespace motus::bones::ik
