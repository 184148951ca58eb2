// Where flakes land, and what they do from then on. Private to the library.
//
// A flake's way is looked at on a grid of times, whichever time is asked for; between two of them it counts
// as straight, and where that meets something the moment is found on the way itself.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "flight_model.hpp"
#include "motus/core/cache.hpp"
#include "motus/snow/collider.hpp"
#include "motus/snow/snow.hpp"
#include "movers.hpp"

namespace motus::snow {

struct Landing {
    static constexpr std::int32_t carried = -3, nowhere = -2, ground = -1;  ///< in place of a triangle

    glm::vec3 point{0.0F};  ///< carried: in the mover's space, like the rotation
    glm::vec4 rotation{1.0F, 0.0F, 0.0F, 0.0F};
    std::int32_t triangle = nowhere;
    bool is_behind = false;                    ///< it came from where the normal does not point to
    std::uint32_t slide = 0, slide_count = 0;  ///< of the page's; carried: by the mover of number `slide`
};

/// Of the flakes of a block.
struct LandingPage {
    LandingPage() { times.fill(std::numeric_limits<double>::infinity()); }

    std::array<double, block_size> times{};  ///< of landing; infinity: never
    std::array<Landing, block_size> landings{};
    std::vector<Slide> slides;
};

class Landings {
  public:
    using Page = LandingPage;

    /// `model` must stay where it is in memory for as long as the landings exist.
    Landings(const FlightModel& model, const SnowSettings& settings);
    /// Its pages are kept no longer.
    ~Landings();
    Landings(const Landings&) = delete;
    Landings& operator=(const Landings&) = delete;
    Landings(Landings&&) = delete;
    Landings& operator=(Landings&&) = delete;

    /// Whether there is anything to land on.
    [[nodiscard]] bool are_any() const noexcept {
        return ground_.has_value() || collider_ != nullptr || movers_.are_any();
    }
    /// s that a flake lives after it landed, at most.
    [[nodiscard]] double rest_time() const noexcept { return rest_time_; }
    [[nodiscard]] const std::shared_ptr<const Collider>& collider() const noexcept { return collider_; }

    /// What pulls down that which slides, m/s^2.
    [[nodiscard]] const glm::dvec3& pull() const noexcept { return pull_; }

    /// Of the numbers from block_size * block on; looked for, or as they were kept.
    [[nodiscard]] std::shared_ptr<const Page> page(std::uint64_t block) const;
    /// null where it has not been looked for, or is no longer kept.
    [[nodiscard]] std::shared_ptr<const Page> kept(std::uint64_t block) const {
        return pages().held({number_, block});
    }
    [[nodiscard]] std::shared_ptr<const Page> find(std::uint64_t block) const;

    /// Puts flakes that have landed into the rows from `index` on.
    void land(const Page& page, double time, const std::uint32_t* lows, std::size_t count, const Fields& out,
              std::size_t index) const;

  private:
    struct Hit;
    class March;
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& start, const glm::dvec3& end) const;
    void carry(const Landing& landing, double time, const Fields& out, std::size_t row) const;

    struct PageKey {
        std::uint64_t landings = 0;  ///< their number
        std::uint64_t block = 0;

        [[nodiscard]] friend bool operator==(const PageKey&, const PageKey&) = default;
    };
    struct PageHash {
        [[nodiscard]] std::size_t operator()(const PageKey& key) const noexcept {
            ContentHash hash;
            hash.add(key.landings);
            hash.add(key.block);
            return hash.value();
        }
    };
    struct Bytes {
        [[nodiscard]] std::size_t operator()(const PageKey& /*key*/, const Page& page) const noexcept {
            return sizeof page + bytes_of(page.slides);
        }
    };
    using Pages = Cache<PageKey, Page, PageHash, Bytes>;

    /// Those of all snows, which together have so much room.
    [[nodiscard]] static Pages& pages();

    const FlightModel& model_;
    std::optional<double> ground_;
    std::shared_ptr<const Collider> collider_;
    Movers movers_;
    Collision collision_;
    double rest_time_;
    double melt_time_;
    double friction_;
    glm::dvec3 pull_;
    std::uint64_t number_;                        ///< no other's
    mutable std::atomic<bool> has_pages_{false};  ///< whether any was asked for
};

}  // namespace motus::snow
