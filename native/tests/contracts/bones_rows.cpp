#include "contracts/rigs.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/bones/pose.hpp"
#include "motus/bones/products.hpp"
#include "motus/bones/space.hpp"
#include "motus/bones/tails.hpp"
#include "motus/bones/turns.hpp"

namespace motus::contracts {

template <Some<bones::ParentSpace> T>
auto fields(Declared, T& v) {
    return std::tie(v.rotation_scale, v.location, v.post_scale);
}
template <Some<bones::Rest> T>
auto fields(Declared, T& v) {
    return std::tie(v.matrix, v.parent_matrix);
}
template <Some<bones::Offset> T>
auto fields(Declared, T& v) {
    return std::tie(v.turn, v.head, v.parent_turn);
}
template <Some<bones::LinearSpace> T>
auto fields(Declared, T& v) {
    return std::tie(v.axes, v.post_scale);
}

namespace {

using namespace bones;

/// Of poses and axes: they are not checked, and what they are a part of is not finite if they are not.
[[nodiscard]] Domain passed() {
    return any_passed_on();
}
/// The same where not all numbers are parts of the result.
[[nodiscard]] Domain partly_passed() {
    return {"any; what a NaN is a part of is NaN", [](const Domain::Seen&) { return Verdict::unbounded; }};
}
const glm::dquat none(1.0, 0.0, 0.0, 0.0);
const glm::dmat4 pose_of_parent(0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3, 0.2, 0.1,
                                1.0);

[[nodiscard]] Rest sample_bone(InheritScale scale) {
    Rest bone;
    bone.matrix[3] = glm::dvec4(0.0, 1.0, 0.5, 1.0);
    bone.has_parent = true;
    bone.inherit_scale = scale;
    return bone;
}

void add_spaces(Table& table) {
    for (int scale = 0; scale < 6; ++scale) {
        const Rest bone = sample_bone(static_cast<InheritScale>(scale));
        add(
            table, "bones::parent_space(bone, parent_pose)",
            [](const Rest& given, const glm::dmat4& pose) { return parent_space(given, pose); },
            of(bone, member("bone", &Rest::matrix, partly_passed()),
               member("bone", &Rest::parent_matrix, partly_passed())),
            arg("parent_pose", pose_of_parent, partly_passed()))
            .costs("O(1)");
        add(
            table, "bones::special_space(bone, parent_pose)",
            [bone](const glm::dmat3& pose) { return special_space(offset_of(bone), pose); },
            arg("parent_pose", glm::dmat3(pose_of_parent), partly_passed()))
            .costs("O(1)");
        add(
            table, "bones::linear_space(bone, parent_pose)",
            [bone](const glm::dmat3& pose) { return linear_space(offset_of(bone), pose); },
            arg("parent_pose", glm::dmat3(pose_of_parent), partly_passed()))
            .costs("O(1)");
    }
    static const ParentSpace space = parent_space(sample_bone(InheritScale::aligned), pose_of_parent);
    add(
        table, "bones::to_pose(space, basis)", [](const glm::dmat4& basis) { return to_pose(space, basis); },
        arg("basis", glm::dmat4(1.0), partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::to_basis(space, pose)", [](const glm::dmat4& pose) { return to_basis(space, pose); },
        arg("pose", pose_of_parent, partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::offset_of(bone)", [](const Rest& bone) { return offset_of(bone); },
        of(sample_bone(InheritScale::full), member("bone", &Rest::matrix, partly_passed()),
           member("bone", &Rest::parent_matrix, partly_passed())))
        .costs("O(1)");
    add(table, "bones::is_plain(bone)", [] { return is_plain(Offset{}); }).costs("O(1)");
    add(
        table, "bones::scaled(axes, scale)",
        [](const glm::dmat3& axes, const glm::dvec3& scale) { return scaled(axes, scale); },
        arg("axes", glm::dmat3(1.0), passed()), arg("scale", glm::dvec3(1.0), passed()))
        .costs("O(1)");
    add(
        table, "bones::without_shear(axes, unit)",
        [](const glm::dmat3& axes) { return without_shear(axes, true); },
        arg("axes", glm::dmat3(pose_of_parent), partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::inverse_axes(axes)", [](const glm::dmat3& axes) { return inverse_axes(axes); },
        arg("axes", glm::dmat3(pose_of_parent), partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::inverse_of_flat(axes)", [](const glm::dmat3& axes) { return inverse_of_flat(axes); },
        arg("axes", glm::dmat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0), partly_passed()))
        .costs("O(1)");
}

void add_turns(Table& table) {
    const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
    const Domain unit_vector = partly_passed().in_words("unit, not checked");
    const glm::dquat quarter(0.8, 0.6, 0.0, 0.0);
    add(
        table, "bones::handedness(axes)", [](const glm::dmat3& axes) { return handedness(axes); },
        arg("axes", glm::dmat3(1.0), partly_passed().in_words("any; 1 for NaN")))
        .costs("O(1)");
    add(
        table, "bones::angle_between(a, b)",
        [](const glm::dvec3& a, const glm::dvec3& b) { return angle_between(a, b); },
        arg("a", x, partly_passed()), arg("b", y, partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::half_turn_to(from, to, axis)",
        [](const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis) {
            return half_turn_to(from, to, axis);
        },
        arg("from", x, unit_vector), arg("to", -x, unit_vector), arg("axis", z, unit_vector))
        .costs("O(1)");
    add(
        table, "bones::smallest_turn(from, to, axis)",
        [](const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis) {
            return smallest_turn(from, to, axis);
        },
        arg("from", x, unit_vector), arg("to", y, unit_vector), arg("axis", z, unit_vector))
        .costs("O(1)");
    add(
        table, "bones::smallest_turn_between(from, to, axis)",
        [z](const glm::dvec3& from, const glm::dvec3& to) {
            return smallest_turn_between(from, to, [&] { return z; });
        },
        arg("from", x, partly_passed()), arg("to", y, partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::inverse_root_near_one(square)",
        [](double square) { return inverse_root_near_one(square); },
        arg("square", 1.0, partly_passed().in_words("near 1, not checked")))
        .costs("O(1)");
    add(
        table, "bones::normalized_product(product)",
        [](const glm::dquat& product) { return normalized_product(product); },
        arg("product", quarter, unit_vector))
        .costs("O(1)");
    add(
        table, "bones::share_of_turn(turn, weight)",
        [](const glm::dquat& turn, double weight) { return share_of_turn(turn, weight); },
        arg("turn", quarter, unit_vector), arg("weight", 0.5, any()))
        .costs("O(1)");
    add(
        table, "bones::between(a, b, weight)",
        [](const glm::dquat& a, const glm::dquat& b, double weight) { return between(a, b, weight); },
        arg("a", none, unit_vector), arg("b", quarter, unit_vector), arg("weight", 0.5, any()))
        .costs("O(1)");
    add(
        table, "bones::angle_of_turn(turn)", [](const glm::dquat& turn) { return angle_of_turn(turn); },
        arg("turn", quarter, unit_vector))
        .costs("O(1)");
    add(
        table, "bones::frame_of(axes)", [](const glm::dmat3& axes) { return frame_of(axes); },
        arg("axes", glm::dmat3(pose_of_parent), partly_passed()))
        .costs("O(1)");
    add(
        table, "bones::frame_of(axes, y, z)",
        [](const glm::dmat3& axes, const glm::dvec3& along, const glm::dvec3& up) {
            return frame_of(axes, along, up);
        },
        arg("axes", glm::dmat3(1.0), partly_passed()), arg("y", y, unit_vector), arg("z", z, unit_vector))
        .costs("O(1)");
}

void add_arrays(Table& table) {
    add(
        table, "bones::euler_xyz(rotation)", [](const glm::dquat& rotation) { return euler_xyz(rotation); },
        arg("rotation", none, partly_passed().in_words("unit quaternion, not checked")))
        .costs("O(1)");
    add(
        table, "bones::pack_matrices(locations, rotations, out, scales)",
        [](const auto& locations, const auto& rotations, auto found, const auto& scales) {
            pack_matrices(locations, rotations, found, scales);
        },
        arg("locations", std::vector<glm::dvec3>(2, glm::dvec3(1.0)), passed(), as_many_as("`out` / 16")),
        arg("rotations", std::vector<glm::dquat>(2, none), passed(), as_many_as("`locations`")),
        out<float>("out", 32, "16 times `locations`"),
        arg("scales", std::vector<glm::dvec3>(2, glm::dvec3(1.0)), passed(), as_many_or_none("`locations`")))
        .costs("O(n)");
    const Domain turned = any_at_rest("any; a link that is not finite turns with the one above");
    add(
        table, "bones::turn_links(before, after, turns)",
        [](const auto& before, const auto& after, auto found) { turn_links(before, after, found); },
        arg("before", std::vector<glm::dvec3>(2, glm::dvec3(0.0, 1.0, 0.0)), turned),
        arg("after", std::vector<glm::dvec3>(2, glm::dvec3(0.0, 0.0, 1.0)), turned, as_many_as("`before`")),
        out<glm::dquat>("turns", 2, "`before`"))
        .costs("O(links)");
    add(
        table, "bones::multiply(left, right, size, out)",
        [](const auto& left, const auto& right, auto found) {
            multiply(left, right, {3, 4}, found);
        },
        arg("left", std::vector<double>(18, 1.0), passed(),
            {Size::Rule::exactly, 0, "square matrices, one or one for each product", false}),
        arg("right", std::vector<double>(24, 1.0), passed(),
            {Size::Rule::exactly, 0, "matrices of `size`, one or one for each product", false}),
        out<double>("out", 24, "the products"))
        .costs("O(rows² columns) a product");
    add(
        table, "bones::matrix_at(matrices, bone)",
        [](const auto& matrices, std::size_t bone) { return matrix_at(matrices, bone); },
        arg("matrices", std::vector<float>(32, 1.0F), partly_passed()),
        arg("bone", std::size_t{1}, index(2, "a matrix").open()))
        .costs("O(1)");
    add(
        table, "bones::RigView::RigView(arrays)",
        [](const auto& parents, const auto& rest, const auto& poses, const auto& basis, const auto& lengths,
           const auto& inheritance) {
            return RigView({parents, rest, poses, basis, lengths, inheritance}).size();
        },
        arg("parents", sample_parents(), parent(4).in_words("-1, or index of a bone")),
        arg("rest", sample_matrices(), any_at_rest("any"), as_many_as("the bones' matrices")),
        arg("poses", sample_matrices(), any_at_rest("any"), as_many_or_none("the bones' matrices")),
        arg("basis", sample_basis(), any_at_rest("any"), as_many_or_none("the bones' matrices")),
        arg("lengths", std::vector<float>(4, 1.0F), any_at_rest("any"), as_many_or_none("the bones")),
        arg("inheritance", std::vector<int>(4, 24), any_at_rest("flags"), as_many_as("the bones")))
        .costs("O(bones)");
    add(
        table, "bones::rest_of(rig, bone)",
        [](const auto& rest, std::size_t bone) {
            static const std::vector<int> inheritance(4, 24), parents = sample_parents();
            return rest_of({{parents, rest, {}, {}, {}, inheritance}}, bone);
        },
        arg("rest", sample_matrices(), partly_passed()),
        arg("bone", std::size_t{1}, index(4, "a bone").open()))
        .costs("O(1)");
}

void add_tails(Table& table) {
    add(
        table, "bones::TailPlan::TailPlan(parents, bones)",
        [](const auto& parents, const auto& which) { return TailPlan(parents, which).size(); },
        arg("parents", sample_parents(), parent(4)),
        arg("bones", std::vector<int>{1, 2}, index(4, "a bone; each once").open()))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    static const TailPlan plan(sample_parents(), std::vector<int>{1, 2});
    const Domain rests = any_at_rest("any; bones of which a number is not finite stay at rest");
    add(
        table, "bones::TailPlan::solve(rig, world, targets, weights, rotations)",
        [](const auto& rest, const auto& poses, const auto& basis, const glm::dmat4& world,
           const auto& targets, const auto& weights, auto rotations) {
            const std::vector<int> parents = sample_parents(), inheritance(4, 24);
            const std::vector<float> lengths(4, 1.0F);
            plan.solve({{parents, rest, poses, basis, lengths, inheritance}}, world, targets, weights,
                       rotations);
        },
        arg("rest", sample_matrices(), rests, as_many_as("the bones' matrices")),
        arg("poses", sample_matrices(), rests, as_many_as("the bones' matrices")),
        arg("basis", sample_basis(), rests, as_many_as("the bones' matrices")),
        arg("world", glm::dmat4(1.0), rests),
        arg("targets", std::vector<glm::dvec3>(2, glm::dvec3(1.0, 2.0, 3.0)), rests, as_many_as("the bones")),
        arg("weights", std::vector<double>(2, 0.5), rests, as_many_as("the bones")),
        out<glm::dquat>("rotations", 2, "the bones"))
        .costs("O(bones)")
        .allocates(Memory::scratch);
    table.moved.push_back({"bones::TailPlan", "of no bones", [] {
                               TailPlan from = plan;
                               const TailPlan taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.size() == 0 && from.parents().empty() && taken.size() == 2,
                                      "is empty");
                               from.solve({}, glm::dmat4(1.0), {}, {}, {});
                               from = taken;
                               expect(from.size() == 2, "is assigned");
                           }});
}

}  // namespace

void add_bones(Table& table) {
    add_spaces(table);
    add_turns(table);
    add_arrays(table);
    add_tails(table);
}

}  // namespace motus::contracts
