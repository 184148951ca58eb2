#include "contracts/rigs.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/bones/layers/mask.hpp"
#include "motus/bones/layers/stack.hpp"

namespace motus::contracts {

template <Some<bones::layers::Transform> T>
auto fields(Declared, T& v) {
    return std::tie(v.location, v.rotation, v.scale);
}
template <Some<bones::layers::Moment> T>
auto fields(Declared, T& v) {
    return std::tie(v.frame, v.weight, v.laps);
}
template <Some<bones::layers::ClipCurve> T>
auto fields(Declared, T& v) {
    return std::tie(v.bone, v.channel, v.fcurve);
}
template <Some<fcurve::Key> T>
auto fields(Declared, T& v) {
    return std::tie(v.place, v.left, v.right, v.overshoot, v.amplitude, v.period);
}

namespace {

using namespace bones::layers;
using fcurve::FCurve;
using fcurve::Key;

[[nodiscard]] std::vector<Key> sample_keys() {
    return {{{1.0F, 0.0F}, {0.0F, 0.0F}, {2.0F, 0.0F}},
            {{5.0F, 4.0F}, {4.0F, 3.0F}, {6.0F, 5.0F}},
            {{9.0F, 8.0F}, {8.0F, 8.0F}, {10.0F, 8.0F}}};
}
[[nodiscard]] const FCurve& sample_fcurve() {
    static const FCurve made(sample_keys(), true);
    return made;
}
[[nodiscard]] const Clip& sample_clip() {
    static const Clip made(
        std::vector{Rotation::quaternion, Rotation::xyz, Rotation::axis_angle, Rotation::quaternion},
        std::vector<ClipCurve>{{0, 0, 0}, {1, 4, 0}, {2, 7, -1}}, std::vector{sample_fcurve()});
    return made;
}
[[nodiscard]] const Stack& sample_stack() {
    static const Stack made(sample_parents(), std::vector<glm::dquat>(4, bones::no_turn),
                            std::vector<char>(4, 1));
    return made;
}
[[nodiscard]] Domain partly_passed() {
    return {"any; what a NaN is a part of is NaN", [](const Domain::Seen&) { return Verdict::unbounded; }};
}
[[nodiscard]] Domain unit_unchecked() {
    return partly_passed().in_words("unit, not checked");
}

void add_fcurves(Table& table) {
    const Domain number = finite().open().in_words("finite; frames strictly rise");
    const auto told = [](const FCurve& curve) {
        return std::tuple(curve.value(2.5), curve.value(7.0), curve.value(20.0));
    };
    add(
        table, "fcurve::FCurve::FCurve(keys, goes_on, cycles)",
        [told](const auto& keys) { return told(FCurve(keys, true)); },
        arg("keys", sample_keys(), number, at_least_many(1)))
        .costs("O(n)")
        .allocates(Memory::scratch)
        .infinite()
        .adds("values may be infinite where Blender's are");
    using fcurve::Cycles;
    const Domain count = at_least(0.0);
    add(
        table, "fcurve::FCurve::FCurve(keys, goes_on, cycles)",
        [told](const Cycles& cycles) { return told(FCurve(sample_keys(), true, cycles)); },
        of(Cycles{}, member("cycles", &Cycles::before_count, count),
           member("cycles", &Cycles::after_count, count), member("cycles", &Cycles::start, no_nan()),
           member("cycles", &Cycles::end, no_nan()), member("cycles", &Cycles::blend_in, finite()),
           member("cycles", &Cycles::blend_out, finite()), member("cycles", &Cycles::influence, finite())))
        .costs("O(n)")
        .allocates(Memory::scratch)
        .infinite()
        .adds("members of `cycles`: counts, start and end, blends and influence");
    add(
        table, "fcurve::FCurve::value(frame)", [](double frame) { return sample_fcurve().value(frame); },
        arg("frame", 2.5, any().in_words("any; NaN for what is not finite")))
        .costs("O(log n)")
        .infinite();
    add(
        table, "fcurve::FCurve::precise_value(frame, roots)",
        [](double frame) {
            fcurve::Roots roots;
            return sample_fcurve().precise_value(frame, roots);
        },
        arg("frame", 2.5, any().in_words("any; NaN for what is not finite")))
        .costs("O(log n)")
        .infinite();
    add(
        table, "fcurve::FCurve::values(frames, out)",
        [](const auto& frames, auto found) { sample_fcurve().values(frames, found); },
        arg("frames", std::vector{2.5, 7.0}, finite(), as_many_as("`out`")),
        out<double>("out", 2, "`frames`"))
        .costs("O(n log keys)")
        .infinite();
    const Domain part = partly_passed().in_words("any; none where it is not found");
    add(
        table, "fcurve::parameter_at(frames, frame)",
        [](const auto& frames, float frame) { return fcurve::parameter_at(frames, frame); },
        arg("frames", std::array{0.0F, 1.0F, 2.0F, 3.0F}, part), arg("frame", 1.2F, part))
        .costs("O(1)");
    add(
        table, "fcurve::parameter_at(frames, frame)",
        [](const auto& frames, double frame) { return fcurve::parameter_at(frames, frame); },
        arg("frames", std::array{0.0, 1.0, 2.0, 3.0}, part), arg("frame", 1.2, part))
        .costs("O(1)");
    add(
        table, "fcurve::Root::find(frames, frame)",
        [](const auto& frames, double frame) { return fcurve::Root<double>().find(frames, frame); },
        arg("frames", std::array{0.0, 1.0, 2.0, 3.0}, part), arg("frame", 1.2, part))
        .costs("O(1)")
        .alone();
    table.moved.push_back({"fcurve::FCurve", "the curve that it was", [] {
                               FCurve from = sample_fcurve();
                               const FCurve taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.value(5.0) == taken.value(5.0) && from.keys().size() == 3,
                                      "is the same");
                               from = taken;
                           }});
}

void add_clips(Table& table) {
    add(
        table, "bones::layers::Clip::Clip(rotations, curves, fcurves)",
        [](const auto& curves) {
            return Clip(std::vector(4, Rotation::xyz), curves, std::vector{sample_fcurve()}).given_count();
        },
        arg("curves", std::vector<ClipCurve>{{0, 0, 0}, {1, 4, 0}, {2, 7, -1}},
            finite().open().in_words("a bone, a channel from 0 to 9, and an F-curve or -1")))
        .costs("O(n log n)")
        .allocates(Memory::scratch);
    add(
        table, "bones::layers::Clip::evaluate(frame, given, out, numbers)",
        [](double frame, const auto& given, auto found, auto numbers) {
            sample_clip().evaluate(frame, given, found, numbers);
        },
        arg("frame", 2.5, finite()),
        arg("given", std::vector{2.0}, any_at_rest("any; what is not finite counts as 0"),
            as_many_as("the curves without an F-curve")),
        out<Transform>("out", 3, "the clip's bones"),
        out<Numbers>("numbers", 3, "the clip's bones, or none", true))
        .costs("O(curves log keys)");
    table.moved.push_back({"bones::layers::Clip", "of no bones", [] {
                               Clip from = sample_clip();
                               const Clip taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.bones().empty() && from.bone_count() == 0, "is empty");
                               expect(from.given_count() == 0 && !from.has_spins(), "asks for nothing");
                               from.evaluate(1.0, {}, {});
                               from = taken;
                               expect(from.bones().size() == 3, "is assigned");
                           }});
}

[[nodiscard]] auto timing() {
    LayerTiming good;
    good.last = 9.0;
    good.after = After::repeat;
    return of(good, member("start", &LayerTiming::start, finite()),
              member("first", &LayerTiming::first, finite().open().in_words("≤ `last`, finite")),
              member("last", &LayerTiming::last, finite().open().in_words("≥ `first`, finite")),
              member("speed", &LayerTiming::speed, finite()),
              member("blend_in", &LayerTiming::blend_in, at_least(0.0)),
              member("blend_out", &LayerTiming::blend_out, at_least(0.0)));
}

void add_stacks(Table& table) {
    add(
        table, "bones::layers::check(timing)", [](const LayerTiming& given) { check(given); }, timing())
        .costs("O(1)");
    add(
        table, "bones::layers::moment_of(timing, frame)",
        [](const LayerTiming& given, double frame) { return moment_of(given, frame); }, timing(),
        arg("frame", 3.0, finite()))
        .costs("O(1)");
    add(
        table, "bones::layers::Stack::Stack(parents, rest, inherits)",
        [](const auto& parents, const auto& rest, const auto& inherits) {
            return Stack(parents, rest, inherits).size();
        },
        arg("parents", sample_parents(), parent(4), as_many_as("`rest`")),
        arg("rest", std::vector<glm::dquat>(4, bones::no_turn), any_at_rest("unit, not checked"),
            as_many_as("`parents`")),
        arg("inherits", std::vector<char>(4, 1), any_at_rest("0, or not"), as_many_as("`parents`")))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    const Domain rests = any_at_rest("any; a bone with a number that is not finite stays as it is");
    add(
        table, "bones::layers::Stack::solve(frame, layers, base, result, changed)",
        [](double frame, const LayerTiming& given, double weight, const auto& values, const auto& mask,
           auto result, auto changed) {
            Layer layer;
            layer.clip = &sample_clip();
            layer.given = values;
            layer.mask = mask;
            layer.timing = given;
            layer.weight = weight;
            const std::vector<Transform> base(4);
            sample_stack().solve(frame, std::span(&layer, 1), base, result, changed);
        },
        arg("frame", 3.0, finite()), timing(), arg("weight", 0.7, finite()),
        arg("given", std::vector{2.0}, rests, as_many_as("the curves without an F-curve")),
        arg("mask", std::vector<double>(4, 1.0), rests, as_many_as("the bones")),
        out<Transform>("result", 4, "the bones"), out<char>("changed", 4, "the bones"))
        .costs("O(layers (curves + bones))")
        .allocates(Memory::scratch)
        .adds("sizes of `base`, `reference` and `laps`; `result` may be `base`");
    add(
        table,
        "bones::layers::Stack::find_source(frame, layers, edited, base, wanted, chosen, said, reached)",
        [](double frame, const LayerTiming& given, double weight, const auto& mask, std::size_t edited,
           const auto& chosen, auto said, auto reached) {
            Layer layer;
            const std::vector values{2.0};
            layer.clip = &sample_clip();
            layer.given = values;
            layer.mask = mask;
            layer.timing = given;
            layer.weight = weight;
            const std::vector<Transform> pose(4);
            sample_stack().find_source(frame, std::span(&layer, 1), edited, pose, pose, chosen, said,
                                       reached);
        },
        arg("frame", 3.0, finite()), timing(), arg("weight", 0.7, finite()),
        arg("mask", std::vector<double>(4, 1.0), rests, as_many_as("the bones")),
        arg("edited", std::size_t{0}, index(1, "a layer")),
        arg("chosen", std::vector<int>{1, 2}, index(4, "a bone"), as_many_as("`said`")),
        out<Transform>("said", 2, "`chosen`"), out<unsigned>("reached", 2, "`chosen`"))
        .costs("O(layers (curves + bones))")
        .allocates(Memory::scratch)
        .adds("sizes of `base` and `wanted`");
    table.moved.push_back({"bones::layers::Stack", "of no bones", [] {
                               Stack from = sample_stack();
                               const Stack taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.size() == 0 && from.order().empty(), "is empty");
                               from.solve(1.0, {}, {}, {}, {});
                               from = taken;
                               expect(from.size() == 4, "is assigned");
                           }});
    add(
        table, "bones::layers::parents_first(parents)",
        [](const auto& parents) { return parents_first(parents); },
        arg("parents", sample_parents(), parent(4)))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    add(
        table, "bones::layers::feathered(parents, order, chosen, feather, mask)",
        [](const auto& parents, const auto& order, const auto& chosen, int feather, auto mask) {
            feathered(parents, order, chosen, feather, mask);
        },
        arg("parents", sample_parents(), parent(4), as_many_as("`mask`")),
        arg("order", std::vector<int>{0, 1, 2, 3}, index(4, "a bone").open(), as_many_as("`mask`")),
        arg("chosen", std::vector<double>{0.0, 1.0, 1.0, 0.5}, from(0.0, 1.0), as_many_as("`mask`")),
        arg("feather", 2, at_least(0.0)), out<double>("mask", 4, "`parents`"))
        .costs("O(bones)")
        .allocates(Memory::scratch);
}

void add_transforms(Table& table) {
    const Transform good{{1.0, 2.0, 3.0}, {0.8, 0.6, 0.0, 0.0}, {1.0, 2.0, 1.0}};
    const auto transform = [&](const char* name) {
        return of(good, member(name, &Transform::location, partly_passed()),
                  member(name, &Transform::rotation, unit_unchecked()),
                  member(name, &Transform::scale, partly_passed()));
    };
    glm::dmat4 matrix(2.0);
    matrix[3] = {1.0, 2.0, 3.0, 1.0};
    const auto weight = arg("weight", 0.5, any().unbounded());
    add(
        table, "bones::layers::transform_of(matrix)",
        [](const glm::dmat4& given) { return transform_of(given); }, arg("matrix", matrix, partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::layers::matrix_of(transform)", [](const Transform& given) { return matrix_of(given); },
        transform("transform"))
        .costs("O(1)");
    add(
        table, "bones::layers::is_finite(transform)",
        [](const Transform& given) { return bones::layers::is_finite(given); }, transform("transform"))
        .costs("O(1)");
    add(
        table, "bones::layers::part_of_turn(turn, weight)",
        [](const glm::dquat& turn, double by) { return part_of_turn(turn, by); },
        arg("turn", glm::dquat(0.8, 0.6, 0.0, 0.0), unit_unchecked()), weight)
        .costs("O(1)");
    const auto part = arg("part", glm::dquat(0.8, 0.6, 0.0, 0.0), unit_unchecked());
    add(
        table, "bones::layers::whole_turn(part, weight)",
        [](const glm::dquat& given, double by) { return whole_turn(given, by); }, part, weight)
        .costs("O(1)");
    add(
        table, "bones::layers::has_whole_turn(part, weight)",
        [](const glm::dquat& given, double by) { return has_whole_turn(given, by); }, part,
        arg("weight", 0.5, any_at_rest("any; false for NaN")))
        .costs("O(1)");
    add(
        table, "bones::layers::overridden(base, source, weight, channels)",
        [](const Transform& base, const Transform& source, double by) {
            return overridden(base, source, by, 7);
        },
        transform("base"), transform("source"), weight)
        .costs("O(1)");
    add(
        table, "bones::layers::added(base, source, reference, weight, channels)",
        [](const Transform& base, const Transform& source, const Transform& reference, double by) {
            return added(base, source, reference, by, 7);
        },
        transform("base"), transform("source"), transform("reference"), weight)
        .costs("O(1)");
    add(
        table, "bones::layers::between_transforms(base, result)",
        [](const Transform& base, const Transform& result) { return between_transforms(base, result); },
        transform("base"), transform("result"))
        .costs("O(1)");
    const Numbers numbers{0.5, 0.2, 0.1, 0.3};
    const Domain any_numbers = partly_passed();
    add(table, "bones::layers::angle_count(mode)", [] { return angle_count(Rotation::xyz); }).costs("O(1)");
    for (const Rotation mode : {Rotation::quaternion, Rotation::xyz, Rotation::axis_angle}) {
        add(
            table, "bones::layers::rotation_of(mode, numbers)",
            [mode](const Numbers& given) { return rotation_of(mode, given); },
            arg("numbers", numbers, any_numbers))
            .costs("O(1)");
        add(
            table, "bones::layers::with_laps(mode, numbers, lap, laps)",
            [mode](const Numbers& given, const Numbers& lap, double laps) {
                return with_laps(mode, given, lap, laps);
            },
            arg("numbers", numbers, any_numbers), arg("lap", numbers, any_numbers),
            arg("laps", 2.0, any_numbers))
            .costs("O(1)");
        add(
            table, "bones::layers::Spin::turn(share)",
            [mode](double share) {
                return Spin{mode, {0.5, 0.2, 0.1, 0.3}, {0.9, 0.2, 0.1, 0.3}}.turn(share);
            },
            arg("share", 0.5, any_numbers))
            .costs("O(1)");
    }
}

}  // namespace

void add_layers(Table& table) {
    add_fcurves(table);
    add_clips(table);
    add_stacks(table);
    add_transforms(table);
}

}  // namespace motus::contracts
