// Layers of animation: what a frame of one rig costs.
#include <array>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <utility>
#include <vector>

#include "motus/bones/layers/stack.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::layers;

namespace {

constexpr int bone_count = 200;
constexpr int key_count = 12;

/// Chains of ten bones, each of which has keys of location and quaternion.
struct Rig {
    std::vector<int> parents;
    std::vector<glm::dquat> rest;
    std::vector<char> inherits;
    std::vector<Transform> pose;
    std::vector<double> mask;

    Rig() : inherits(bone_count, 1), mask(bone_count, 0.8) {
        test::Random random(1);
        for (int bone = 0; bone < bone_count; ++bone) {
            parents.push_back(bone % 10 == 0 ? -1 : bone - 1);
            rest.push_back(glm::angleAxis(random.between(-1.0, 1.0), glm::normalize(random.around_origin())));
            pose.push_back({random.in_cube(), rest.back(), {1, 1, 1}});
        }
    }
};

Clip make_clip() {
    test::Random random(2);
    const std::vector<Rotation> modes(bone_count, Rotation::quaternion);
    std::vector<ClipCurve> curves;
    std::vector<fcurve::FCurve> fcurves;
    for (int bone = 0; bone < bone_count; ++bone) {
        for (int channel = 0; channel < 7; ++channel) {
            curves.push_back({bone, channel, static_cast<int>(fcurves.size())});
            std::vector<fcurve::Key> keys;
            for (int i = 0; i < key_count; ++i) {
                const glm::dvec2 place(8.0 * i, random.between(-1.0, 1.0));
                keys.push_back({place, place - glm::dvec2(2.6, 0.0), place + glm::dvec2(2.6, 0.0)});
            }
            fcurves.emplace_back(std::move(keys), false);
        }
    }
    return {modes, curves, fcurves};
}

void row(const bench::Table& table, const char* name, const Rig& rig, std::size_t count, const Layer& layer) {
    const Stack stack(rig.parents, rig.rest, rig.inherits);
    const std::vector<Layer> layers(count, layer);
    std::vector<Transform> result(bone_count);
    std::vector<char> changed(bone_count);
    const double taken = bench::nanoseconds(
        [&] {
            stack.solve(30.3, layers, rig.pose, result, changed);
            bench::keep(result);
        },
        100);
    table.row(name, {taken / 1e3, taken / static_cast<double>(bone_count * count)});
}

}  // namespace

int main() {
    const Rig rig;
    const Clip clip = make_clip();
    Layer layer;
    layer.clip = &clip;
    layer.mask = rig.mask;
    layer.timing = {1.0, 0.0, 88.0, 1.0, After::repeat, 0.0, 0.0};
    const bench::Table table("Layers of " + std::to_string(bone_count) + " bones, one thread, best of 100",
                             {{"a frame", "us", 1}, {"a bone and layer", "ns", 1}});
    row(table, "8 layers, override", rig, 8, layer);
    row(table, "3 layers, override", rig, 3, layer);
    layer.mode = LayerMode::additive;
    row(table, "8 layers, additive", rig, 8, layer);
    layer.mode = LayerMode::override;
    layer.in_armature = true;
    row(table, "8 layers, in the armature", rig, 8, layer);
    return 0;
}
