// Which vertices are near a point.
//
// Rounding is monotonic: the differences p - point of the vertices in a box lie between those of its corners,
// rounded as they are, and so do products and sums made in the same order. Bounds of boxes made this way hold
// to the last bit.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

namespace motus::mesh {
namespace {

/// Least and greatest squared distance of anything in each lane's box.
struct Distances {
    Lanes least;
    Lanes most;
};

/// The least square of a number between low and high.
inline FourFloats least_square(const FourFloats& low, const FourFloats& high) noexcept {
    const FourFloats gap = larger(larger(low, -high), FourFloats{});
    return gap * gap;
}
inline FourFloats most_square(const FourFloats& low, const FourFloats& high) noexcept {
    const FourFloats far = larger(-low, high);
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
        for (std::size_t lanes = 0; lanes < fan_out; lanes += 4) {
            FourFloats least{}, most{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float from = from_[static_cast<glm::length_t>(axis)];
                const FourFloats low = load<FourFloats>(node.low[axis], lanes) - from;
                const FourFloats high = load<FourFloats>(node.high[axis], lanes) - from;
                least += least_square(low, high);
                most += most_square(low, high);
            }
            store(least, found.least, lanes);
            store(most, found.most, lanes);
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
        for (std::size_t lanes = 0; lanes < fan_out; lanes += 4) {
            FourFloats least{}, most{};
            for (int row = 0; row < 3; ++row) {
                FourFloats low{}, high{};
                for (int axis = 0; axis < 3; ++axis) {
                    const auto of_axis = static_cast<std::size_t>(axis);
                    const float factor = metric_[axis][row];
                    const FourFloats one =
                        (load<FourFloats>(node.low[of_axis], lanes) - from_[axis]) * factor;
                    const FourFloats other =
                        (load<FourFloats>(node.high[of_axis], lanes) - from_[axis]) * factor;
                    low += smaller(one, other);
                    high += larger(one, other);
                }
                least += least_square(low, high);
                most += most_square(low, high);
            }
            store(least, found.least, lanes);
            store(most, found.most, lanes);
        }
        return found;
    }

  private:
    glm::vec3 from_;
    glm::mat3 metric_;
};

/// Collects the vertices whose squared distance is at most a given one.
template <class Measure, class Tree>
class Collection {
  public:
    Collection(const Tree& tree, const Measure& measure, float most)
        : tree_(tree), measure_(measure), most_(most) {}

    void collect(std::size_t level, std::size_t node) {
        const Distances distances = measure_.bounds(tree_.around_vertices.node(level, node));
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
    const Tree& tree_;
    Measure measure_;
    float most_;
    std::vector<std::uint32_t> found_;
};

/// The nearest vertex so far, and the search for nearer ones.
template <class Tree>
class Search {
  public:
    Search(const Tree& tree, const glm::vec3& point) : tree_(tree), measure_(point) {}

    void descend(std::size_t level, std::size_t node) {
        const Lanes least = measure_.bounds(tree_.around_vertices.node(level, node)).least;
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

    const Tree& tree_;
    Straight measure_;
    float best_ = std::numeric_limits<float>::infinity();
    std::optional<std::uint32_t> found_;
};

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

template <class Measure, class Tree>
std::vector<std::uint32_t> collected(const Tree& tree, const glm::vec3& point, const Measure& measure,
                                     float radius) {
    if (tree.around_vertices.empty() || !(radius >= 0.0f) || !is_finite(point)) return {};
    Collection collection(tree, measure, radius * radius);
    collection.collect(tree.around_vertices.top(), 0);
    return collection.take();
}

}  // namespace

std::optional<std::uint32_t> Picker::nearest(const glm::vec3& point) const {
    Search search(tree(), point);
    if (!tree().around_vertices.empty() && is_finite(point)) search.descend(tree().around_vertices.top(), 0);
    return search.found();
}

std::vector<std::uint32_t> Picker::within(const glm::vec3& point, float radius,
                                          const glm::mat3& metric) const {
    std::vector<std::uint32_t> found = metric == glm::mat3(1.0f)
                                           ? collected(tree(), point, Straight(point), radius)
                                           : collected(tree(), point, Metric(point, metric), radius);
    sort_indices(found);
    return found;
}

}  // namespace motus::mesh
