#include "motus/mesh/picker.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <stdexcept>

#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

namespace motus::mesh {
namespace {

// Elements that are worth a thread.
constexpr std::size_t vertex_grain = 8192, triangle_grain = 8192;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

PickerPoint point_of(const glm::vec3& p) noexcept {
    return is_finite(p) ? PickerPoint{p.x, p.y, p.z, 0.0f}
                        : PickerPoint{not_a_number, not_a_number, not_a_number, not_a_number};
}

/// Whether it is one of a vertex that was finite.
bool is_somewhere(const PickerPoint& point) noexcept {
    return !std::isnan(point[0]);
}

void check_input(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                 const Executor& executor) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() - fan_out;
    require(positions.size() < most, "positions: must be fewer than 2^32 - 1");
    require(triangles.size() < most, "triangles: must be fewer than 2^32 - 1");
    const auto check = [&](std::size_t first, std::size_t last) {
        // Negative ones are very large without a sign.
        std::uint32_t largest = 0;
        for (const glm::ivec3& t : triangles.subspan(first, last - first))
            largest = std::max({largest, static_cast<std::uint32_t>(t.x), static_cast<std::uint32_t>(t.y),
                                static_cast<std::uint32_t>(t.z)});
        if (largest >= positions.size())
            throw std::invalid_argument("triangles: one names a vertex that the mesh does not have");
    };
    in_parts(triangles.size(), triangle_grain, check, executor);
}

}  // namespace

void Picker::Tree::sort_in(std::span<const glm::ivec3> triangles) {
    const auto corners_of = [&](std::size_t triangle) -> Corners {
        const glm::ivec3& t = triangles[triangle];
        return {places[static_cast<std::size_t>(t.x)], places[static_cast<std::size_t>(t.y)],
                places[static_cast<std::size_t>(t.z)]};
    };
    const std::size_t leaves = points.size() / fan_out;
    Array<Keyed> keyed(triangles.size());
    const auto find_leaves = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            // The middle one of the corners: a vertex that many triangles share, as the hub of a fan, is
            // hardly ever between the two others.
            const auto [a, b, c] = corners_of(i);
            const std::uint32_t middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
            keyed[i] = Keyed{middle / fan_out} << 32 | i;
        }
    };
    in_parts(triangles.size(), triangle_grain, find_leaves, executor);
    sort_by_key(keyed, static_cast<int>(std::bit_width(leaves)), executor);

    starts = Array<std::uint32_t>(leaves + 1);
    names = Array<std::uint32_t>(triangles.size());
    corners = Array<Corners>(triangles.size());
    const auto take_over = [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            names[slot] = static_cast<std::uint32_t>(keyed[slot]);
            corners[slot] = corners_of(names[slot]);
            const std::size_t leaf_before = slot == 0 ? 0 : (keyed[slot - 1] >> 32) + 1;
            for (std::size_t leaf = leaf_before; leaf <= keyed[slot] >> 32; ++leaf)
                starts[leaf] = static_cast<std::uint32_t>(slot);
        }
    };
    in_parts(triangles.size(), triangle_grain, take_over, executor);
    const std::size_t leaf_after = keyed.empty() ? 0 : (keyed.back() >> 32) + 1;
    std::fill(starts.begin() + static_cast<std::ptrdiff_t>(leaf_after), starts.end(),
              static_cast<std::uint32_t>(triangles.size()));
}

template <class Use>
void Picker::Tree::with_leaf_boxes(const Use& use) {
    const auto with = [&](PickerBoxes& boxes, LeafKernel::Boxes kernel) {
        use(boxes, [of = leaves(), kernel](std::size_t first, std::size_t last, PickerBox* out) {
            kernel(of, first, last, out);
        });
    };
    const LeafKernel& kernel = leaf_kernels().back();
    with(around_vertices, kernel.around_vertices);
    with(around_triangles, kernel.around_triangles);
}

void Picker::Tree::refit() {
    with_leaf_boxes(
        [this](PickerBoxes& boxes, const auto& leaf_boxes) { boxes.refit(leaf_boxes, executor); });
}

void Picker::Tree::refit_touching(const PickerBox& box) {
    with_leaf_boxes(
        [&box](PickerBoxes& boxes, const auto& leaf_boxes) { boxes.refit_touching(box, leaf_boxes); });
}

Picker::Picker(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
               const Executor& executor)
    : tree_(std::make_unique<Tree>()) {
    check_input(positions, triangles, executor);
    tree_->executor = executor;
    tree_->order = hilbert_order(positions, executor);
    tree_->places = Array<std::uint32_t>(positions.size());
    for (std::size_t place = 0; place < positions.size(); ++place)
        tree_->places[tree_->order[place]] = static_cast<std::uint32_t>(place);
    tree_->points = Array<PickerPoint>((positions.size() + fan_out - 1) / fan_out * fan_out);
    std::fill(tree_->points.begin() + static_cast<std::ptrdiff_t>(positions.size()), tree_->points.end(),
              point_of(glm::vec3(not_a_number)));
    tree_->sort_in(triangles);
    const std::size_t leaves = tree_->points.size() / fan_out;
    tree_->around_vertices = PickerBoxes(leaves);
    tree_->around_triangles = PickerBoxes(triangles.empty() ? 0 : leaves);
    refit(positions);
}

Picker::~Picker() = default;
Picker::Picker(Picker&&) noexcept = default;
Picker& Picker::operator=(Picker&&) noexcept = default;

const Picker::Tree& Picker::tree() const noexcept {
    // Never destroyed: threads may ask while the process ends.
    alignas(Tree) static std::array<std::byte, sizeof(Tree)> memory;
    static const Tree& of_nothing = *::new (memory.data()) Tree;
    return tree_ ? *tree_ : of_nothing;
}

std::size_t Picker::vertex_count() const noexcept {
    return tree().order.size();
}
std::size_t Picker::triangle_count() const noexcept {
    return tree().names.size();
}

void Picker::refit(std::span<const glm::vec3> positions) {
    if (positions.size() != vertex_count())
        throw std::invalid_argument("positions: there must be one for each vertex of the mesh");
    if (positions.empty()) return;
    std::atomic<bool> all_finite{true};
    const auto take_over = [&](std::size_t first, std::size_t last) {
        bool finite = true;
        for (std::size_t place = first; place < last; ++place) {
            tree_->points[place] = point_of(positions[tree_->order[place]]);
            finite = finite && is_somewhere(tree_->points[place]);
        }
        if (!finite) all_finite = false;
    };
    in_parts(positions.size(), vertex_grain, take_over, tree_->executor);
    tree_->all_finite = all_finite;
    tree_->refit();
}

void Picker::refit(std::span<const glm::vec3> positions, std::span<const std::uint32_t> moved) {
    if (positions.size() != vertex_count())
        throw std::invalid_argument("positions: there must be one for each vertex of the mesh");
    if (std::any_of(moved.begin(), moved.end(), [&](std::uint32_t v) { return v >= positions.size(); }))
        throw std::invalid_argument("moved: a vertex is not one of the mesh");
    if (positions.empty()) return;

    // A leaf that has to change touches the place where a vertex was. Vertices that follow each other along
    // the curve are near each other and have one box in common; other regions that moved have theirs.
    constexpr std::size_t together = 4096;
    std::vector<PickerBox> were(positions.size() / together + 1);
    bool were_finite = true;
    for (const std::uint32_t vertex : moved) {
        const std::uint32_t place = tree_->places[vertex];
        were_finite = were_finite && is_somewhere(tree_->points[place]);
        were[place / together].add(tree_->points[place]);
    }
    for (const std::uint32_t vertex : moved) {
        PickerPoint& point = tree_->points[tree_->places[vertex]];
        point = point_of(positions[vertex]);
        tree_->all_finite = tree_->all_finite && is_somewhere(point);
    }
    if (!were_finite) {
        // Nothing says which leaves have changed.
        tree_->refit();
        return;
    }
    for (const PickerBox& box : were)
        if (box.low[0] <= box.high[0]) tree_->refit_touching(box);
}

}  // namespace motus::mesh
