#include "motus/mesh/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "motus/core/ieee_floats.hpp"
#include "surface_agenda.hpp"
#include "surface_places.hpp"
#include "surface_unfold.hpp"

namespace motus::mesh {
namespace {

/// A triangle at the vertex that is being settled, with its neighbours.
struct Spoke {
    SurfacePlace* a;
    SurfacePlace* b;
    std::uint32_t vertex_a, vertex_b;
    double a2, b2, dot, area;  ///< of the sides to a and b
};

class Search {
  public:
    Search(std::span<const glm::vec3> positions, const Neighbours& neighbours, std::uint32_t root,
           float radius, const glm::mat3& metric)
        : positions_(positions),
          neighbours_(neighbours),
          origin_(positions[root]),
          metric_(metric),
          radius_(radius),
          places_(positions.size()),
          agenda_(0.03125f * mean_side(root), radius) {
        SurfacePlace& start = places_[root];
        start.position = glm::vec3(0.0f);
        start.straight = start.distance = 0.0f;
        settle(start, root);
    }

    [[nodiscard]] Reach run() {
        const auto is_stale = [this](const Due& due) {
            return due.distance() > places_[due.vertex()].distance;
        };
        const auto expect = [this](const std::vector<Due>& all) { fetch(all); };
        while (agenda_.has_next(is_stale, expect)) {
            const Due due = agenda_.take();
            if (is_stale(due)) continue;
            SurfacePlace& next = places_[due.vertex()];
            if (next.distance <= radius_ || leads_back(next, due.vertex())) settle(next, due.vertex());
        }
        Reach reach;
        places_.each([&](std::uint32_t vertex, const SurfacePlace& there) {
            if (!(there.distance >= 0.0f && there.distance <= std::min(radius_, largest))) return;
            reach.vertices.push_back(vertex);
            reach.distances.push_back(there.distance);
        });
        return reach;
    }

  private:
    static constexpr float largest = std::numeric_limits<float>::max();

    /// Prefetches the memory that settling these vertices reads: otherwise half of the time is waiting for
    /// memory.
    void fetch(const std::vector<Due>& all) {
        for (const Due& due : all) __builtin_prefetch(neighbours_.fan(due.vertex()).data());
        for (const Due& due : all) {
            for (const glm::uvec2 others : neighbours_.fan(due.vertex())) {
                __builtin_prefetch(&positions_[others.x]);
                __builtin_prefetch(&places_[others.x]);
            }
        }
    }

    /// SurfacePlace of a vertex, with its position.
    [[nodiscard]] SurfacePlace& placed(std::uint32_t vertex) {
        SurfacePlace& there = places_[vertex];
        if (there.straight < 0.0f) [[unlikely]] {
            there.position = metric_ * (positions_[vertex] - origin_);
            there.straight = static_cast<float>(glm::length(glm::dvec3(there.position)));
            if (!(there.straight <= largest)) {
                there.straight = 0.0f;
                there.distance = -std::numeric_limits<float>::infinity();
            }
        }
        return there;
    }

    [[nodiscard]] float mean_side(std::uint32_t vertex) const {
        float sum = 0.0f;
        float count = 0.0f;
        for (const glm::uvec2 others : neighbours_.fan(vertex)) {
            const float length = glm::length(metric_ * (positions_[others.x] - positions_[vertex]));
            if (!(length <= largest)) continue;
            sum += length;
            count += 1.0f;
        }
        return count > 0.0f ? sum / count : 0.0f;
    }

    /// Whether a place beyond the radius has sides so long that vertices behind them may lie within the
    /// radius.
    [[nodiscard]] bool leads_back(const SurfacePlace& from, std::uint32_t vertex) {
        const float beyond = from.distance - radius_;
        const auto is_long = [&](std::uint32_t other) {
            const glm::vec3 side = placed(other).position - from.position;
            return glm::dot(side, side) >= beyond * beyond;
        };
        return std::ranges::any_of(neighbours_.fan(vertex),
                                   [&](glm::uvec2 others) { return is_long(others.x) || is_long(others.y); });
    }

    void improve(SurfacePlace& there, std::uint32_t vertex, const Way& way) {
        // Behind long thin triangles corrections trickle on and on; smaller ones are not told to the
        // neighbours.
        constexpr float worth_telling = 1e-4f;  // of the distance
        constexpr std::uint32_t most = 1000;    // a stop, should rounding ever have it go round in circles
        const float distance = std::max(static_cast<float>(way.distance), there.straight);
        const float bar =
            there.settled == 0 ? there.distance : there.distance - worth_telling * there.distance;
        if (!(distance < bar) || there.settled > most) return;
        there.distance = distance;
        there.spread = static_cast<float>(way.spread);
        agenda_.add(distance, vertex);
    }

    /// Whether a settled place can be no nearer across the side from -> other, `from` being farther: no
    /// straight line through that side fits the angle there. The arguments are of the triangle's corner at
    /// the place.
    [[nodiscard]] static bool is_out_of_question(const SurfacePlace& from, const SurfacePlace& to,
                                                 double from2, double other2, double dot) {
        const double twice = 2.0 * to.distance * dot;
        return from.distance >= to.distance && dot > 0.0 && twice * twice >= from2 * from2 * other2;
    }

    void cross(const SurfacePlace& from, const Spoke& spoke, const SurfacePlace& other, SurfacePlace& to,
               std::uint32_t vertex, double side2, double far2) {
        if (to.settled > 0 &&
            is_out_of_question(from, to, far2, spoke.a2 + spoke.b2 - 2.0 * spoke.dot, far2 - spoke.dot))
            return;
        improve(to, vertex, way_across({side2, far2, spoke.dot, spoke.area}, from, other));
    }

    /// Passes the distances that lead through `from` on to its neighbours.
    void settle(SurfacePlace& from, std::uint32_t vertex) {
        look_around(from, vertex);
        ++from.settled;
        for (const Spoke& spoke : spokes_) {
            SurfacePlace& a = *spoke.a;
            SurfacePlace& b = *spoke.b;
            if (a.settled > 0) {
                cross(from, spoke, a, b, spoke.vertex_b, spoke.a2, spoke.b2);
            } else if (b.settled == 0) {
                improve(a, spoke.vertex_a, way_along(from, spoke.a2));
                improve(b, spoke.vertex_b, way_along(from, spoke.b2));
            }
            if (b.settled > 0) cross(from, spoke, b, a, spoke.vertex_a, spoke.b2, spoke.a2);
        }
    }

    /// Lists the triangles at a vertex, and finds the surface's curvature there from their angles.
    void look_around(SurfacePlace& from, std::uint32_t vertex) {
        spokes_.clear();
        double cosine = 1.0;  // of all angles together
        double sine = 0.0;
        double area = 0.0;
        for (const glm::uvec2 others : neighbours_.fan(vertex)) {
            SurfacePlace& a = placed(others.x);
            SurfacePlace& b = placed(others.y);
            const glm::dvec3 to_a = glm::dvec3(a.position) - glm::dvec3(from.position);
            const glm::dvec3 to_b = glm::dvec3(b.position) - glm::dvec3(from.position);
            Spoke spoke{&a,
                        &b,
                        others.x,
                        others.y,
                        glm::dot(to_a, to_a),
                        glm::dot(to_b, to_b),
                        glm::dot(to_a, to_b),
                        glm::length(glm::cross(to_a, to_b))};
            spokes_.push_back(spoke);
            const double size = std::abs(spoke.dot) + spoke.area;
            if (!(size > 0.0)) continue;
            const double scale = 1.0 / size;
            const double turned = (cosine * spoke.dot - sine * spoke.area) * scale;
            sine = (cosine * spoke.area + sine * spoke.dot) * scale;
            cosine = turned;
            area += spoke.area;
        }
        if (from.settled > 0) return;
        // The angle missing from a full turn; at an edge of the surface, a spike or a crease that is no
        // curvature.
        const double missing = cosine > 0.0 ? -sine / std::sqrt(cosine * cosine + sine * sine) : 0.0;
        const double trust = 1.0 - missing * missing / (0.3 * 0.3);
        const double least = 1e-5;  // rounding of a flat surface
        const double curvature = 6.0 * trust * missing / area;
        if (trust > 0.0 && std::abs(missing) > least && std::abs(curvature) <= static_cast<double>(largest))
            from.curvature = static_cast<float>(curvature);
    }

    std::span<const glm::vec3> positions_;
    const Neighbours& neighbours_;
    glm::vec3 origin_;
    glm::mat3 metric_;
    float radius_;
    Pages<SurfacePlace> places_;
    Agenda agenda_;
    std::vector<Spoke> spokes_;
};

/// How many edges away a vertex is.
struct Steps {
    static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t count = unknown;
};

}  // namespace

Reach surface_reach(std::span<const glm::vec3> positions, const Neighbours& neighbours, std::uint32_t root,
                    float radius, const glm::mat3& metric) {
    if (positions.size() != neighbours.vertex_count())
        throw std::invalid_argument("positions: must be as many as the vertices of neighbours");
    if (root >= positions.size()) throw std::invalid_argument("root: must be the index of a vertex");
    if (!(radius >= 0.0f)) throw std::invalid_argument("radius: must be 0 or more");
    return in_ieee_floats([&] { return Search(positions, neighbours, root, radius, metric).run(); });
}

Reach edge_reach(const Neighbours& neighbours, std::uint32_t root, std::uint32_t steps) {
    if (root >= neighbours.vertex_count()) throw std::invalid_argument("root: must be the index of a vertex");
    Pages<Steps> away(neighbours.vertex_count());
    away[root].count = 0;
    std::vector<std::uint32_t> ring{root};
    std::vector<std::uint32_t> next;
    for (std::uint32_t step = 1; step <= steps && !ring.empty(); ++step) {
        next.clear();
        for (const std::uint32_t vertex : ring) {
            for (const std::uint32_t end : neighbours.edge_ends(vertex)) {
                if (away[end].count != Steps::unknown) continue;
                away[end].count = step;
                next.push_back(end);
            }
        }
        ring.swap(next);
    }
    Reach reach;
    away.each([&](std::uint32_t vertex, const Steps& there) {
        if (there.count == Steps::unknown) return;
        reach.vertices.push_back(vertex);
        reach.distances.push_back(static_cast<float>(there.count));
    });
    return reach;
}

}  // namespace motus::mesh
