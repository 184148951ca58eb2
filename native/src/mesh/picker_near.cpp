// Which vertices are near a point.
//
// Rounding is monotonic: the differences p - point of the vertices in a box lie between those of its corners,
// rounded as they are, and so do products and sums made in the same order. Bounds of boxes made this way hold
// to the last bit.
#include "picker_near.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "motus/core/instruction_sets.hpp"
#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "picker_near.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace motus::mesh::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// As many of a node's lanes at once as the instruction set has numbers.
constexpr hn::CappedTag<float, fan_out> as_numbers;
constexpr std::size_t at_once = hn::MaxLanes(as_numbers);
using Numbers = hn::Vec<decltype(as_numbers)>;

/// Least and greatest squared distance of anything in each lane's box.
struct Distances {
    Lanes least;
    Lanes most;
};

/// The least square of a number between low and high. Of NaN and a number, Max gives the number.
HWY_INLINE Numbers least_square(Numbers low, Numbers high) {
    const Numbers gap = hn::Max(hn::Max(low, hn::Neg(high)), hn::Zero(as_numbers));
    return gap * gap;
}
HWY_INLINE Numbers most_square(Numbers low, Numbers high) {
    const Numbers far = hn::Max(hn::Neg(low), high);
    return far * far;
}

/// Measures distances from a point in the space of the positions.
class Straight {
  public:
    explicit Straight(const glm::vec3& from) : from_(from) {}

    [[nodiscard]] float square(const PickerPoint& p) const noexcept {
        const float x = p[0] - from_.x, y = p[1] - from_.y, z = p[2] - from_.z;
        return x * x + y * y + z * z;
    }

    [[nodiscard]] Distances bounds(const PickerNode& node) const noexcept {
        Distances found{};
        for (std::size_t lanes = 0; lanes < fan_out; lanes += at_once) {
            Numbers least = hn::Zero(as_numbers), most = hn::Zero(as_numbers);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Numbers from = hn::Set(as_numbers, from_[static_cast<glm::length_t>(axis)]);
                const Numbers low = hn::LoadU(as_numbers, &node.low[axis][lanes]) - from;
                const Numbers high = hn::LoadU(as_numbers, &node.high[axis][lanes]) - from;
                least = least + least_square(low, high);
                most = most + most_square(low, high);
            }
            hn::StoreU(least, as_numbers, &found.least[lanes]);
            hn::StoreU(most, as_numbers, &found.most[lanes]);
        }
        return found;
    }

  private:
    glm::vec3 from_;
};

/// Measures distances from a point in the space into which a matrix transforms the positions.
class Metric {
  public:
    Metric(const glm::vec3& from, const glm::mat3& metric) : from_(from), metric_(metric) {}

    [[nodiscard]] float square(const PickerPoint& p) const noexcept {
        const float x = p[0] - from_.x, y = p[1] - from_.y, z = p[2] - from_.z;
        float sum = 0.0f;
        for (int row = 0; row < 3; ++row) {
            const float d = metric_[0][row] * x + metric_[1][row] * y + metric_[2][row] * z;
            sum += d * d;
        }
        return sum;
    }

    [[nodiscard]] Distances bounds(const PickerNode& node) const noexcept {
        Distances found{};
        for (std::size_t lanes = 0; lanes < fan_out; lanes += at_once) {
            Numbers least = hn::Zero(as_numbers), most = hn::Zero(as_numbers);
            for (int row = 0; row < 3; ++row) {
                Numbers low = hn::Zero(as_numbers), high = hn::Zero(as_numbers);
                for (int axis = 0; axis < 3; ++axis) {
                    const auto of_axis = static_cast<std::size_t>(axis);
                    const Numbers factor = hn::Set(as_numbers, metric_[axis][row]);
                    const Numbers from = hn::Set(as_numbers, from_[axis]);
                    const Numbers one = (hn::LoadU(as_numbers, &node.low[of_axis][lanes]) - from) * factor;
                    const Numbers other = (hn::LoadU(as_numbers, &node.high[of_axis][lanes]) - from) * factor;
                    low = low + hn::Min(one, other);
                    high = high + hn::Max(one, other);
                }
                least = least + least_square(low, high);
                most = most + most_square(low, high);
            }
            hn::StoreU(least, as_numbers, &found.least[lanes]);
            hn::StoreU(most, as_numbers, &found.most[lanes]);
        }
        return found;
    }

  private:
    glm::vec3 from_;
    glm::mat3 metric_;
};

/// Collects the vertices whose squared distance is at most a given one.
template <class Measure>
class Collection {
  public:
    Collection(const NearTree& tree, const Measure& measure, float most)
        : tree_(tree), measure_(measure), most_(most) {}

    void collect(std::size_t level, std::size_t node) {
        const Distances distances = measure_.bounds(tree_.boxes.node(level, node));
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            if (!(distances.least[lane] <= most_)) continue;
            const std::size_t child = node * fan_out + lane;
            const auto [first, last] = tree_.below(level, child);
            if (distances.most[lane] <= most_ && tree_.all_finite) {
                found_.insert(found_.end(), tree_.order.begin() + static_cast<std::ptrdiff_t>(first),
                              tree_.order.begin() + static_cast<std::ptrdiff_t>(last));
            } else if (level > 0) {
                if (first < last) collect(level - 1, child);
            } else {
                for (std::size_t place = first; place < last; ++place)
                    if (measure_.square(tree_.points[place]) <= most_) found_.push_back(tree_.order[place]);
            }
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> take() { return std::move(found_); }

  private:
    const NearTree& tree_;
    Measure measure_;
    float most_;
    std::vector<std::uint32_t> found_;
};

/// The nearest vertex so far, and the search for nearer ones.
class Search {
  public:
    Search(const NearTree& tree, const glm::vec3& point) : tree_(tree), measure_(point) {}

    void descend(std::size_t level, std::size_t node) {
        const Lanes least = measure_.bounds(tree_.boxes.node(level, node)).least;
        // The nearest lane first: after it, hardly any other is worth a visit, in whatever order. Those as
        // near as what is found may have a vertex of a lower index.
        std::size_t nearest = 0;
        for (std::size_t lane = 1; lane < fan_out; ++lane)
            nearest = least[lane] < least[nearest] ? lane : nearest;
        if (least[nearest] <= best_) visit(level, node * fan_out + nearest);
        for (std::size_t lane = 0; lane < fan_out; ++lane)
            if (lane != nearest && least[lane] <= best_) visit(level, node * fan_out + lane);
    }

    [[nodiscard]] std::optional<std::uint32_t> found() const { return found_; }

  private:
    void visit(std::size_t level, std::size_t child) {
        const auto [first, last] = tree_.below(level, child);
        if (level == 0) {
            for (std::size_t place = first; place < last; ++place) consider(place);
        } else if (first < last) {
            descend(level - 1, child);
        }
    }

    void consider(std::size_t place) {
        const float square = measure_.square(tree_.points[place]);
        const std::uint32_t vertex = tree_.order[place];
        if (square < best_ || (square == best_ && (!found_ || vertex < *found_))) {
            best_ = square;
            found_ = vertex;
        }
    }

    const NearTree& tree_;
    Straight measure_;
    float best_ = std::numeric_limits<float>::infinity();
    std::optional<std::uint32_t> found_;
};

std::optional<std::uint32_t> nearest(const NearTree& tree, const glm::vec3& point) {
    Search search(tree, point);
    if (!tree.boxes.empty() && is_finite(point)) search.descend(tree.boxes.top(), 0);
    return search.found();
}

template <class Measure>
std::vector<std::uint32_t> collected(const NearTree& tree, const glm::vec3& point, const Measure& measure,
                                     float radius) {
    if (tree.boxes.empty() || !(radius >= 0.0f) || !is_finite(point)) return {};
    Collection collection(tree, measure, radius * radius);
    collection.collect(tree.boxes.top(), 0);
    return collection.take();
}

std::vector<std::uint32_t> within(const NearTree& tree, const glm::vec3& point, float radius,
                                  const glm::mat3& metric) {
    return metric == glm::mat3(1.0f) ? collected(tree, point, Straight(point), radius)
                                     : collected(tree, point, Metric(point, metric), radius);
}

constexpr NearKernel kernel{HWY_STR(HWY_NAMESPACE), &nearest, &within};

}  // namespace
}  // namespace motus::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::mesh {
namespace {

/// Sorts indices of which none comes twice.
void sort_indices(std::vector<std::uint32_t>& indices) {
    if (indices.empty()) return;
    std::uint32_t from = indices.front(), last = from;
    for (const std::uint32_t index : indices) {
        from = std::min(from, index);
        last = std::max(last, index);
    }
    const std::size_t words = (last - from) / 64 + 1;
    // A bit for each index in between is faster than comparing, where they are not few and far between.
    if (words > 16 * indices.size()) {
        std::sort(indices.begin(), indices.end());
        return;
    }
    std::vector<std::uint64_t> bits(words);
    for (const std::uint32_t index : indices)
        bits[(index - from) / 64] |= std::uint64_t{1} << (index - from) % 64;
    auto next = indices.begin();
    for (std::size_t word = 0; word < words; ++word)
        for (std::uint64_t left = bits[word]; left != 0; left &= left - 1)
            *next++ = from + static_cast<std::uint32_t>(64 * word) +
                      static_cast<std::uint32_t>(std::countr_zero(left));
}

}  // namespace

std::span<const NearKernel> near_kernels() {
    static const Kernels<NearKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

std::optional<std::uint32_t> Picker::nearest(const glm::vec3& point) const {
    return near_kernels().back().nearest(tree().for_points(), point);
}

std::vector<std::uint32_t> Picker::within(const glm::vec3& point, float radius,
                                          const glm::mat3& metric) const {
    std::vector<std::uint32_t> found =
        near_kernels().back().within(tree().for_points(), point, radius, metric);
    sort_indices(found);
    return found;
}

}  // namespace motus::mesh
#endif
