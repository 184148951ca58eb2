#include "heaps_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "motus/core/instruction_sets.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "heaps_kernel.cpp"
#include <hwy/foreach_target.h>

#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

constexpr float widest = 12.0F;    ///< cells, of the slope beside the line,
constexpr float narrowest = 2.0F;  ///< which a mesh can show without steps

using Mask = hn::Mask<decltype(as_four)>;
static_assert(HeapPlan::width == 4);

HWY_INLINE Four at(const std::vector<float>& numbers, const std::uint32_t* vertices) {
    return four_of([&](std::size_t i) HWY_ATTR { return numbers[vertices[i]]; });
}

/// One settling of depths.
class Fall {
  public:
    /// `depths`: of the vertices, and 0 in the end.
    Fall(const HeapPlan& plan, std::vector<float>& depths, float steepest)
        : plan_(plan),
          depths_(depths),
          steepest_(steepest),
          changed_(depths.size() / HeapPlan::group + 1),
          seen_(plan.block_count()) {}

    void run() {
        round_off();
        go_through(plan_.whole / HeapPlan::block, [&](Steep& some) HWY_ATTR { hand_on(some); });
        lower_shores();
        for (const std::uint32_t at : left_) seen_[at] = 0;
        // What is still too high is left out.
        go_through(seen_.size(), [&](Steep& some) HWY_ATTR {
            some.high = some.low + hn::Set(as_four, steepest_) * some.lengths;
        });
    }

  private:
    /// A little less steep than may be, so that there is an end to it.
    static constexpr float slack = 0.02F;
    static constexpr int most_rounds = 8;

    /// Edges without a common vertex, at least one of which is too steep.
    struct Steep {
        std::size_t index = 0;    ///< of the Ways
        std::size_t first = 0;    ///< of the edges, among those of the Ways
        Mask is_steep, is_x;      ///< whether x is the higher end
        Four lengths, high, low;  ///< m; the depths of the ends
    };

    /// Changes the edges of the first so many blocks, where they are too steep, there and back in turn;
    /// blocks about which nothing has changed rest.
    template <class Change>
    void go_through(std::size_t blocks, const Change& change) {
        bool has_changed = true;
        for (int round = 0; round < most_rounds && has_changed; ++round) {
            has_changed = false;
            for (std::size_t i = 0; i < blocks; ++i) {
                const std::size_t at = round % 2 == 0 ? i : blocks - 1 - i;
                if (!is_active(at)) continue;
                seen_[at] = ++now_;
                for (std::size_t j = 0; j < HeapPlan::block; ++j) {
                    const std::size_t in_turn = round % 2 == 0 ? j : HeapPlan::block - 1 - j;
                    for (std::size_t first = 0; first < HeapPlan::width; first += lanes_of_four)
                        has_changed |= go_over(at * HeapPlan::block + in_turn, first, change);
                }
            }
        }
    }
    /// Changes edges that are too steep, and tells whether any depth is different now.
    template <class Change>
    [[nodiscard]] bool go_over(std::size_t index, std::size_t first, const Change& change) {
        const HeapPlan::Ways& ways = plan_.ways[index];
        const std::uint32_t* const ends_x = ways.x.data() + first;
        const std::uint32_t* const ends_y = ways.y.data() + first;
        const Four x = at(depths_, ends_x), y = at(depths_, ends_y);
        const Four lengths = hn::LoadU(as_four, ways.lengths.data() + first);
        const Mask is_x = x > y;
        const Four high = hn::IfThenElse(is_x, x, y), low = hn::IfThenElse(is_x, y, x);
        const Mask is_steep = high - low > hn::Set(as_four, steepest_) * lengths;
        if (hn::AllFalse(as_four, is_steep)) return false;
        Steep some{index, first, is_steep, is_x, lengths, high, low};
        change(some);
        const Four new_high = hn::IfThenElse(is_steep, some.high, high);
        const Four new_low = hn::IfThenElse(is_steep, some.low, low);
        // An edge that is as steep as may be can be too steep by a rounding.
        if (hn::AllTrue(as_four, hn::And(new_high == high, new_low == low))) return false;
        alignas(16) std::array<float, lanes_of_four> new_x{}, new_y{};
        hn::Store(hn::IfThenElse(is_x, new_high, new_low), as_four, new_x.data());
        hn::Store(hn::IfThenElse(is_x, new_low, new_high), as_four, new_y.data());
        for (std::size_t i = 0; i < lanes_of_four; ++i) {
            depths_[ends_x[i]] = new_x[i];
            depths_[ends_y[i]] = new_y[i];
            mark(ends_x[i]);
            mark(ends_y[i]);
        }
        return true;
    }
    /// Whether something has changed about a block since it was seen.
    [[nodiscard]] bool is_active(std::size_t at) const {
        for (std::uint32_t i = plan_.group_starts[at]; i < plan_.group_starts[at + 1]; ++i)
            if (changed_[plan_.groups[i]] >= seen_[at]) return true;
        return false;
    }
    void mark(std::uint32_t vertex) { changed_[vertex / HeapPlan::group] = now_; }

    /// Of the slope from the line up to a depth.
    [[nodiscard]] float width_of(const HeapPlan::Shore& shore, float depth) const {
        return std::clamp(2.0F * depth / steepest_, narrowest * shore.cell, widest * shore.cell);
    }
    /// How deep the snow on a shore may be, without what lies on both sides of the line.
    [[nodiscard]] float rounded(const HeapPlan::Shore& shore, float depth) const {
        const float part = shore.distance / width_of(shore, depth);
        return part < 1.0F ? depth * part * (2.0F - part) : depth;
    }

    /// Lets the snow rise from the line at which it ends as roundly as a mesh can show, and no steeper than
    /// it may be. What is too much lies on what is farther from the line, the less the farther.
    void round_off() {
        const std::size_t count = plan_.shores.size();
        if (count == 0) return;
        bases_.reserve(count);
        for (const HeapPlan::Shore& shore : plan_.shores) {
            const glm::uvec3& corners = shore.corners;
            bases_.push_back(
                std::max(0.0F, std::min({depths_[corners.x], depths_[corners.y], depths_[corners.z]})));
        }
        std::vector<double> carried(count);  // m^3
        for (std::size_t i = 0; i < count; ++i) {
            const HeapPlan::Shore& shore = plan_.shores[i];
            const double area = static_cast<double>(plan_.areas[shore.vertex]);
            if (!(area > 0.0)) continue;
            const double left = take(shore, bases_[i], carried[i] / area);
            if (!(left > 0.0)) continue;
            for (std::uint32_t j = plan_.handing_starts[i]; j < plan_.handing_starts[i + 1]; ++j)
                carried[plan_.handings[j].shore] += area * left * plan_.handings[j].weight / shore.weights;
        }
    }
    /// Lays some of what is handed to a shore on it, m, and returns what is too much.
    [[nodiscard]] double take(const HeapPlan::Shore& shore, float base, double more) {
        constexpr float reach = 2.0F;    // times the width of the slope: where most of it lies
        constexpr float highest = 0.2F;  // of the depth, so that nothing is heaped up where ways meet
        float& depth = depths_[shore.vertex];
        const float own = std::max(0.0F, depth - base);
        const float share = std::min(1.0F, shore.cell / (reach * width_of(shore, own)));
        const float taken = std::min(share * static_cast<float>(more), highest * own);
        const float whole = depth + taken;
        depth = whole > base ? base + rounded(shore, whole - base) : whole;
        return more - static_cast<double>(taken) + static_cast<double>(whole - depth);
    }
    void lower_shores() {
        for (std::size_t i = 0; i < bases_.size(); ++i) {
            const HeapPlan::Shore& shore = plan_.shores[i];
            const float most = bases_[i] + steepest_ * shore.distance;
            if (!(depths_[shore.vertex] > most)) continue;
            depths_[shore.vertex] = most;
            mark(shore.vertex);
        }
    }

    /// What is too high goes to the lower vertex of two, so that volumes stay; not where one of them has no
    /// area.
    void hand_on(Steep& some) {
        const HeapPlan::Ways& ways = plan_.ways[some.index];
        const Four x = at(plan_.areas, ways.x.data() + some.first);
        const Four y = at(plan_.areas, ways.y.data() + some.first);
        const Four here = hn::IfThenElse(some.is_x, x, y), there = hn::IfThenElse(some.is_x, y, x);
        const Four most = hn::Set(as_four, (1.0F - slack) * steepest_) * some.lengths;
        const Four moved = (some.high - some.low - most) / (here + there);
        const Mask can_change = hn::And(here > hn::Zero(as_four), there > hn::Zero(as_four));
        some.high = hn::IfThenElse(can_change, some.high - there * moved, some.high);
        some.low = hn::IfThenElse(can_change, some.low + here * moved, some.low);
        if (!hn::AllFalse(as_four, hn::AndNot(can_change, some.is_steep)))
            left_.push_back(static_cast<std::uint32_t>(some.index / HeapPlan::block));
    }

    const HeapPlan& plan_;
    std::vector<float>& depths_;
    float steepest_;
    std::uint32_t now_ = 0;               ///< blocks that have been gone through
    std::vector<std::uint32_t> changed_;  ///< when a vertex of each group changed last,
    std::vector<std::uint32_t> seen_;     ///< and when each block was gone through
    std::vector<std::uint32_t> left_;     ///< blocks with edges that cannot be changed
    std::vector<float> bases_;            ///< m, what lies on both sides of the line beside each shore
};

void settle(const HeapPlan& plan, std::vector<float>& depths, float steepest) {
    Fall(plan, depths, steepest).run();
}

constexpr HeapKernel kernel{HWY_STR(HWY_NAMESPACE), &settle};

}  // namespace
}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::snow {

std::span<const HeapKernel> heap_kernels() {
    static const Kernels<HeapKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::snow
#endif
