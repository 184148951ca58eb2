// Look-at: time per head.
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "motus/bones/look_at/plan.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::look_at;

namespace {

constexpr int head_count = 100;

/// Figures side by side in one rig, each of a root, spine bones, a head and two eyes.
struct Crowd {
    std::vector<int> parents, inheritance;
    std::vector<float> matrices, basis;
    std::vector<GazeBones> bones;
    std::vector<GazeInput> inputs;
    std::array<glm::dvec3, 2> eyes_forward{glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)};

    Crowd(int spine_bones, bool eyes) {
        for (int i = 0; i < head_count; ++i) {
            const glm::dvec3 place(i, 0, 0);
            GazeBones figure;
            int last = add(-1, place);
            for (int bone = 0; bone < spine_bones; ++bone)
                figure.body.push_back(last = add(last, place + glm::dvec3(0, 0, 1 + 0.1 * bone)));
            figure.head = add(last, place + glm::dvec3(0, 0, 2));
            if (eyes) {
                figure.eyes.push_back(add(figure.head, place + glm::dvec3(0.03, -0.1, 2.1)));
                figure.eyes.push_back(add(figure.head, place + glm::dvec3(-0.03, -0.1, 2.1)));
            }
            bones.push_back(figure);
            GazeInput input;
            input.target = place + glm::dvec3(3 * std::cos(i), -2, 2 + std::sin(i));
            input.eyes_forward = std::span(eyes_forward).first(figure.eyes.size());
            input.settings.eyes_weight = eyes ? 1.0 : 0.0;
            input.settings.head_limit = 1.2;
            inputs.push_back(input);
        }
    }

    int add(int parent, const glm::dvec3& place) {
        glm::dmat4 matrix(0.0);
        matrix[0] = {1, 0, 0, 0};
        matrix[1] = {0, 0, 1, 0};
        matrix[2] = {0, -1, 0, 0};
        matrix[3] = glm::dvec4(place, 1.0);
        append(matrices, matrix);
        append(basis, glm::dmat4(1.0));
        parents.push_back(parent);
        inheritance.push_back(inherits_rotation | has_local_location);
        return static_cast<int>(parents.size()) - 1;
    }

    static void append(std::vector<float>& values, const glm::dmat4& matrix) {
        for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(matrix[i / 4][i % 4]));
    }
};

void row(const bench::Table& table, const char* name, int spine_bones, bool eyes) {
    const Crowd crowd(spine_bones, eyes);
    const GazePlan plan(crowd.parents, crowd.bones);
    const RigView rig({crowd.parents, crowd.matrices, crowd.matrices, crowd.basis, {}, crowd.inheritance});
    std::vector<glm::dquat> rotations(plan.rows().size());
    std::vector<GazeDiagnostics> reports(plan.size());
    const double taken = bench::nanoseconds(
        [&] {
            plan.solve(rig, glm::dmat4(1.0), crowd.inputs, rotations, reports);
            bench::keep(rotations);
        },
        100);
    table.row(name, {taken / 1e3 / head_count});
}

}  // namespace

int main() {
    const bench::Table table(
        "Look-at, " + std::to_string(head_count) + " heads of one rig, one thread, best of 100",
        {{"a head", "us"}});
    row(table, "head", 0, false);
    row(table, "3 spine bones, head", 3, false);
    row(table, "3 spine bones, head, 2 eyes", 3, true);
    row(table, "10 spine bones, head, 2 eyes", 10, true);
    return 0;
}
