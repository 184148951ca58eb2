// Inverse kinematics of two bones, free and with a knee that bends between two angles.
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "motus/bones/chains/limited.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/core/numeric.hpp"
#include "web.hpp"

namespace motus::web {

/// The chain bends towards a pole. out: the elbow, the tip, the scale of the bones, the distance from the tip
/// to the target, and the number of the Reason.
MOTUS_WEB(two_bone)
(const double* target, std::size_t, const double* pole, std::size_t, double length1, double length2,
 double softness, double stretch, double* out) {
    const bones::chains::TwoBoneSolution solution =
        bones::chains::solve_two_bone({.target = {target[0], target[1], target[2]},
                                       .pole = {pole[0], pole[1], pole[2]},
                                       .length1 = length1,
                                       .length2 = length2,
                                       .softness = softness,
                                       .stretch = stretch});
    out = write(write(out, solution.elbow), solution.tip);
    *out++ = solution.scale;
    *out++ = solution.residual;
    *out++ = static_cast<double>(solution.reason);
}

/// joints: the pose to start from. limits: for each bone the least x, y, z and the most x, y, z that it may
/// turn from that pose, rad. out: the joints, the distance from the last one to the target, and the number of
/// the Reason.
MOTUS_WEB(limited_chain)
(const double* joints, std::size_t count, const double* target, std::size_t, const double* limits,
 std::size_t limit_count, double* out) {
    std::vector<glm::dvec3> pose = points_of(joints, count);
    require(pose.size() >= 2, "joints: two at least are needed");
    const std::size_t bones = pose.size() - 1;
    require(limit_count == 6 * bones, "limits: six numbers for each bone are needed");
    std::vector<glm::dquat> frames(bones), rest(bones), rotations(bones, {1.0, 0.0, 0.0, 0.0});
    bones::chains::bone_frames(pose, frames);
    std::vector<glm::dvec3> offsets(bones);
    std::vector<bones::chains::JointLimits> ranges(bones);
    for (std::size_t i = 0; i < bones; ++i) {
        rest[i] = i == 0 ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                         : glm::normalize(glm::conjugate(frames[i - 1]) * frames[i]);
        offsets[i] = glm::conjugate(frames[i]) * (pose[i + 1] - pose[i]);
        const double* range = limits + 6 * i;
        ranges[i] = {.min = {range[0], range[1], range[2]}, .max = {range[3], range[4], range[5]}};
    }
    const bones::chains::Limited chain{
        .root = pose[0], .base = frames[0], .rest = rest, .offsets = offsets, .limits = ranges};
    const bones::chains::Convergence report =
        bones::chains::solve_limited(chain, {target[0], target[1], target[2]}, {}, rotations);
    bones::chains::joints_of(chain, rotations, pose);
    for (const glm::dvec3& joint : pose) out = write(out, joint);
    *out++ = report.residual;
    *out++ = static_cast<double>(report.reason);
}

}  // namespace motus::web
