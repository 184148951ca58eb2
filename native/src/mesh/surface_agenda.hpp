// Vertices in the order of their distance.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace motus::mesh {

/// A vertex that is due at a distance. Ordered by the distance, then by the number of the vertex.
class Due {
  public:
    Due(float distance, std::uint32_t vertex)  // floats >= 0 are ordered as their bits are
        : key_(std::uint64_t{std::bit_cast<std::uint32_t>(distance)} << 32 | vertex) {}
    [[nodiscard]] float distance() const {
        return std::bit_cast<float>(static_cast<std::uint32_t>(key_ >> 32));
    }
    [[nodiscard]] std::uint32_t vertex() const { return static_cast<std::uint32_t>(key_); }
    [[nodiscard]] bool operator>(const Due& other) const { return key_ > other.key_; }

  private:
    std::uint64_t key_;
};

/// A priority queue for distances that mostly grow: what is far off waits unsorted in shelves of equal width,
/// only the shelf that is being emptied is a heap. What is beyond the last shelf waits in it.
class Agenda {
  public:
    /// Shelves of about `width`, as many as it takes to `end` (both > 0; infinity and 0 are put up with).
    Agenda(float width, float end) {
        constexpr float most = 16384.0f;
        const float wanted = std::isfinite(end) ? std::max(width, end / most) : width;
        if (wanted > 0.0f && std::isfinite(1.0f / wanted)) shelves_a_length_ = 1.0f / wanted;
        const float shelves = std::min(end * shelves_a_length_ + 2.0f, most);
        shelves_.assign(shelves >= 1.0f ? static_cast<std::size_t>(shelves) : 1, none);
    }

    void add(float distance, std::uint32_t vertex) {
        const std::size_t shelf = shelf_of(distance);
        if (shelf <= open_shelf_) {
            open_.emplace_back(distance, vertex);
            std::push_heap(open_.begin(), open_.end(), std::greater<>());
            return;
        }
        std::uint32_t slot = free_;
        if (slot == none) {
            slot = static_cast<std::uint32_t>(waiting_.size());
            waiting_.push_back({{distance, vertex}, none});
        } else {
            free_ = waiting_[slot].next;
            waiting_[slot].due = {distance, vertex};
        }
        waiting_[slot].next = shelves_[shelf];
        shelves_[shelf] = slot;
    }

    /// Whether there is a next one; opens the next shelf if need be: leaves out what is_stale(due) holds for,
    /// and shows the rest to expect(all that is due from the shelf).
    template <class IsStale, class Expect>
    [[nodiscard]] bool has_next(const IsStale& is_stale, const Expect& expect) {
        while (open_.empty()) {
            do {
                if (++open_shelf_ >= shelves_.size()) return false;
            } while (shelves_[open_shelf_] == none);
            std::uint32_t slot = shelves_[open_shelf_];
            shelves_[open_shelf_] = none;
            while (slot != none) {
                Waiting& waiting = waiting_[slot];
                if (!is_stale(waiting.due)) open_.push_back(waiting.due);
                const std::uint32_t next = waiting.next;
                waiting.next = free_;
                free_ = slot;
                slot = next;
            }
            expect(open_);
            std::make_heap(open_.begin(), open_.end(), std::greater<>());
        }
        return true;
    }
    [[nodiscard]] Due take() {
        std::pop_heap(open_.begin(), open_.end(), std::greater<>());
        const Due due = open_.back();
        open_.pop_back();
        return due;
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Waiting {
        Due due;
        std::uint32_t next;
    };

    [[nodiscard]] std::size_t shelf_of(float distance) const {
        const float shelf = distance * shelves_a_length_;
        const std::size_t last = shelves_.size() - 1;
        return shelf < static_cast<float>(last) ? static_cast<std::size_t>(shelf) : last;
    }

    float shelves_a_length_ = 0.0f;
    std::size_t open_shelf_ = 0;
    std::vector<Due> open_;
    std::vector<std::uint32_t> shelves_;  ///< first slot of each
    std::vector<Waiting> waiting_;        ///< slots, chained
    std::uint32_t free_ = none;
};

}  // namespace motus::mesh
