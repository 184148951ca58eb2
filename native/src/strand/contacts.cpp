#include "contacts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>

#include "contact.hpp"
#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

/// m; what lies nearer to a surface may be behind it by rounding.
constexpr double least_reach = 1e-5;

/// A space that is turned, moved and scaled evenly.
class Space {
  public:
    explicit Space(const glm::dmat4& matrix)
        : axes_(matrix),
          origin_(matrix[3]),
          scale_(glm::length(axes_[0])),
          back_(glm::transpose(axes_) / (scale_ * scale_)) {}

    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] glm::dvec3 inside(const glm::dvec3& place) const { return back_ * (place - origin_); }
    [[nodiscard]] glm::dvec3 outside(const glm::dvec3& place) const { return axes_ * place + origin_; }
    [[nodiscard]] glm::dvec3 direction_outside(const glm::dvec3& direction) const {
        return direction_or(axes_ * direction, glm::dvec3(0.0));
    }

  private:
    glm::dmat3 axes_;
    glm::dvec3 origin_;
    double scale_;
    glm::dmat3 back_;
};

/// Where and how a place that moves keeps away from a surface, in the surface's own space.
struct SurfaceContact {
    glm::dvec3 point{0.0};   ///< of the surface
    glm::dvec3 normal{0.0};  ///< away from it
    double depth = 0.0;      ///< by how much it is too near
};

[[nodiscard]] glm::dvec3 normal_of(const Surface& surface, const mesh::Hit& hit) {
    const auto corner = [&](std::size_t which) {
        return glm::dvec3(surface.positions()[hit.corners[which]]);
    };
    return direction_or(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), glm::dvec3(0.0));
}

/// Which side a place belongs to: if it has crossed the surface in this step, the side that it came from;
/// else the side that it is on. reach: how far from the surface it should be; slack: by how much more it may
/// be, and still is in contact.
[[nodiscard]] std::optional<SurfaceContact> surface_contact(const Surface& surface, const glm::dvec3& before,
                                                            const glm::dvec3& now, double reach,
                                                            double slack) {
    const glm::dvec3 way = now - before;
    const auto away_from = [&](const mesh::Hit& hit) {
        const glm::dvec3 normal = normal_of(surface, hit);
        return glm::dot(normal, before - hit.point) < 0.0 ? -normal : normal;
    };
    if (const auto hit = surface.picker().ray(before, way, glm::length(way))) {
        const glm::dvec3 normal = away_from(*hit);
        return SurfaceContact{hit->point, normal, reach - glm::dot(now - hit->point, normal)};
    }
    const auto nearest = surface.picker().nearest_on_surface(now, reach + slack);
    if (!nearest || !(nearest->distance < reach + slack)) return std::nullopt;
    const glm::dvec3 normal = direction_or(now - nearest->point, away_from(*nearest));
    return SurfaceContact{nearest->point, normal, reach - nearest->distance};
}

}  // namespace

Contacts::Contacts(std::span<const Link> links, std::span<const Obstacle> obstacles,
                   std::span<const PlacedSurface> surfaces)
    : obstacles_(obstacles.begin(), obstacles.end()), surfaces_(surfaces.begin(), surfaces.end()) {
    for (const Link& link : links) bodies_.push_back({link.parent, link.thickness});
    frictions_.resize((obstacles.size() + 2 * surfaces.size()) * links.size());
}

void Contacts::begin() {
    std::fill(frictions_.begin(), frictions_.end(), Friction{});
}

void Contacts::resolve_obstacles(const Stepped& step, std::span<const glm::dvec3> before,
                                 std::span<const glm::dvec3> now, double duration) {
    for (std::size_t k = 0; k < obstacles_.size(); ++k) {
        const Obstacle& obstacle = obstacles_[k];
        const glm::dvec3 start = now[2 * k], axis = now[2 * k + 1] - start;
        const glm::dvec3 carried1 = start - before[2 * k], carried2 = now[2 * k + 1] - before[2 * k + 1];
        if (obstacle.shape == Obstacle::Shape::plane) {
            const glm::dvec3 normal = direction_or(axis, glm::dvec3(0.0));
            if (normal == glm::dvec3(0.0)) continue;
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                const double depth =
                    obstacle.radius + bodies_[i].thickness - glm::dot(step.state.places[i] - start, normal);
                Friction& friction = frictions_[k * bodies_.size() + i];
                if (depth > -friction.pushed)
                    resolve({{{{i, 1.0}}}, 1, normal, depth, carried1}, obstacle.friction, duration, step,
                            friction);
            }
            continue;
        }
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (bodies_[i].parent < 0) continue;
            const auto parent = static_cast<std::size_t>(bodies_[i].parent);
            const glm::dvec3 root = step.state.places[parent];
            const glm::dvec3 link = step.state.places[i] - root;
            const double reach = obstacle.radius + bodies_[i].thickness;
            Shares shares = nearest(root, link, start, axis);
            // Where an end that is held is in the obstacle itself, no turn brings the link out: its other end
            // is to be.
            const auto is_stuck = [&](std::size_t end) {
                const glm::dvec3 place = step.state.places[end];
                const double along = nearest(place, glm::dvec3(0.0), start, axis).second;
                return !(step.mobilities[end].displacement > 0.0) &&
                       glm::length(place - start - along * axis) < reach;
            };
            if (is_stuck(parent) || is_stuck(i)) {
                const std::size_t end = is_stuck(parent) ? i : parent;
                shares.first = end == i ? 1.0 : 0.0;
                shares.second = nearest(step.state.places[end], glm::dvec3(0.0), start, axis).second;
            }
            const glm::dvec3 apart = root + shares.first * link - (start + shares.second * axis);
            const double square = glm::dot(apart, apart);
            Friction& friction = frictions_[k * bodies_.size() + i];
            const double near = reach + friction.pushed;
            if (!(square < near * near)) continue;
            const double distance = std::sqrt(square);
            // From the very middle the way out is any.
            const glm::dvec3 normal = direction_or(apart, glm::dvec3(0.0, 0.0, 1.0));
            Contact contact = contact_on_link(parent, i, shares.first);
            contact.normal = normal;
            contact.depth = reach - distance;
            contact.carried = carried1 + shares.second * (carried2 - carried1);
            resolve(contact, obstacle.friction, duration, step, friction);
        }
    }
}

void Contacts::resolve_surfaces(const Stepped& step, std::span<const glm::dmat4> before,
                                std::span<const glm::dmat4> now, double duration) {
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        const Space space_before(before[k]), space(now[k]);
        // Ends first: where they lie on the surface, middles are not in it, and each end's friction is its
        // own.
        for (const double share : {1.0, 0.5}) {
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                if (bodies_[i].parent < 0) continue;
                const auto parent = static_cast<std::size_t>(bodies_[i].parent);
                const auto mixed = [&](const auto& of) { return (1.0 - share) * of[parent] + share * of[i]; };
                const double reach =
                    std::max(surfaces_[k].distance + bodies_[i].thickness, least_reach) / space.scale();
                const std::size_t row = obstacles_.size() + 2 * k + (share < 1.0 ? 1 : 0);
                Friction& friction = frictions_[row * bodies_.size() + i];
                const auto found = surface_contact(
                    *surfaces_[k].surface, space_before.inside(mixed(step.before)),
                    space.inside(mixed(step.state.places)), reach, friction.pushed / space.scale());
                if (!found) continue;
                Contact contact = contact_on_link(parent, i, share);
                contact.normal = space.direction_outside(found->normal);
                contact.depth = found->depth * space.scale();
                contact.carried = space.outside(found->point) - space_before.outside(found->point);
                resolve(contact, surfaces_[k].friction, duration, step, friction);
            }
        }
    }
}

}  // namespace motus::strand
