// An upright figure with a spine, a head and eyes, and the pose that its bones have with a result.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "angles.hpp"
#include "motus/bones/look_at/plan.hpp"
#include "random.hpp"

namespace motus::bones::look_at::checks {

using test::angle_between;

inline constexpr int plain = inherits_rotation | has_local_location;
inline const glm::dvec3 left_eye_place{0.03, -0.1, 0.08};

inline void append(std::vector<float>& values, const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) values.push_back(static_cast<float>(matrix[column][row]));
    }
}

/// An upright figure that looks along -Y: bones up along Z, head, two eyes whose Y axes point forward.
struct Figure {
    std::vector<int> parents, inheritance;
    std::vector<float> rest, poses, basis;
    GazeBones bones;
    glm::dmat4 world{1.0};
    GazeInput input;                       ///< without its eyes_forward
    std::vector<glm::dvec3> eyes_forward;  ///< of each eye

    explicit Figure(int spine_bones, bool eyes = true) {
        // local Y up, local Z forward (-Y), local X to the figure's left
        const glm::dmat3 upright(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
        const glm::dmat3 eye(glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1));
        add(-1, upright, {0, 0, 0.5});  // a root, which the body hangs on
        for (int i = 0; i < spine_bones; ++i) {
            bones.body.push_back(add(i, upright, {0, 0, 1.0 + 0.1 * i}));
        }
        bones.head = add(spine_bones, upright, {0, 0, 1.0 + 0.1 * spine_bones});
        if (eyes) {
            const glm::dvec3 head(0, 0, 1.0 + 0.1 * spine_bones);
            bones.eyes.push_back(add(bones.head, eye, head + left_eye_place));
            bones.eyes.push_back(add(bones.head, eye, head + left_eye_place * glm::dvec3(-1, 1, 1)));
        }
        input.head_forward = {0, 0, 1};
        eyes_forward.assign(bones.eyes.size(), {0, 1, 0});
        input.settings.clamp = 0.0;
    }

    int add(int parent, const glm::dmat3& axes, const glm::dvec3& place) {
        glm::dmat4 matrix(axes);
        matrix[3] = glm::dvec4(place, 1.0);
        parents.push_back(parent);
        inheritance.push_back(plain);
        append(rest, matrix);
        append(poses, matrix);
        append(basis, glm::dmat4(1.0));
        return static_cast<int>(parents.size()) - 1;
    }

    void set(std::vector<float>& matrices, int bone, const glm::dmat4& matrix) {
        std::vector<float> values;
        append(values, matrix);
        std::copy(values.begin(), values.end(), matrices.begin() + 16 * bone);
    }

    [[nodiscard]] RigView view() const { return {{parents, rest, poses, basis, {}, inheritance}}; }
};

struct Result {
    std::vector<glm::dquat> rotations;
    GazeDiagnostics report;
};

inline Result solve(const Figure& figure) {
    const GazePlan plan(figure.parents, {&figure.bones, 1});
    Result result;
    result.rotations.assign(plan.rows().size(), glm::dquat(9, 9, 9, 9));
    GazeInput input = figure.input;
    input.eyes_forward = figure.eyes_forward;
    plan.solve(figure.view(), figure.world, {&input, 1}, result.rotations, {&result.report, 1});
    return result;
}

/// Pose of a bone with the result applied: the own rotation times the relative one, from the root on.
inline glm::dmat4 posed(const Figure& figure, const Result& result, int bone) {
    const auto index = static_cast<std::size_t>(bone);
    if (bone == 0) return matrix_at(figure.poses, 0);
    std::vector<int> rows = figure.bones.body;
    rows.push_back(figure.bones.head);
    rows.insert(rows.end(), figure.bones.eyes.begin(), figure.bones.eyes.end());
    glm::dmat4 own = matrix_at(figure.basis, index);
    const auto row = std::find(rows.begin(), rows.end(), bone);
    if (row != rows.end()) {
        glm::dmat3 rotation(own);
        glm::dvec3 scale(glm::length(rotation[0]), glm::length(rotation[1]), glm::length(rotation[2]));
        if (glm::determinant(rotation) < 0.0) scale = -scale;
        for (int axis = 0; axis < 3; ++axis) rotation[axis] /= scale[axis];
        rotation = glm::mat3_cast(glm::normalize(glm::quat_cast(rotation)) *
                                  result.rotations[static_cast<std::size_t>(row - rows.begin())]);
        for (int axis = 0; axis < 3; ++axis) own[axis] = glm::dvec4(scale[axis] * rotation[axis], 0.0);
    }
    const glm::dmat4 parent = posed(figure, result, figure.parents[index]);
    return to_pose(parent_space(rest_of(figure.view(), index), parent), own);
}

/// Angle, in world space, between where a bone looks and its target.
inline double miss(const Figure& figure, const Result& result, int bone, const glm::dvec3& axis) {
    const glm::dmat4 pose = figure.world * posed(figure, result, bone);
    const glm::dvec3 gaze = glm::normalize(glm::dmat3(pose) * axis);
    return angle_between(gaze, glm::normalize(figure.input.target - glm::dvec3(pose[3])));
}

inline glm::dquat in_pose(const Figure& figure, const Result& result, int bone) {
    return glm::quat_cast(glm::dmat3(posed(figure, result, bone))) *
           glm::conjugate(glm::quat_cast(glm::dmat3(matrix_at(figure.rest, static_cast<std::size_t>(bone)))));
}

inline bool is_identity(const glm::dquat& q) {
    return q.w == 1.0 && q.x == 0.0 && q.y == 0.0 && q.z == 0.0;
}

inline bool is_still(const Result& result) {
    return std::all_of(result.rotations.begin(), result.rotations.end(), is_identity);
}

class Randomness : public motus::test::Random {
  public:
    using Random::Random;
    glm::dmat4 pose(double turn, double place, double scale) {
        const glm::dvec3 turned = around_origin(turn);
        glm::dmat4 matrix = glm::mat4_cast(glm::normalize(glm::dquat(1.0, turned)));
        for (int axis = 0; axis < 3; ++axis) matrix[axis] *= std::exp(scale * normal());
        matrix[3] = glm::dvec4(around_origin(place), 1.0);
        return matrix;
    }
};

/// The figure animated, with its rig somewhere in the world.
inline Figure animated(int spine_bones, Randomness& random, double scale) {
    Figure figure(spine_bones);
    figure.world = random.pose(1.0, 3.0, 0.0);
    figure.set(figure.poses, 0, random.pose(0.5, 0.3, scale));
    for (std::size_t bone = 1; bone < figure.parents.size(); ++bone)
        figure.set(figure.basis, static_cast<int>(bone), random.pose(0.2, 0.02, scale));
    figure.input.target = random.around_origin(4.0);
    figure.input.settings.eyes_weight = 1.0;
    return figure;
}

}  // namespace motus::bones::look_at::checks
