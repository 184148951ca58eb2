#include "contracts/row.hpp"
#include "motus/bones/chains/chain.hpp"
#include "motus/bones/chains/limited.hpp"
#include "motus/bones/chains/two_bone.hpp"

namespace motus::contracts {

template <Some<bones::chains::TwoBoneSolution> T>
auto fields(Declared, T& v) {
    return std::tie(v.elbow, v.tip, v.normal, v.scale, v.residual);
}
template <Some<bones::chains::Convergence> T>
auto fields(Declared, T& v) {
    return std::tie(v.residual, v.iterations);
}

namespace {

using namespace bones::chains;

[[nodiscard]] Domain length() {
    return at_least(0.0);
}
[[nodiscard]] Domain unchecked_length() {
    return {"≥ 0, not checked; NaN gives NaN", [](const Domain::Seen& seen) {
                if (std::isnan(seen.number())) return Verdict::nan_out;
                return seen.number() >= 0.0 && std::isfinite(seen.number()) ? Verdict::taken
                                                                            : Verdict::unbounded;
            }};
}
[[nodiscard]] Domain coordinate() {
    return up_to(1e300);
}

void add_two_bones(Table& table) {
    add(
        table, "bones::chains::triangle_angle(a, b, c)",
        [](double a, double b, double c) { return triangle_angle(a, b, c); }, arg("a", 1.0, length()),
        arg("b", 1.5, length()), arg("c", 1.2, length()))
        .costs("O(1)");
    add(
        table, "bones::chains::soft_reach(distance, reach, softness)",
        [](double distance, double reach, double softness) { return soft_reach(distance, reach, softness); },
        arg("distance", 1.0, unchecked_length()), arg("reach", 1.5, unchecked_length()),
        arg("softness", 0.1, any().in_words("any, brought into [0, `reach`]; NaN gives NaN")))
        .costs("O(1)");
    TwoBone good;
    good.target = {0.5, 1.2, 0.3};
    good.softness = 0.1;
    good.stretch = 0.5;
    add(
        table, "bones::chains::solve_two_bone(chain)",
        [](const TwoBone& chain) { return solve_two_bone(chain); },
        of(good, member("root", &TwoBone::root, finite()), member("target", &TwoBone::target, finite()),
           member("pole", &TwoBone::pole, finite()), member("plane", &TwoBone::plane, finite()),
           member("length1", &TwoBone::length1, length()), member("length2", &TwoBone::length2, length()),
           member("softness", &TwoBone::softness, finite()), member("stretch", &TwoBone::stretch, finite())))
        .costs("O(1), 70 ns");
    const std::vector<TwoBone> many(5, good);
    add(
        table, "bones::chains::solve_two_bones(chains, out)",
        [](const auto& chains, auto found) { solve_two_bones(chains, found); },
        of(many, each("root", &TwoBone::root, finite(), as_many_as("`out`")),
           each("target", &TwoBone::target, finite()), each("pole", &TwoBone::pole, finite()),
           each("plane", &TwoBone::plane, finite()), each("length1", &TwoBone::length1, length()),
           each("length2", &TwoBone::length2, length()), each("softness", &TwoBone::softness, finite()),
           each("stretch", &TwoBone::stretch, finite())),
        out<TwoBoneSolution>("out", 5, "`chains`"))
        .costs("O(n), 20 ns a chain");
}

[[nodiscard]] auto settings() {
    SolverSettings good;
    good.pole = {0.0, 1.0, 3.0};
    return of(good, member("tolerance", &SolverSettings::tolerance, length()),
              member("max_iterations", &SolverSettings::max_iterations, at_least(0.0).tested_to(1000.0)),
              member("pole", &SolverSettings::pole, coordinate()),
              member("plane", &SolverSettings::plane, finite()));
}
[[nodiscard]] std::vector<glm::dvec3> sample_joints() {
    return {{0.0, 0.0, 0.0}, {0.1, 1.0, 0.0}, {0.0, 2.0, 0.2}, {0.3, 3.0, 0.0}};
}

void add_chain(Table& table) {
    const auto target = arg("target", glm::dvec3(0.5, 1.8, 0.7), coordinate());
    add(
        table, "bones::chains::is_in_reach_of_doubles(place)",
        [](const glm::dvec3& place) { return is_in_reach_of_doubles(place); },
        arg("place", glm::dvec3(1.0), any_at_rest("any; false for NaN")))
        .costs("O(1)");
    add(
        table, "bones::chains::check(target, settings)",
        [](const glm::dvec3& at, const SolverSettings& given) { check(at, given); }, target, settings())
        .costs("O(1)");
    add(
        table, "bones::chains::solve(joints, target, settings)",
        [](const auto& given, const glm::dvec3& at, const SolverSettings& by) {
            std::vector<glm::dvec3> moved = given;
            const Convergence report = solve(moved, at, by);
            return std::pair(report, moved);
        },
        arg("joints", sample_joints(), coordinate(), {Size::Rule::any, 0, "2 to 256"}), target, settings())
        .costs("O(n) an iteration")
        .allocates(Memory::scratch)
        .adds("itself it allocates nothing");
}

[[nodiscard]] Domain unit_quaternion() {
    return unit(1e-3).in_words("unit quaternion, to 1e-3");
}

void add_limited(Table& table) {
    const Domain limit =
        numbers("each minimum ≤ its maximum", [](double x) { return !std::isnan(x); }).open();
    const JointLimits narrow{{-0.5, -0.3, -0.5}, {0.5, 0.3, 0.5}};
    const glm::dquat none(1.0, 0.0, 0.0, 0.0);
    add(
        table, "bones::chains::clamp_rotation(rotation, limits)",
        [](const glm::dquat& rotation, const JointLimits& limits) {
            return clamp_rotation(rotation, limits);
        },
        arg("rotation", glm::dquat(0.8, 0.6, 0.0, 0.0),
            {"unit, not checked", [](const Domain::Seen&) { return Verdict::unbounded; }}),
        of(narrow, member("limits", &JointLimits::min, limit.tested_to(1e6)),
           member("limits", &JointLimits::max, limit.tested_to(1e6))))
        .costs("O(1)");
    const auto rest =
        arg("rest", std::vector<glm::dquat>(3, none), unit_quaternion(), as_many_as("`offsets`"));
    const auto offsets = arg("offsets", std::vector<glm::dvec3>(3, glm::dvec3(0.0, 1.0, 0.0)), coordinate(),
                             {Size::Rule::exactly, 0, "1 to 255"});
    const auto root = arg("root", glm::dvec3(0.0), coordinate());
    const auto base = arg("base", none, unit_quaternion());
    add(
        table, "bones::chains::solve_limited(chain, target, settings, rotations, orientation)",
        [](const glm::dvec3& from, const glm::dquat& on, const auto& rests, const auto& along,
           const auto& limits, const glm::dvec3& target, const SolverSettings& by, const auto& start,
           const glm::dquat& orientation) {
            std::vector<glm::dquat> rotations = start;
            const Convergence report =
                solve_limited({from, on, rests, along, limits}, target, by, rotations, orientation);
            return std::pair(report, rotations);
        },
        root, base, rest, offsets,
        of(std::vector<JointLimits>(3, narrow),
           each("limits", &JointLimits::min, limit, as_many_as("`offsets`")),
           each("limits", &JointLimits::max, limit)),
        arg("target", glm::dvec3(0.5, 1.8, 0.7), coordinate()), settings(),
        arg("rotations", std::vector<glm::dquat>(3, none), unit_quaternion(), as_many_as("`offsets`")),
        arg("orientation", none, unit_quaternion()))
        .costs("O(n²) an iteration")
        .allocates(Memory::scratch)
        .adds("takes 250 KB of the stack; itself it allocates nothing");
    add(
        table, "bones::chains::joints_of(chain, rotations, joints)",
        [](const glm::dvec3& from, const glm::dquat& on, const auto& rests, const auto& along,
           const auto& rotations, auto joints) {
            joints_of({from, on, rests, along, {}}, rotations, joints);
        },
        root, base, rest,
        arg("offsets", std::vector<glm::dvec3>(3, glm::dvec3(0.0, 1.0, 0.0)), coordinate(),
            as_many_as("`rotations`")),
        arg("rotations", std::vector<glm::dquat>(3, none), unit_quaternion(), as_many_as("`offsets`")),
        out<glm::dvec3>("joints", 4, "`offsets`, and one"))
        .costs("O(n)");
    add(
        table, "bones::chains::bone_frames(joints, frames)",
        [](const auto& joints, auto frames) { bone_frames(joints, frames); },
        arg("joints", sample_joints(), coordinate(), as_many_as("`frames`, and one")),
        out<glm::dquat>("frames", 3, "`joints`, less one"))
        .costs("O(n)");
}

}  // namespace

void add_chains(Table& table) {
    add_two_bones(table);
    add_chain(table);
    add_limited(table);
}

}  // namespace motus::contracts
