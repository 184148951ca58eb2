// Clips of any F-curves on any rig, laid over its pose: bones that were finite stay finite.
#include "motus/bones/layers/clip.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "motus/bones/layers/mask.hpp"
#include "motus/bones/layers/stack.hpp"
#include "targets.hpp"

namespace motus::fuzzers {

using namespace bones::layers;

namespace {

fcurve::Key key_of(Bytes& bytes, double& frame) {
    fcurve::Key key;
    frame += bytes.number(0.0, 4.0);
    key.place = {static_cast<float>(frame), bytes.single()};
    key.left = key.place - glm::vec2(bytes.single(0.0, 2.0), bytes.single());
    key.right = key.place + glm::vec2(bytes.single(0.0, 2.0), bytes.single());
    key.interpolation = bytes.choice<fcurve::Interpolation>(fcurve::interpolation_count);
    key.easing = bytes.choice<fcurve::Easing>(fcurve::easing_count);
    if (bytes.flag()) key.overshoot = bytes.single();
    if (bytes.flag()) key.amplitude = bytes.single();
    if (bytes.flag()) key.period = bytes.single();
    return key;
}

std::optional<fcurve::Cycles> cycles_of(Bytes& bytes) {
    if (!bytes.flag()) return {};
    fcurve::Cycles cycles;
    cycles.before = bytes.choice<fcurve::Repeat>(fcurve::repeat_count);
    cycles.after = bytes.choice<fcurve::Repeat>(fcurve::repeat_count);
    cycles.before_count = bytes.whole(-1, 3);
    cycles.after_count = bytes.whole(-1, 3);
    if (bytes.flag()) cycles.start = bytes.single(-5.0, 5.0);
    if (bytes.flag()) cycles.end = bytes.single(0.0, 20.0);
    cycles.blend_in = bytes.single(0.0, 5.0);
    cycles.blend_out = bytes.single(0.0, 5.0);
    cycles.influence = bytes.single(0.0, 1.0);
    cycles.is_exact = bytes.flag();
    return cycles;
}

std::vector<fcurve::FCurve> fcurves_of(Bytes& bytes) {
    std::vector<fcurve::FCurve> made;
    const std::size_t count = bytes.count(3);
    for (std::size_t i = 0; i < count; ++i) {
        double frame = bytes.number(-5.0, 5.0);
        std::vector<fcurve::Key> keys;
        for (std::size_t left = bytes.count(5); left > 0; --left) keys.push_back(key_of(bytes, frame));
        const bool goes_on = bytes.flag();
        const std::optional<fcurve::Cycles> cycles = cycles_of(bytes);
        returns([&] { made.emplace_back(std::move(keys), goes_on, cycles); });
    }
    return made;
}

void look_at(const fcurve::FCurve& curve, double frame) {
    fcurve::Roots roots, same;
    const double first = curve.precise_value(frame, roots);
    const double again = curve.precise_value(frame, roots), anew = curve.precise_value(frame, same);
    expect(first == again || (std::isnan(first) && std::isnan(again)), "precise_value: the same once more");
    expect(first == anew || (std::isnan(first) && std::isnan(anew)),
           "precise_value: the same without a cache");
    (void)curve.value(frame);
}

LayerTiming timing_of(Bytes& bytes) {
    LayerTiming timing;
    timing.start = bytes.number(-5.0, 5.0);
    timing.first = bytes.number(-5.0, 5.0);
    timing.last = timing.first + bytes.number(0.0, 9.0);
    timing.speed = bytes.number(-2.0, 2.0);
    timing.after = bytes.choice<After>(3);
    timing.blend_in = bytes.number(0.0, 3.0);
    timing.blend_out = bytes.number(0.0, 3.0);
    return timing;
}

/// Bones, some of which may be their own ancestors: those are refused.
struct Rig {
    std::vector<int> parents;
    std::vector<glm::dquat> rest;
    std::vector<char> inherits;
    std::vector<Rotation> rotations;
    std::vector<Transform> base;
    std::vector<double> mask;

    explicit Rig(Bytes& bytes) {
        const int count = bytes.whole(0, 4);
        for (int bone = 0; bone < count; ++bone) {
            parents.push_back(bytes.whole(-1, count));
            rest.push_back(bytes.quaternion());
            inherits.push_back(bytes.flag() ? 1 : 0);
            rotations.push_back(bytes.choice<Rotation>(8));
            base.push_back({bytes.place(), bytes.quaternion(), bytes.place()});
            mask.push_back(bytes.number(0.0, 1.0));
        }
    }
};

std::optional<Clip> clip_of(Bytes& bytes, const Rig& rig, std::span<const fcurve::FCurve> fcurves) {
    std::vector<bones::layers::ClipCurve> curves;
    for (std::size_t left = bytes.count(6); left > 0; --left) {
        const int bone = bytes.whole(-1, static_cast<int>(rig.parents.size())),
                  channel = bytes.whole(-1, channel_count);
        curves.push_back({bone, channel, bytes.whole(-2, static_cast<int>(fcurves.size())), bytes.flag()});
    }
    std::optional<Clip> made;
    returns([&] { made.emplace(rig.rotations, curves, fcurves); });
    return made;
}

void lay(Bytes& bytes, const Rig& rig, const Clip& clip, double frame) {
    const std::vector<double> given = bytes.numbers(clip.given_count());
    std::vector<Transform> poses(clip.bones().size());
    std::vector<Numbers> numbers(poses.size());
    if (!returns([&] { clip.evaluate(frame, given, poses, numbers); })) return;
    Layer layer;
    layer.clip = &clip;
    layer.given = given;
    layer.mask = rig.mask;
    if (bytes.flag()) layer.reference = poses;
    std::vector<Lap> laps(poses.size());
    for (std::size_t i = 0; i < laps.size(); ++i) laps[i].from = numbers[i];
    if (bytes.flag()) layer.laps = laps;
    layer.timing = timing_of(bytes);
    layer.weight = bytes.number(0.0, 1.0);
    layer.mode = bytes.choice<LayerMode>(2);
    layer.in_armature = bytes.flag();
    const std::vector<Layer> layers(1 + bytes.count(1), layer);
    std::vector<Transform> result(rig.base.size());
    std::vector<char> changed(rig.base.size());
    returns([&] {
        const Stack stack(rig.parents, rig.rest, rig.inherits);
        stack.solve(frame, layers, rig.base, result, changed);
        for (std::size_t bone = 0; bone < result.size(); ++bone)
            if (is_finite(rig.base[bone])) expect(is_finite(result[bone]), "solve: finite bones stay finite");
    });
}

}  // namespace

void try_clip(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    const double frame = bytes.number(-10.0, 30.0);
    const std::vector<fcurve::FCurve> fcurves = fcurves_of(bytes);
    for (const fcurve::FCurve& curve : fcurves) look_at(curve, frame);
    const LayerTiming timing = timing_of(bytes);
    returns([&] {
        const Moment moment = moment_of(timing, frame);
        expect(std::isfinite(moment.frame), "moment_of: a finite frame");
        expect(moment.weight >= 0.0 && moment.weight <= 1.0, "moment_of: a weight from 0 to 1");
    });
    const Rig rig(bytes);
    if (const std::optional<Clip> clip = clip_of(bytes, rig, fcurves)) lay(bytes, rig, *clip, frame);
    returns([&] {
        const std::vector<int> order = parents_first(rig.parents);
        std::vector<double> mask(order.size());
        feathered(rig.parents, order, rig.mask, bytes.whole(-1, 3), mask);
    });
}

}  // namespace motus::fuzzers
