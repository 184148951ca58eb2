#include "footing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

#include "motus/core/numeric.hpp"
#include "motus/walker/step.hpp"

namespace motus::walker {
namespace {

[[nodiscard]] std::optional<Contact> first_between(const Ground& ground, const glm::dvec3& from,
                                                   const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const glm::dvec3 direction = unit_vector(way);
    if (direction == glm::dvec3(0.0)) return std::nullopt;
    return ground.ray(from, direction, length_of(way));
}

/// The place above or below the hip that is level with another place.
[[nodiscard]] glm::dvec3 over_hip(const Search& search, const glm::dvec3& level) {
    return search.hip + search.up * glm::dot(level - search.hip, search.up);
}

/// Most faces above a place that are examined; no roof is found beyond them.
constexpr std::size_t most_faces = 64;

/// How far above a place the search for ground begins, at most `most`. Less below a roof: a face that looks
/// down on air through which one can go, with a floor below. A place may lie within the ground, or within
/// stones that lie within each other.
[[nodiscard]] double room_above(const Ground& ground, const glm::dvec3& place, const glm::dvec3& up,
                                double most) {
    struct Face {
        double height = 0.0;
        bool leaves = false;
    };
    constexpr double same = 1e-6;     // of the place's coordinates: faces that touch are met once
    constexpr double low = 0.1;       // of `most`: lower air is a crack between stones
    constexpr double below_it = 0.9;  // of the air's height
    std::array<Face, most_faces> faces;
    std::size_t count = 0;
    const double skip = same * (1.0 + length_of(place));
    // Further up than `most` too, since the place is within what is left there without being entered before.
    for (double height = skip;; height = faces[count - 1].height + skip) {
        const auto met = ground.ray(place + height * up, up, std::numeric_limits<double>::infinity());
        if (!met) break;
        if (count == most_faces) return most;
        faces[count++] = {height + met->distance, met->leaves};
    }
    const std::span<const Face> above(faces.data(), count);
    int within = 0, left = 0;
    for (const Face& face : above) {
        left += face.leaves ? 1 : -1;
        within = std::max(within, left);
    }
    // Without a floor below, the face is ground whose faces are turned over.
    const auto has_floor = [&](double height) {
        return height > 0.0 || ground.ray(place + skip * up, -up, std::numeric_limits<double>::infinity());
    };
    double air = 0.0;  // from there on, while it is within nothing
    for (const Face& face : above) {
        if (face.leaves) {
            --within;
            air = face.height;
        } else if (within == 0 && face.height - air > low * most && has_floor(air)) {
            return std::min(most, air + below_it * (face.height - air));
        } else {
            ++within;
        }
    }
    return most;
}

/// Intervals of a swing's way, at whose ends the height of the ground is looked up.
constexpr std::size_t intervals = 8;

/// The fraction of the swing's time at which the foot is at this share of its way.
[[nodiscard]] constexpr double fraction_at(double way) {
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (along(middle) < way ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

[[nodiscard]] constexpr std::array<double, intervals - 1> fractions_of_looks() {
    std::array<double, intervals - 1> result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result.at(i) = fraction_at(static_cast<double>(i + 1) / static_cast<double>(intervals));
    return result;
}
constexpr std::array<double, intervals - 1> fractions = fractions_of_looks();

/// How high the ground is above the line of a swing.
class Profile {
  public:
    Profile(const Ground& ground, const glm::dvec3& start, const glm::dvec3& end, const glm::dvec3& up,
            double reach)
        : ground_(ground),
          start_(start),
          way_(end - start),
          up_(up),
          reach_(reach),
          length_(length_of(way_)) {}

    [[nodiscard]] double length() const { return length_; }

    /// Height of the ground at a share of the way, m; below 0 under the line; -length() if there is no
    /// ground.
    [[nodiscard]] double height(double share) const {
        const glm::dvec3 place = start_ + way_ * share;
        const auto from = [&](double room) {
            const auto met = ground_.ray(place + room * up_, -up_, room + length_);
            return met ? room - met->distance : -length_;
        };
        const double highest = from(reach_);
        if (highest <= 0.0) return highest;
        // Roofs are looked for where anything is met above the line at all, which is quicker.
        const double room = room_above(ground_, place, up_, reach_);
        return room < reach_ ? from(room) : highest;
    }

  private:
    const Ground& ground_;
    glm::dvec3 start_, way_, up_;
    double reach_, length_;
};

/// A height above the line of a swing that a foot has to pass over, at a fraction of the swing if it goes
/// along its way for the whole of it.
struct Hurdle {
    double fraction = 0.0;
    double height = 0.0;
};

/// List of hurdles with room for one at each looked-up place and two at each edge.
class Hurdles {
  public:
    void add(double fraction, double height) {
        if (height > 0.0) hurdles_.at(count_++) = {fraction, height};
    }
    [[nodiscard]] std::span<const Hurdle> all() const { return {hurdles_.data(), count_}; }

  private:
    std::array<Hurdle, 3 * intervals> hurdles_{};
    std::size_t count_ = 0;
};

struct Look {
    double share = 0.0;
    double height = 0.0;
};

/// The places on both sides of the edge between two places of a way; none if the ground goes on evenly.
[[nodiscard]] std::optional<std::pair<Look, Look>> edge_between(const Profile& profile, Look low, Look high) {
    constexpr double steep = 0.25;  // of the way: what rises or falls less is not looked through
    constexpr int first_halvings = 4, halvings = 17;
    const auto step = [&] { return std::abs(high.height - low.height); };
    const double whole = step();
    if (!(whole > steep * profile.length() * (high.share - low.share))) return std::nullopt;
    for (int halving = 0; halving < halvings; ++halving) {
        // Of an even slope, a sixteenth of the height difference is left after these halvings.
        if (halving == first_halvings && step() < 0.5 * whole) return std::nullopt;
        const double share = 0.5 * (low.share + high.share);
        const Look middle{share, profile.height(share)};
        (std::abs(middle.height - low.height) > std::abs(high.height - middle.height) ? high : low) = middle;
    }
    return std::pair{low, high};
}

/// How much a swing has to rise half-way to pass over the hurdles, if it goes straight up and down for these
/// fractions of it.
[[nodiscard]] double rise_over(std::span<const Hurdle> hurdles, double upwards, double downwards) {
    double highest = 0.0;
    for (const Hurdle& hurdle : hurdles)
        highest =
            std::max(highest, hurdle.height / above(upwards + (1.0 - upwards - downwards) * hurdle.fraction));
    return highest;
}

}  // namespace

std::optional<Contact> footing(const Ground& ground, const Search& search, const Reach& reach) {
    // Lowered by as much as an obstacle above the hip requires.
    const double level = reach.up + glm::dot(search.rest - search.hip, search.up);
    const double lower = level > 0.0 ? level - room_above(ground, search.hip, search.up, level) : 0.0;
    const double over_rest = room_above(ground, search.rest, search.up, reach.up);
    const glm::dvec3 above = search.rest + std::max(0.0, std::min(over_rest, reach.up - lower)) * search.up;
    if (const auto wall = first_between(ground, over_hip(search, above), above)) return wall;
    return first_between(ground, above, search.rest - reach.down * search.up);
}

std::optional<Contact> footing_around_edge(const Ground& ground, const Search& search, const Reach& reach) {
    const glm::dvec3 below = search.rest - reach.down * search.up;
    return first_between(ground, below, over_hip(search, below));
}

Clearing clearing(const Ground& ground, const glm::dvec3& start, const glm::dvec3& end, const glm::dvec3& up,
                  double reach) {
    const Profile profile(ground, start, end, up, reach);
    Hurdles hurdles;
    bool has_edges = false;
    Look before{0.0, 0.0};
    for (std::size_t i = 0; i < intervals; ++i) {
        const bool is_last = i == fractions.size();
        const double share = is_last ? 1.0 : along(fractions.at(i));
        const Look look{share, is_last ? 0.0 : profile.height(share)};
        if (!is_last) hurdles.add(fractions.at(i), look.height);
        if (const auto edge = edge_between(profile, before, look)) {
            const double height = std::max(edge->first.height, edge->second.height);
            for (const Look& side : {edge->first, edge->second}) hurdles.add(fraction_at(side.share), height);
            has_edges = has_edges || height > 0.0;
        }
        before = look;
    }
    Clearing best{rise_over(hurdles.all(), 0.0, 0.0)};
    if (!has_edges) return best;
    // A foot close to an edge moves faster along its way rather than rising high.
    constexpr std::array parts{0.0, 0.125, 0.25, 0.375};
    const auto effort = [&](const Clearing& one) {
        return one.rise + 0.5 * profile.length() * (1.0 / (1.0 - one.upwards - one.downwards) - 1.0);
    };
    for (const double upwards : parts) {
        for (const double downwards : parts) {
            const Clearing one{rise_over(hurdles.all(), upwards, downwards), upwards, downwards};
            if (effort(one) < effort(best)) best = one;
        }
    }
    return best;
}

}  // namespace motus::walker
