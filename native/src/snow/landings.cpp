#include "landings.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "motus/core/unfilled.hpp"

namespace motus::snow {
namespace {

constexpr std::size_t most_pages = std::size_t{1} << 20U;

/// Rows of a block, and what loops over whole vectors read beyond them.
template <class T>
using Row = Unfilled<T, block_size + padding>;

// Rows have w first.
[[nodiscard]] glm::dquat quaternion_of(const glm::vec4& row) {
    return {row.x, row.y, row.z, row.w};
}
[[nodiscard]] glm::vec4 row_of(const glm::dquat& q) {
    return {q.w, q.x, q.y, q.z};
}

}  // namespace

/// A place on a flat surface, in the space of a mover if that has it.
struct Landings::Hit {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};
    double part = 0.0;  ///< of the way that was looked at
    std::int32_t triangle = Landing::ground;
    std::size_t mover = 0;  ///< for Landing::carried
};

Landings::Landings(const FlightModel& model, const SnowSettings& settings)
    : model_(model),
      ground_(settings.ground),
      collider_(settings.collider),
      movers_(settings.movers),
      collision_(settings.collision),
      rest_time_(settings.collision == Collision::melt ? settings.melt_time : settings.rest_time),
      melt_time_(settings.melt_time),
      friction_(settings.friction),
      pull_(settings.acceleration),
      number_([] {
          static std::atomic<std::uint64_t> count{0};
          return count++;
      }()) {}

Landings::~Landings() {
    if (has_pages_) pages().erase_if([this](const PageKey& key) { return key.landings == number_; });
}

Landings::Pages& Landings::pages() {
    // Never destroyed: other threads may still use it when the process ends.
    static auto& all = *new Pages(most_pages);
    return all;
}

std::optional<Landings::Hit> Landings::first_hit(const glm::dvec3& start, const glm::dvec3& end) const {
    std::optional<Hit> first;
    if (ground_ && start.z >= *ground_ && end.z < *ground_) {
        first.emplace();
        first->part = (start.z - *ground_) / (start.z - end.z);
        first->point = start + first->part * (end - start);
    }
    if (!collider_) return first;
    const std::optional<Collider::Hit> hit = collider_->first_hit(start, end);
    // Where the ground is as high as a surface, rounding does not decide what is met: the surface is.
    if (hit && !(first && hit->point.z < *ground_ - collider_->rounding()))
        first = {hit->point, collider_->normal(hit->triangle), hit->part,
                 static_cast<std::int32_t>(hit->triangle), 0};
    return first;
}

/// Goes along the ways of a block's flakes.
class Landings::March {
  public:
    March(const Landings& landings, std::uint64_t block)
        : landings_(landings), model_(landings.model_), flight_(model_), first_(block * block_size) {
        const std::vector<Births::Piece>& pieces = model_.births.pieces();
        const std::uint64_t last = std::min(first_ + block_size, pieces.empty() ? 0 : pieces.back().last);
        auto piece = pieces.begin();
        for (std::uint64_t id = first_; id < last; ++id) {
            while (id >= piece->last) ++piece;
            Walker& walker = walkers_[count_++];
            walker.low = static_cast<std::uint32_t>(id);
            walker.birth = piece->is_burst ? piece->burst
                                           : model_.births.streamed(piece->streamed + (id - piece->first));
            walker.since = walker.birth;
            walker.end = walker.birth + model_.lifetime;
        }
        if (!model_.random_lifetime || count_ == 0) return;
        set_lows(0, count_);
        Row<float> draws;
        model_.kernel->lives(model_.kind.key, high(), lows_.data(), count_, draws.data());
        for (std::size_t i = 0; i < count_; ++i)
            walkers_[i].end += lifetime_range * static_cast<double>(draws[i]);
    }

    void find(Page& page) {
        // The grid of times has no room beside times that are as large.
        constexpr double most_steps = 0x1p50;
        const double step = model_.look_step;
        if (count_ == 0 || !(walkers_[count_ - 1].birth < most_steps * step)) return;
        const std::size_t all = count_;
        count_ = 0;
        std::size_t born = 0;
        for (double tick = std::floor(walkers_[0].birth / step); count_ > 0 || born < all;) {
            if (count_ == 0) {
                tick = std::max(tick, std::floor(walkers_[born].birth / step));
                now_.set(landings_.movers_, tick * step);
            }
            tick += 1.0;
            const double time = tick * step;
            const std::size_t older = count_;
            while (born < all && walkers_[born].birth <= time) walkers_[count_++] = walkers_[born++];
            begin(time, older);
            std::swap(before_, now_);
            now_.set(landings_.movers_, time);
            go_on(time, page);
        }
    }

  private:
    struct Walker {
        std::uint32_t low = 0;
        double birth = 0.0, end = 0.0;  ///< of its life
        double since = 0.0;             ///< when it was last looked at,
        glm::vec3 from{0.0F};           ///< and where it was then
    };

    [[nodiscard]] std::uint32_t high() const { return static_cast<std::uint32_t>(first_ >> 32U); }

    void set_lows(std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) lows_[i - from] = walkers_[i].low;
        std::fill_n(lows_.data() + (to - from), padding, lows_[to - from - 1]);
    }
    void set(double time, std::size_t from, std::size_t to) {
        set_lows(from, to);
        for (std::size_t i = from; i < to; ++i) ages_[i - from] = time - walkers_[i].birth;
        std::fill_n(ages_.data() + (to - from), padding, ages_[to - from - 1]);
    }

    /// Those from `older` on were born since the last time.
    void begin(double time, std::size_t older) {
        if (older == count_) return;
        set(time, older, count_);
        flight_.fill_births(time, ages_.data(), lows_.data(), high(), count_ - older, {.position = places_});
        for (std::size_t i = older; i < count_; ++i) walkers_[i].from = places_[i - older];
    }

    void go_on(double time, Page& page) {
        if (count_ == 0) return;
        set(time, 0, count_);
        flight_.fill(time, ages_.data(), lows_.data(), high(), count_, {.position = places_}, 0);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            Walker walker = walkers_[i];
            // What a flake leaves, it does not land on: the beginning of its way meets nothing.
            constexpr float left_out = 0x1p-6F;
            const glm::vec3 to = places_[i];
            if (walker.since == walker.birth) {
                walker.from += left_out * (to - walker.from);
                walker.since += static_cast<double>(left_out) * (time - walker.since);
            }
            const std::optional<Hit> hit = first_hit(walker, time, to);
            if (hit) {
                come_down(walker, time, to, *hit, page);
                continue;
            }
            walker.since = time;
            walker.from = to;
            if (time < walker.end) walkers_[kept++] = walker;
        }
        count_ = kept;
    }

    /// What a walker meets until a time, when it would be at `to`.
    [[nodiscard]] std::optional<Hit> first_hit(const Walker& walker, double time, const glm::dvec3& to) {
        std::optional<Hit> first = landings_.first_hit(walker.from, to);
        const Movers& movers = landings_.movers_;
        if (!movers.are_any()) return first;
        // Those that have just been born were looked at between the ticks.
        const bool is_new = walker.since > time - model_.look_step;
        if (is_new) between_.set(movers, walker.since);
        const auto hit = movers.first_hit(walker.from, is_new ? between_ : before_, to, now_);
        if (hit && !(first && first->part <= hit->part))
            first = {hit->point, hit->normal, hit->part, Landing::carried, hit->mover};
        return first;
    }

    [[nodiscard]] glm::dvec3 position_at(const Walker& walker, double time) {
        fill_one(walker, time, {.position = place_});
        return place_[0];
    }
    void fill_one(const Walker& walker, double time, const Fields& out) {
        one_low_.fill(walker.low);
        one_age_.fill(std::max(0.0, time - walker.birth));
        one_.fill(time, one_age_.data(), one_low_.data(), high(), 1, out, 0);
    }

    void come_down(const Walker& walker, double end, const glm::vec3& to, const Hit& hit, Page& page) {
        const bool is_carried = hit.triangle == Landing::carried;
        const auto in_space = [&](const glm::dvec3& at, double when) {
            if (!is_carried) return at;
            between_.set(landings_.movers_, when);
            return between_.local(hit.mover, at);
        };
        const auto above = [&](const glm::dvec3& at) { return glm::dot(at - hit.point, hit.normal); };
        // Where the way itself goes through the surface: Illinois, which keeps it between two times.
        double low = walker.since, high = end, at_low = above(in_space(walker.from, low)),
               at_high = above(in_space(to, high));
        const bool is_below = at_low < 0.0;
        double time = low + hit.part * (end - low), off = 0.0;
        glm::dvec3 place(0.0);
        constexpr int most_rounds = 12;
        for (int round = 0; round < most_rounds; ++round) {
            place = in_space(position_at(walker, time), time);
            off = above(place);
            const double rounding = 0x1p-23 * (glm::length(place) + glm::length(hit.point));
            if (std::abs(off) <= rounding || !(at_low * at_high < 0.0)) break;
            if (off * at_high < 0.0) {
                low = high;
                at_low = at_high;
            } else {
                at_low *= 0.5;
            }
            high = time;
            at_high = off;
            time = high - at_high * (high - low) / (at_high - at_low);
        }
        if (!(time < walker.end)) return;

        fill_one(walker, time, {.velocity = velocity_, .rotation = rotation_});
        const std::size_t slot = walker.low % block_size;
        place -= off * hit.normal;
        page.times[slot] = time;
        Landing& landing = page.landings[slot];
        landing.point = place;
        landing.rotation = rotation_[0];
        landing.triangle = hit.triangle;
        if (is_carried) {
            landing.slide = static_cast<std::uint32_t>(hit.mover);
            landing.is_behind = is_below;
            landing.rotation = row_of(glm::conjugate(landings_.movers_.rotation(hit.mover, time)) *
                                      quaternion_of(rotation_[0]));
            return;
        }
        landing.is_behind = glm::dot(glm::dvec3(velocity_[0]), hit.normal) > 0.0;
        if (landings_.collision_ != Collision::slide || hit.triangle == Landing::ground) return;
        landing.slide = static_cast<std::uint32_t>(page.slides.size());
        landings_.collider_->slide({static_cast<std::uint32_t>(hit.triangle), landing.is_behind, place},
                                   velocity_[0], landings_.pull_, landings_.friction_, page.slides);
        landing.slide_count = static_cast<std::uint32_t>(page.slides.size()) - landing.slide;
    }

    const Landings& landings_;
    const FlightModel& model_;
    Flight flight_, one_{model_};
    std::uint64_t first_;
    std::array<Walker, block_size> walkers_{};  ///< `count_` that are under way, and those not yet born
    std::size_t count_ = 0;
    Row<double> ages_;
    Row<std::uint32_t> lows_;
    Unfilled<double, padding> one_age_;
    Unfilled<std::uint32_t, padding> one_low_;
    Movers::Spaces before_, now_, between_;  ///< at the last tick, at this one, and where they were needed
    std::array<glm::vec3, block_size> places_{};
    std::array<glm::vec3, 1> place_{}, velocity_{};
    std::array<glm::vec4, 1> rotation_{};
};

std::shared_ptr<const Landings::Page> Landings::find(std::uint64_t block) const {
    auto page = std::make_shared<Page>();
    March(*this, block).find(*page);
    page->slides.shrink_to_fit();
    return page;
}

std::shared_ptr<const Landings::Page> Landings::page(std::uint64_t block) const {
    has_pages_.store(true, std::memory_order_relaxed);
    return pages().get({number_, block}, [this](const PageKey& missing) { return find(missing.block); });
}

void Landings::land(const Page& page, double time, const std::uint32_t* lows, std::size_t count,
                    const Fields& out, std::size_t index) const {
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t slot = lows[i] % block_size, row = index + i;
        const double since = time - page.times[slot];
        if (!(since >= 0.0)) continue;
        const Landing& landing = page.landings[slot];
        if (!out.size.empty() && collision_ == Collision::melt)
            out.size[row] *= static_cast<float>(1.0 - since / melt_time_);
        if (landing.triangle == Landing::carried) {
            carry(landing, time, out, row);
            continue;
        }
        glm::vec3 place = landing.point, velocity(0.0F);
        if (landing.slide_count > 0) {
            const auto slides = std::span(page.slides).subspan(landing.slide, landing.slide_count);
            const auto next = std::ranges::upper_bound(slides, since, {}, &Slide::start);
            const Slide& slide = *(next - 1);
            place = slide.position(since);
            velocity = slide.velocity(since);
        }
        if (!out.position.empty()) out.position[row] = place;
        if (!out.velocity.empty()) out.velocity[row] = velocity;
        if (!out.rotation.empty()) out.rotation[row] = landing.rotation;
    }
}

void Landings::carry(const Landing& landing, double time, const Fields& out, std::size_t row) const {
    const std::size_t mover = landing.slide;
    const glm::dvec4 place(landing.point, 1.0);
    if (!out.position.empty()) out.position[row] = glm::vec3(movers_.matrix(mover, time) * place);
    if (!out.velocity.empty()) out.velocity[row] = glm::vec3(movers_.rate(mover, time) * place);
    if (!out.rotation.empty())
        out.rotation[row] = row_of(movers_.rotation(mover, time) * quaternion_of(landing.rotation));
}

}  // namespace motus::snow
