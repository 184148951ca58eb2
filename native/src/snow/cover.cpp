#include "motus/snow/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "holding.hpp"
#include "kernel.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/core/sine.hpp"
#include "motus/mesh/neighbours.hpp"
#include "philox.hpp"

namespace motus::snow {
namespace {

constexpr std::size_t grain = 1024;
constexpr double grip_range = 0.5;
constexpr double highest = 1e30;  ///< m, of snow on what is so small that it has nearly no area

/// By how much more friction than the angle of repose has a flake lies, [0, 1).
[[nodiscard]] double grip_of(std::uint64_t id) {
    return static_cast<double>(
        fraction(philox({static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32U),
                         static_cast<std::uint32_t>(Stream::grip), 0},
                        {})
                     .a));
}

[[nodiscard]] double tangent(double angle) {
    const SineCosine<double> found = sine_cosine(angle);
    return found.sine / found.cosine;
}

/// Where a flake comes to lie that lands at a place; nothing where it falls from the collider.
[[nodiscard]] std::optional<Collider::Place> resting_place(const Collider& collider, Collider::Place place,
                                                           const glm::dvec3& pull, double friction,
                                                           std::vector<Slide>& slides) {
    const glm::dvec3 down = unit_vector(pull);
    constexpr int most_ways = 16;  // slides and falls
    for (int way = 0; way < most_ways; ++way) {
        glm::dvec3 up = collider.normal(place.triangle);
        if (place.is_behind) up = -up;
        // What came to the lower side of something falls, too.
        glm::dvec3 off = up;
        if (glm::dot(up, down) <= 0.0) {
            slides.clear();
            const Collider::Rest rest = collider.slide(place, glm::dvec3(0.0), pull, friction, slides);
            place = rest.place;
            // A slide ends after so many triangles, wherever that is.
            if (!rest.over && slides.size() > Collider::most_slides) continue;
            if (!rest.over) return place;
            off = *rest.over - down;
        }
        const std::optional<Collider::Place> next = collider.below(place.point + clear * off, down);
        if (!next) return {};
        place = *next;
    }
    return place;
}

/// Shares of a triangle's corners in a point on it, none of them negative. Where the triangle is so narrow
/// that the point is beside it, all is the nearest corner's.
[[nodiscard]] std::array<double, 3> weights_of(const std::array<glm::dvec3, 3>& corners,
                                               const glm::dvec3& point) {
    const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::array<double, 3> weights{};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = corners.at((i + 1) % 3) - point, b = corners.at((i + 2) % 3) - point;
        weights.at(i) = std::max(0.0, glm::dot(glm::cross(a, b), across));
        sum += weights.at(i);
    }
    if (sum > 0.0) {
        for (double& weight : weights) weight /= sum;
        return weights;
    }
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (length_of(corners.at(i) - point) < length_of(corners.at(nearest) - point)) nearest = i;
    weights = {};
    weights.at(nearest) = 1.0;
    return weights;
}

[[nodiscard]] std::size_t vertex(const glm::ivec3& triangle, std::size_t corner) {
    return static_cast<std::size_t>(triangle[static_cast<int>(corner)]);
}

/// Leaves the shares of a place's corners that snow lies on and that are under something as the place is, or
/// not; all of them, where there are none of that kind.
void keep_alike(std::array<double, 3>& weights, const glm::ivec3& triangle, const glm::dvec3& point,
                const Holding& holding, Shelter& shelter) {
    std::array<bool, 3> is_meant{};
    std::size_t sheltered = 0, held = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t at = vertex(triangle, corner);
        is_meant.at(corner) = holding.holds(at);
        held += holding.holds(at) ? 1 : 0;
        sheltered += holding.holds(at) && holding.is_sheltered[at] != 0 ? 1 : 0;
    }
    if (sheltered > 0 && sheltered < held) {
        const bool is_sheltered = shelter.is_over(point);
        for (std::size_t corner = 0; corner < 3; ++corner)
            if ((holding.is_sheltered[vertex(triangle, corner)] != 0) != is_sheltered)
                is_meant.at(corner) = false;
    }
    double sum = 0.0, count = 0.0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        if (!is_meant.at(corner)) continue;
        sum += weights.at(corner);
        count += 1.0;
    }
    if (count == 0.0 || count == 3.0) return;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const double share = sum > 0.0 ? weights.at(corner) / sum : 1.0 / count;
        weights.at(corner) = is_meant.at(corner) ? share : 0.0;
    }
}
[[nodiscard]] std::array<glm::dvec3, 3> corners_of(const Collider& collider, const glm::ivec3& triangle) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(collider.positions()[vertex(triangle, i)]); };
    return {corner(0), corner(1), corner(2)};
}

/// Adds to each corner's area what a triangle of snow adds to the volume for each metre of depth there.
void add_areas(const Collider& collider, const Holding& holding, const glm::ivec3& triangle, Shelter& shelter,
               std::vector<double>& areas) {
    const auto [a, b, c] = corners_of(collider, triangle);
    const double third = length_of(glm::cross(b - a, c - a)) / 6.0;
    std::array<std::optional<float>, 3> ends;  // on the sides that leave the corners
    for (std::size_t corner = 0; corner < 3; ++corner)
        ends.at(corner) = end_on_edge(holding, collider.positions(), shelter, vertex(triangle, corner),
                                      vertex(triangle, (corner + 1) % 3));
    const std::array<double, 3> parts = shown_parts(ends);
    for (std::size_t corner = 0; corner < 3; ++corner)
        areas.at(vertex(triangle, corner)) += parts.at(corner) * third;
}

}  // namespace

double steepest_slope(double repose) {
    return tangent(repose) * (1.0 + grip_range);
}

struct Cover::Deposit {
    std::array<std::uint32_t, 3> vertices{};
    std::array<float, 3> weights{};
    bool lies = false;
};

Cover::Cover(const Snow& snow, const CoverSettings& settings, const Executor& executor)
    : flake_volume_(settings.flake_volume), rounds_(settings.smoothing) {
    require(snow.collider() != nullptr, "snow: must have a collider");
    require(settings.flake_volume > 0.0 && settings.flake_volume <= 1e30,
            "flake_volume: must be greater than 0 and finite");
    require(settings.repose >= 0.0 && settings.repose < 0.5 * std::numbers::pi,
            "repose: must be from 0 to less than pi / 2");
    require(settings.smoothing >= 0 && settings.smoothing <= CoverSettings::most_rounds,
            "smoothing: must be from 0 to 1000");
    std::vector<Touchdown> downs = snow.touchdowns(settings.end, executor);
    std::erase_if(downs, [](const Touchdown& down) { return down.triangle < 0; });

    in_ieee_floats([&] {
        const Collider& collider = *snow.collider();
        const glm::dvec3 pull = snow.acceleration();
        const double hold = tangent(settings.repose);
        const glm::dvec3 up = -unit_vector(pull);
        const Holding holding = holding_of(collider.positions(), collider.triangles(), collider, up,
                                           steepest_slope(settings.repose), executor);
        std::vector<Deposit> deposits(downs.size());
        const auto find = [&](std::size_t first, std::size_t last) {
            std::vector<Slide> slides;
            Shelter shelter(collider, up);
            for (std::size_t i = first; i < last; ++i) {
                const Touchdown& down = downs[i];
                const double friction = hold * (1.0 + grip_range * grip_of(down.id));
                const auto place = resting_place(
                    collider, {static_cast<std::uint32_t>(down.triangle), down.is_behind, down.point}, pull,
                    friction, slides);
                if (!place) continue;
                const glm::ivec3& triangle = collider.triangles()[place->triangle];
                auto weights = weights_of(corners_of(collider, triangle), place->point);
                keep_alike(weights, triangle, place->point, holding, shelter);
                deposits[i].lies = true;
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    deposits[i].vertices.at(corner) = static_cast<std::uint32_t>(vertex(triangle, corner));
                    deposits[i].weights.at(corner) = static_cast<float>(weights.at(corner));
                }
            }
        };
        in_parts(downs.size(), grain, find, executor);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < downs.size(); ++i) {
            if (!deposits[i].lies) continue;
            times_.push_back(downs[i].time);
            deposits[kept++] = deposits[i];
        }
        deposits.resize(kept);

        areas_.resize(collider.positions().size());
        Shelter shelter(collider, up);
        for (const glm::ivec3& triangle : collider.triangles())
            add_areas(collider, holding, triangle, shelter, areas_);
        deposit(deposits, settings.flake_volume);
        if (rounds_ > 0) link_neighbours(collider, holding);
    });
}

void Cover::deposit(std::span<const Deposit> deposits, double volume) {
    starts_.assign(areas_.size() + 1, 0);
    for (const Deposit& one : deposits)
        for (const std::uint32_t at : one.vertices) ++starts_[at + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    events_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    std::vector<double> sums(areas_.size());
    for (std::size_t i = 0; i < deposits.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t at = deposits[i].vertices.at(corner);
            // Of a vertex that no triangle with an area is around nothing can be said.
            if (areas_[at] > 0.0)
                sums[at] += static_cast<double>(deposits[i].weights.at(corner)) * volume / areas_[at];
            events_[next[at]++] = {static_cast<std::uint32_t>(i),
                                   static_cast<float>(std::min(sums[at], highest))};
        }
    }
}

void Cover::link_neighbours(const Collider& collider, const Holding& holding) {
    const std::size_t count = areas_.size();
    const auto around = mesh::Neighbours::of_triangles(count, collider.triangles());
    const auto share_out = [&](std::size_t i) {
        return 0.5 * areas_[i] / static_cast<double>(around.edge_ends(static_cast<std::uint32_t>(i)).size());
    };
    link_starts_.assign(1, 0);
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::uint32_t other : around.edge_ends(static_cast<std::uint32_t>(i))) {
            if (!holding.holds(i) || !holding.holds(other)) continue;
            if (holding.is_sheltered[i] != holding.is_sheltered[other]) continue;
            links_.push_back(other);
            // As much as the other one takes.
            shares_.push_back(static_cast<float>(std::min(share_out(i), share_out(other)) / areas_[i]));
        }
        link_starts_.push_back(links_.size());
    }
}

std::size_t Cover::lying(double time) const {
    require(std::isfinite(time), "time: must be finite");
    return static_cast<std::size_t>(std::ranges::upper_bound(times_, time) - times_.begin());
}

void Cover::heights(double time, std::span<float> out, const Executor& executor) const {
    require(out.size() == vertex_count(), "out: must have a height for each vertex");
    const std::size_t count = lying(time);
    in_ieee_floats([&] {
        in_parts(
            out.size(), grain,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    const auto events = std::span(events_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
                    const auto next = std::ranges::lower_bound(events, count, {}, &Event::flake);
                    out[i] = next == events.begin() ? 0.0F : (next - 1)->height;
                }
            },
            executor);
        std::vector<float> before;
        for (int round = 0; round < rounds_; ++round) {
            before.assign(out.begin(), out.end());
            in_parts(
                out.size(), grain,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i)
                        for (std::size_t link = link_starts_[i]; link < link_starts_[i + 1]; ++link)
                            out[i] += shares_[link] * (before[links_[link]] - before[i]);
                },
                executor);
        }
    });
}

double Cover::volume(double time) const {
    return flake_volume_ * static_cast<double>(lying(time));
}

}  // namespace motus::snow
