// Look-at on the bones of one rig: many heads, each with the spine below it and eyes.
//
// Costs: O(bones) to plan and to solve. Planning allocates the plan, solving nothing. A plan is immutable:
// any number of threads may solve by it at once.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/bones/look_at/gaze.hpp"
#include "motus/bones/reason.hpp"
#include "motus/bones/rig.hpp"
#include "motus/config.hpp"

namespace motus::bones::look_at {

/// Indices of the bones that turn to one target.
struct GazeBones {
    std::vector<int> body;  ///< from the lowest up, each above the one before, below the head; may be empty
    int head = 0;
    std::vector<int> eyes;  ///< above the head, in any order; may be empty
};

/// A further target of a head.
struct GazeTarget {
    glm::dvec3 place{0.0};  ///< world space
    double weight = 0.0;    ///< >= 0; less counts as 0
};

/// What one head looks at.
///
/// Several targets are blended for each bone that looks: their directions from the bone are places in the
/// chart, and the mean of these by weight is the direction looked in. So two targets that are opposed to each
/// other are well defined: a head between equal ones to its left and right looks ahead. Weights that sum up
/// to less than 1 leave the rest to the animated gaze.
struct GazeInput {
    GazeSettings settings;
    glm::dvec3 target{0.0};               ///< world space
    double target_weight = 1.0;           ///< as in GazeTarget
    std::span<const GazeTarget> further;  ///< beside `target`
    glm::dvec3 head_forward{0.0, 0.0,
                            1.0};  ///< axis of the head bone that points where the face does; not zero
    std::span<const glm::dvec3> eyes_forward;  ///< axis of each eye bone that points where the eye looks, in
                                               ///< the order of GazeBones::eyes
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< the rig's upward direction at rest, armature space; not zero
    /// How far beside the direction that they turn to the eyes look, rad to the left and up, within their
    /// limits; times GazeSettings::weight, whatever eyes_weight is.
    glm::dvec2 eyes_beside{0.0};
    bool is_on = true;
};

/// How well a head meets its target. Angles in the rig's space, rad.
struct GazeDiagnostics {
    double angle = 0.0;  ///< between gaze and target: of the eyes (the worse) if they have weight, else of
                         ///< the head; without GazeInput::eyes_beside
    std::optional<Reason> reason =
        Reason::reached;  ///< limit: clamp or a limit keeps the gaze off; reached: nothing but
                          ///< weights does. None: input not finite, or a bone of no size
    double yaw = 0.0;  ///< of the target seen from the head beside the chest's forward, positive to the left
    double pitch = 0.0;  ///< positive up
};

/// Bones of a rig that look at targets. The hierarchy is checked once.
///
/// The chest is the space that the head bone's own rotation acts in: its forward is the head's without that
/// rotation, its up is GazeInput::up turned with the animated chest (if the face looks along up at
/// rest: the head bone's own Y or Z). Every gaze starts at its bone's own place; no bone moves the place it
/// turns about, so that what the head has to turn is known once the body stands, and what the eyes have to
/// once the head does. A head (or eye) of weight 1 and no limit therefore meets its target exactly, near ones
/// too, whatever its parents' scales: the direction wanted is taken through the inverse of the space that the
/// bone stands in. The body's share is that of the turn seen from the animated head.
class GazePlan {
  public:
    /// parents: index of each bone's parent, -1 for none, in any order. Throws
    /// std::invalid_argument if an index is none of a bone's, or the bones are not above each other as
    /// Bones says.
    GazePlan(std::span<const int> parents, std::span<const GazeBones> entries);

    /// Bones of the result's rows: body, head, eyes of each entry.
    [[nodiscard]] std::span<const int> rows() const noexcept { return rows_; }
    [[nodiscard]] std::span<const int> parents() const noexcept { return parents_; }
    [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
    /// How many eyes each entry has.
    [[nodiscard]] std::span<const std::size_t> eye_counts() const noexcept { return eye_counts_; }

    /// One input and one report per entry; one rotation per row, which is applied on top of the bone's
    /// animated rotation (rotation of PoseBone.matrix_basis * result), w >= 0. Without a turn (weight 0, off,
    /// target at the head itself, input not finite) exactly the identity. world: the rig's matrix_world.
    /// RigView::lengths is not read. Allocates nothing; every result is finite. Throws std::invalid_argument
    /// if a span has another size, one of GazeInput::eyes_forward included, or the rig's parents are not the
    /// plan's.
    void solve(const RigView& rig, const glm::dmat4& world, std::span<const GazeInput> inputs,
               std::span<glm::dquat> rotations, std::span<GazeDiagnostics> reports) const;

  private:
    /// A bone on the way up, and the row of its result; none if the bone does not turn by itself.
    struct Link {
        std::size_t bone = 0;
        std::optional<std::size_t> row;
    };
    struct Entry {
        std::vector<Link> body;   ///< up to the head, which is not among them
        std::size_t turning = 0;  ///< how many of them have a row
        Link head;
        std::vector<std::vector<Link>> eyes;  ///< each from above the head up to the eye
        std::size_t first_row = 0;
        std::size_t row_count = 0;
    };
    class Solver;

    [[nodiscard]] std::vector<Link> way(int from, int above, const char* what) const;
    void add(const GazeBones& bones);

    std::vector<int> parents_;
    std::vector<int> rows_;
    std::vector<std::size_t> eye_counts_;
    std::vector<Entry> entries_;
};

}  // namespace motus::bones::look_at
