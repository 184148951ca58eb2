#include "motus/curve/arc_length.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "inverse_table.hpp"
#include "motus/core/numeric.hpp"
#include "motus/curve/arc_length_cache.hpp"
#include "speed_table.hpp"

namespace motus::curve {
namespace {

// About 100 kB each: a shot with as many paths, or as many steps back of one that is being edited.
constexpr std::size_t cached_tables = 128;

}  // namespace

ArcLength::ArcLength(Curve curve)
    : curve_(std::move(curve)), speed_(std::make_unique<SpeedTable>(curve_)), length_(speed_->length()) {}

ArcLength::~ArcLength() = default;

double ArcLength::length_at(double t) const {
    if (t <= 0.0) return 0.0;
    if (t >= static_cast<double>(curve_.segment_count())) return length_;
    return speed_->length_at(locate(curve_, t));
}

double ArcLength::t_at_length(double s) const {
    if (s > 0.0 && s < length_) return inverse().t_at(s);
    if (std::isnan(s)) return s;
    if (s <= 0.0 || length_ == 0.0) return 0.0;
    return static_cast<double>(curve_.segment_count());
}

double ArcLength::segment_start(std::size_t index) const {
    require(index <= curve_.segment_count(), "index: must be one of a segment, or segment_count()");
    return speed_->segment_start(index);
}

std::size_t ArcLength::evaluation_count() const noexcept {
    return speed_->evaluation_count();
}

std::size_t ArcLength::interval_count() const {
    return length_ > 0.0 ? inverse().interval_count() : 0;
}

std::size_t ArcLength::bytes() const noexcept {
    const InverseTable* inverse = inverse_.load(std::memory_order_acquire);
    return sizeof *this + curve_.control_points().size_bytes() + speed_->bytes() +
           (inverse != nullptr ? inverse->bytes() : 0);
}

const InverseTable& ArcLength::inverse() const {
    if (const InverseTable* built = inverse_.load(std::memory_order_acquire)) return *built;
    const std::scoped_lock lock(building_);
    if (!inverse_owner_) {
        inverse_owner_ = std::make_unique<InverseTable>(*speed_);
        inverse_.store(inverse_owner_.get(), std::memory_order_release);
    }
    return *inverse_owner_;
}

double length_at(const ArcLength& path, double t, Extend extend) {
    const Extended at = extended(t, static_cast<double>(path.curve().segment_count()), extend);
    const double inside = path.length_at(at.value);
    if (at.beyond != 0.0) return inside + at.beyond * glm::length(derivative(path.curve(), at.value));
    return at.laps * path.length() + (at.returning ? -inside : inside);
}

Extended t_at_length(const ArcLength& path, double s, Extend extend) {
    if (path.length() == 0.0) return {path.t_at_length(s)};
    const Extended inside = extended(s, path.length(), extend);
    return {path.t_at_length(inside.value), inside.beyond};
}

glm::dvec3 position_at_length(const ArcLength& path, double s, Extend extend) {
    const Extended at = t_at_length(path, s, extend);
    const glm::dvec3 on_curve = position(path.curve(), at.value);
    if (at.beyond == 0.0) return on_curve;
    return on_curve + at.beyond * tangent(path.curve(), at.value);
}

void positions_at_length(const ArcLength& path, std::span<const double> s, Extend extend,
                         std::span<glm::dvec3> out) {
    if (out.size() != s.size()) throw std::invalid_argument("out: must be as long as s");
    for (std::size_t i = 0; i < s.size(); ++i) out[i] = position_at_length(path, s[i], extend);
}

std::size_t CurveHash::operator()(const Curve& curve) const noexcept {
    ContentHash hash;
    hash.add(static_cast<std::uint64_t>(curve.degree()) * 2 + (curve.cyclic() ? 1 : 0));
    hash.add(curve.control_points());
    return hash.value();
}

std::size_t ArcLengthBytes::operator()(const Curve& curve, const ArcLength& path) const noexcept {
    return curve.control_points().size_bytes() + path.bytes();
}

ArcLengthCache& arc_length_cache() {
    // Never destroyed: threads may still look up tables while the program exits.
    static ArcLengthCache& cache = *new ArcLengthCache(cached_tables);
    return cache;
}

std::shared_ptr<const ArcLength> shared_arc_length(const Curve& curve) {
    return arc_length_cache().get(curve,
                                  [](const Curve& key) { return std::make_shared<const ArcLength>(key); });
}

}  // namespace motus::curve
