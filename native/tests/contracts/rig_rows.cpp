#include "contracts/rigs.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/bones/ik/floor.hpp"
#include "motus/bones/ik/ik.hpp"
#include "motus/bones/look_at/eyes.hpp"
#include "motus/bones/look_at/plan.hpp"

namespace motus::contracts {

template <Some<bones::ik::ChainDiagnostics> T>
auto fields(Declared, T& v) {
    return std::tie(v.residual, v.angle, v.iterations, v.distance, v.reach, v.tip);
}
template <Some<bones::look_at::GazeDiagnostics> T>
auto fields(Declared, T& v) {
    return std::tie(v.angle, v.yaw, v.pitch);
}
template <Some<bones::look_at::GazeStep> T>
auto fields(Declared, T& v) {
    return std::tie(v.by);
}
template <Some<bones::look_at::Turns> T>
auto fields(Declared, T& v) {
    return std::tie(v.body, v.head, v.eyes, v.residual);
}

namespace {

namespace ik = bones::ik;
namespace look_at = bones::look_at;
using bones::RigView;

const std::vector<int> flags(4, 24);
const std::vector<float> lengths(4, 1.0F);
const std::vector<int> parents = sample_parents();
const std::vector<float> matrices = sample_matrices(), own = sample_basis();

[[nodiscard]] RigView sample_rig() {
    return {{parents, matrices, matrices, own, lengths, flags}};
}
[[nodiscard]] const ik::ChainPlan& sample_plan() {
    static const ik::ChainPlan made(parents, {{{1, 2}, 3}}, {});
    return made;
}
/// Which of the bones is wrong, the message of another argument may say.
[[nodiscard]] Domain someone(std::string says) {
    return {std::move(says), [](const Domain::Seen&) { return Verdict::open; }};
}
[[nodiscard]] Domain rests() {
    return any_at_rest("any; a chain with a number that is not finite stays at rest, without a reason");
}

/// The arguments of a solve that are no spans.
struct Solve {
    std::vector<ik::ChainSettings> settings{{}};
    std::vector<float> poses = matrices;
    glm::dmat4 world{1.0};
    std::vector<glm::dmat4> targets{
        {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 2.0, 0.3, 1.0}};
    std::vector<glm::dvec3> poles{{0.0, 2.0, 3.0}};
};
[[nodiscard]] ik::ChainInput input_of(const Solve& given) {
    static const ik::AnimatedBones made(sample_plan(), ik::RestBones(sample_plan(), sample_rig()), own);
    return {made, given.poses, given.world, given.settings, given.targets, given.poles, {}};
}
[[nodiscard]] auto solve_arguments() {
    const auto setting = [](const char* name, auto ik::ChainSettings::*pointer) {
        return TypedSlot<Solve>{{name, rests(), {}, false},
                                [=](Solve& solve, std::vector<Place>& all) {
                                    for (ik::ChainSettings& one : solve.settings)
                                        all.emplace_back(Place::Pointer(&(one.*pointer)));
                                },
                                [](Solve&) { return std::size_t{1}; },
                                [](Solve&, int) { return false; }};
    };
    return of(
        Solve{}, member("world", &Solve::world, rests()),
        member("targets", &Solve::targets, rests(), as_many_as("the chains")),
        member("poles", &Solve::poles, any_at_rest("any; NaN: no pole"), as_many_as("the chains")),
        member("poses", &Solve::poses, rests(), as_many_as("the bones' matrices")),
        setting("position_weight", &ik::ChainSettings::position_weight),
        setting("rotation_weight", &ik::ChainSettings::rotation_weight),
        setting("softness", &ik::ChainSettings::softness), setting("stretch", &ik::ChainSettings::stretch),
        setting("volume", &ik::ChainSettings::volume), setting("pole_angle", &ik::ChainSettings::pole_angle),
        setting("bend", &ik::ChainSettings::bend), setting("hinge_angle", &ik::ChainSettings::hinge_angle),
        setting("tolerance", &ik::ChainSettings::tolerance),
        setting("max_iterations", &ik::ChainSettings::max_iterations),
        setting("left_out", &ik::ChainSettings::left_out));
}

}  // namespace

void add_ik(Table& table) {
    const Domain lifts_nothing = any_at_rest("any; a floor with a number that is not finite lifts nothing");
    add(
        table, "bones::ik::above_floor(target, floor)",
        [](const glm::dvec3& target, const ik::Floor& floor) { return ik::above_floor(target, floor); },
        arg("target", glm::dvec3(0.3, 0.2, -1.0),
            Domain{"any; the same if it is not finite",
                   [](const Domain::Seen&) { return Verdict::unbounded; }}),
        of(ik::Floor{{0.0, 0.0, 0.1}, {0.0, 0.6, 0.8}, 0.1, 0.2},
           member("place", &ik::Floor::place, lifts_nothing), member("up", &ik::Floor::up, lifts_nothing),
           member("height", &ik::Floor::height, lifts_nothing),
           member("margin", &ik::Floor::margin, lifts_nothing)))
        .costs("O(1)");
    add(
        table, "bones::ik::ChainPlan::ChainPlan(parents, chains, guards)",
        [](const auto& above, const auto& chain, int effector, int guard, int of_chain) {
            return ik::ChainPlan(above, {{chain, effector}}, {{guard, of_chain}}).chain_count();
        },
        arg("parents", parents, parent(4)),
        arg("chains", std::vector<int>{1, 2}, someone("index of a bone, each the child of the one before")),
        arg("effectors", 3, someone("index of a bone: the last, or its child")),
        arg("guards", 3, index(4, "a bone whose parent is one of the chain").open()),
        arg("guards", 0, index(1, "a chain")))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    add(
        table, "bones::ik::ChainPlan::chain(index, left_out)",
        [](std::size_t index, std::size_t left_out) {
            return sample_plan().chain(index, left_out).bones.size();
        },
        arg("index", std::size_t{0}, index(1, "a chain")),
        arg("left_out", std::size_t{1}, any_at_rest("any")))
        .costs("O(1)");
    add(
        table, "bones::ik::RestBones::RestBones(plan, rig)",
        [](const auto& rest, const auto& sizes) {
            return ik::RestBones(sample_plan(), {{parents, rest, {}, {}, sizes, flags}}).is_of(sample_plan());
        },
        arg("rest", matrices, any_at_rest("any"), as_many_as("the bones' matrices")),
        arg("lengths", lengths, any_at_rest("any"), as_many_as("the bones")))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    add(table, "bones::ik::RestBones::is_of(plan)", [] {
        return ik::RestBones().is_of(sample_plan());
    }).costs("O(1)");
    add(
        table, "bones::ik::AnimatedBones::AnimatedBones(plan, rest, basis)",
        [](const auto& basis) {
            return ik::AnimatedBones(sample_plan(), ik::RestBones(sample_plan(), sample_rig()), basis)
                .is_of(sample_plan());
        },
        arg("basis", own, any_at_rest("any"), as_many_as("the bones' matrices")))
        .costs("O(bones)")
        .allocates(Memory::scratch)
        .adds("`rest` is of the plan");
    add(table, "bones::ik::AnimatedBones::is_of(plan)", [] {
        return ik::AnimatedBones().is_of(sample_plan());
    }).costs("O(1)");
    add(
        table, "bones::ik::solve(plan, input, output)",
        [](const Solve& given, auto rotations, auto scales, auto report) {
            solve(sample_plan(), input_of(given), {rotations, scales, report});
        },
        solve_arguments(), out<glm::dquat>("rotations", sample_plan().rows().size(), "the rows"),
        out<glm::dvec3>("scales", sample_plan().rows().size(), "the rows"),
        out<ik::ChainDiagnostics>("report", 1, "the chains"))
        .costs("as the solvers of chains")
        .allocates(Memory::scratch);
    add(
        table, "bones::ik::match(plan, input, targets, poles)",
        [](const Solve& given, auto targets, auto poles) {
            match(sample_plan(), input_of(given), targets, poles);
        },
        of(Solve{},
           member("world", &Solve::world,
                  any_passed_on()
                      .in_words("any; a chain that is not finite has the identity and a pole of NaN")
                      .unbounded()),
           member("poses", &Solve::poses, {"any", [](const Domain::Seen&) { return Verdict::unbounded; }},
                  as_many_as("the bones' matrices"))),
        out<glm::dmat4>("targets", 1, "the chains"), out<glm::dvec3>("poles", 1, "the chains"))
        .costs("O(bones)")
        .allocates(Memory::scratch)
        .infinite();
    const auto moved = [&](const char* type, const char* says, auto check) {
        table.moved.push_back({type, says, check});
    };
    moved("bones::ik::ChainPlan", "of no bones", [] {
        ik::ChainPlan from(parents, {{{1, 2}, 3}}, {});
        const ik::ChainPlan taken = std::move(from);
        // NOLINTBEGIN(bugprone-use-after-move)
        expect(from.chain_count() == 0 && from.rows().empty() && from.parents().empty(), "is empty");
        expect_refusal([&] { (void)from.chain(0); });
        expect(!ik::RestBones().is_of(from), "has no rests");
        expect_refusal([&] { (void)ik::RestBones(from, sample_rig()); });
        // NOLINTEND(bugprone-use-after-move)
        from = taken;
        expect(from.chain_count() == 1, "is assigned");
    });
    moved("bones::ik::RestBones", "of no plan", [] {
        ik::RestBones from(sample_plan(), sample_rig());
        const ik::RestBones taken = std::move(from);
        // NOLINTNEXTLINE(bugprone-use-after-move)
        expect(!from.is_of(sample_plan()) && from.rows().empty() && taken.is_of(sample_plan()),
               "is of no plan");
        expect_refusal([&] { (void)ik::AnimatedBones(sample_plan(), from, own); });
        from = taken;
        expect(from.is_of(sample_plan()), "is assigned");
    });
    moved("bones::ik::AnimatedBones", "of no plan", [] {
        ik::AnimatedBones from(sample_plan(), ik::RestBones(sample_plan(), sample_rig()), own);
        const ik::AnimatedBones taken = std::move(from);
        // NOLINTNEXTLINE(bugprone-use-after-move)
        expect(!from.is_of(sample_plan()) && from.rows().empty() && taken.is_of(sample_plan()),
               "is of no plan");
        from = taken;
        expect(from.is_of(sample_plan()), "is assigned");
    });
}

void add_look_at(Table& table) {
    using look_at::GazeChart;
    using look_at::GazeSettings;
    using look_at::SideLimits;
    const glm::dvec3 ahead(0.0, 1.0, 0.0), up(0.0, 0.0, 1.0);
    static const GazeChart chart(ahead, up);
    const Domain part{"unit, not checked; what a NaN is a part of is NaN",
                      [](const Domain::Seen&) { return Verdict::unbounded; }};
    const Domain place{"any; what a NaN is a part of is NaN",
                       [](const Domain::Seen&) { return Verdict::unbounded; }};
    add(
        table, "bones::look_at::GazeChart::GazeChart(forward, up, level)",
        [](const glm::dvec3& forward, const glm::dvec3& above) {
            return GazeChart(forward, above).direction({0.1, 0.2});
        },
        arg("forward", ahead, part), arg("up", up, place))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazeChart::place(direction)",
        [](const glm::dvec3& to) { return chart.place(to); },
        arg("direction", glm::dvec3(0.6, 0.8, 0.0), part))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazeChart::yaw_pitch(direction)",
        [](const glm::dvec3& to) { return chart.yaw_pitch(to); },
        arg("direction", glm::dvec3(0.6, 0.8, 0.0), part))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazeChart::direction(place)",
        [](const glm::dvec2& at) { return chart.direction(at); }, arg("place", glm::dvec2(0.3, 0.2), place))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazeChart::level(place)",
        [](const glm::dvec2& at) { return chart.level(at); }, arg("place", glm::dvec2(0.3, 0.2), place))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazeChart::turn(from, to)",
        [](const glm::dvec2& first, const glm::dvec2& to) { return chart.turn(first, to); },
        arg("from", glm::dvec2(0.3, 0.2), place), arg("to", glm::dvec2(-0.3, 0.1), place))
        .costs("O(1)");
    const auto settings = of(GazeSettings{}, member("weight", &GazeSettings::weight, place),
                             member("body_weight", &GazeSettings::body_weight, place),
                             member("head_weight", &GazeSettings::head_weight, place),
                             member("eyes_weight", &GazeSettings::eyes_weight, place),
                             member("clamp", &GazeSettings::clamp, place),
                             member("body_limit", &GazeSettings::body_limit, place),
                             member("head_limit", &GazeSettings::head_limit, place),
                             member("eyes_limit", &GazeSettings::eyes_limit, place));
    add(
        table, "bones::look_at::level_for(settings)",
        [](const GazeSettings& given) { return static_cast<int>(level_for(given)); }, settings)
        .costs("O(1)");
    const auto start = arg("from", glm::dvec2(0.1, 0.0), place),
               target = arg("target", glm::dvec2(0.7, 0.3), place);
    add(
        table, "bones::look_at::limited_turn(from, turn, limit, target)",
        [](const glm::dvec2& at, const glm::dvec2& turn, double limit, const glm::dvec2& to) {
            return look_at::limited_turn(at, turn, limit, to);
        },
        start, arg("turn", glm::dvec2(0.6, 0.3), place), arg("limit", 0.5, place), target)
        .costs("O(1)");
    add(
        table, "bones::look_at::gaze_goal(animated, target, settings)",
        [](const glm::dvec2& at, const glm::dvec2& to, const GazeSettings& given) {
            return look_at::gaze_goal(at, to, given);
        },
        arg("animated", glm::dvec2(0.1, 0.0), place), target, settings)
        .costs("O(1)");
    add(
        table, "bones::look_at::side_limited_turn(from, turn, sides, target)",
        [](const glm::dvec2& at, const glm::dvec2& turn, const SideLimits& given, const glm::dvec2& to) {
            return look_at::side_limited_turn(at, turn, given, to);
        },
        start, arg("turn", glm::dvec2(0.6, 0.3), place),
        of(SideLimits{0.5, 0.4, 0.3, 0.2}, member("left", &SideLimits::left, place),
           member("right", &SideLimits::right, place), member("up", &SideLimits::up, place),
           member("down", &SideLimits::down, place)),
        target)
        .costs("O(1)");
    add(
        table, "bones::look_at::gaze_share(present, goal, target, part)",
        [](const glm::dvec2& present, const glm::dvec2& goal, const glm::dvec2& to,
           const look_at::GazePart& given) {
            return look_at::gaze_share(present, {goal, false}, to, given);
        },
        arg("present", glm::dvec2(0.1, 0.0), place), arg("goal", glm::dvec2(0.6, 0.3), place), target,
        of(look_at::GazePart{0.5, 0.5}, member("weight", &look_at::GazePart::weight, place),
           member("limit", &look_at::GazePart::limit, place)))
        .costs("O(1)");
    add(
        table, "bones::look_at::turns_to(chart, animated, target, settings)",
        [](const glm::dvec3& animated, const glm::dvec3& to, const GazeSettings& given) {
            return turns_to(chart, animated, to, given);
        },
        arg("animated", ahead, part), arg("target", glm::dvec3(0.6, 0.8, 0.0), part), settings)
        .costs("O(1)");
    const Domain moment = any_at_rest("any; 0 if it is not finite");
    using look_at::Saccades;
    add(
        table, "bones::look_at::saccade(saccades, seconds)",
        [](const Saccades& given, double seconds) { return look_at::saccade(given, seconds); },
        of(Saccades{0.1, 2.0, 3}, member("amplitude", &Saccades::amplitude, moment),
           member("rate", &Saccades::rate, moment)),
        arg("seconds", 1.3, moment))
        .costs("O(1)");
    add(
        table, "bones::look_at::blink(since)", [](double since) { return look_at::blink(since); },
        arg("since", 0.2, moment))
        .costs("O(1)");
    add(
        table, "bones::look_at::blinks(rate, seed, seconds)",
        [](double rate, double seconds) { return look_at::blinks(rate, 5, seconds); },
        arg("rate", 0.25, moment), arg("seconds", 1.3, moment))
        .costs("O(1)");
    add(
        table, "bones::look_at::GazePlan::GazePlan(parents, entries)",
        [](const auto& above, const auto& body, int head) {
            return look_at::GazePlan(above, std::vector<look_at::GazeBones>{{body, head, {}}}).size();
        },
        arg("parents", parents, parent(4)),
        arg("bodies", std::vector<int>{0, 1}, index(4, "a bone above the one before").open()),
        arg("heads", 2, index(4, "a bone above the body").open()))
        .costs("O(bones)")
        .allocates(Memory::scratch)
        .adds("`eyes`: above the head");
    static const look_at::GazePlan plan(parents, std::vector<look_at::GazeBones>{{{0, 1}, 2, {3}}});
    const Domain rest =
        any_at_rest("any; a head with a number that is not finite stays at rest, without a reason");
    using look_at::GazeInput;
    GazeInput good;
    good.target = {3.0, 5.0, 2.0};
    add(
        table, "bones::look_at::GazePlan::solve(rig, world, inputs, rotations, reports)",
        [](const auto& rested, const auto& posed, const auto& basis, const glm::dmat4& world,
           const GazeInput& input, const auto& eyes, auto rotations, auto reports) {
            GazeInput whole = input;
            whole.eyes_forward = eyes;
            plan.solve({{parents, rested, posed, basis, {}, flags}}, world, std::span(&whole, 1), rotations,
                       reports);
        },
        arg("rest", matrices, rest, as_many_as("the bones' matrices")),
        arg("poses", matrices, rest, as_many_as("the bones' matrices")),
        arg("basis", own, rest, as_many_as("the bones' matrices")), arg("world", glm::dmat4(1.0), rest),
        of(good, member("target", &GazeInput::target, rest),
           member("head_forward", &GazeInput::head_forward, rest), member("up", &GazeInput::up, rest),
           member("eyes_beside", &GazeInput::eyes_beside, rest)),
        arg("eyes_forward", std::vector<glm::dvec3>(1, up), rest, as_many_as("the eyes")),
        out<glm::dquat>("rotations", 4, "the rows"),
        out<look_at::GazeDiagnostics>("reports", 1, "the entries"))
        .costs("O(bones)");
    table.moved.push_back({"bones::look_at::GazePlan", "of no bones", [] {
                               look_at::GazePlan from = plan;
                               const look_at::GazePlan taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.size() == 0 && from.rows().empty() && from.eye_counts().empty(),
                                      "is empty");
                               from.solve({}, glm::dmat4(1.0), {}, {}, {});
                               from = taken;
                               expect(from.size() == 1, "is assigned");
                           }});
}

}  // namespace motus::contracts
