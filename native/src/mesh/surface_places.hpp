// The vertices that a search along a surface has reached, and their distances.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace motus::mesh {

/// A vertex and the shortest way to it so far. Lengths are the metric's.
struct SurfacePlace {
    glm::vec3 position{0.0f};                                 ///< from the root
    float straight = -1.0f;                                   ///< |position|; < 0 if position is not set
    float distance = std::numeric_limits<float>::infinity();  ///< -infinity if there can be no way
    float spread = 1.0f;  ///< distance / radius of the wave that has come by: 1 on a flat surface, less on a
                          ///< dome, below 0 past a dome's focus, more on a saddle
    float curvature = 0.0f;     ///< the surface's, 1 / length^2; set when the place is settled
    std::uint32_t settled = 0;  ///< how many times its neighbours have been told of it
};

/// An array of which only the pages that are touched exist: a small search on a large mesh pays for what it
/// reaches, and has it in ascending order at the end.
template <class Value>
class Pages {
  public:
    explicit Pages(std::size_t count) : pages_((count + page_size - 1) / page_size) {}

    /// Value() until it is set. Stays where it is.
    [[nodiscard]] Value& operator[](std::uint32_t i) {
        std::unique_ptr<Page>& page = pages_[i / page_size];
        if (!page) [[unlikely]]
            page = std::make_unique<Page>();
        return (*page)[i % page_size];
    }

    /// visit(i, value) for all in the pages that exist, ascending; i may be beyond the array's last.
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::size_t p = 0; p < pages_.size(); ++p) {
            if (!pages_[p]) continue;
            for (std::size_t i = 0; i < page_size; ++i)
                visit(static_cast<std::uint32_t>(p * page_size + i), (*pages_[p])[i]);
        }
    }

  private:
    static constexpr std::size_t page_size = 128;
    using Page = std::array<Value, page_size>;
    std::vector<std::unique_ptr<Page>> pages_;
};

}  // namespace motus::mesh
