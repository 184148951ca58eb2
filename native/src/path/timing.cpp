#include "motus/path/timing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::path {
namespace {

/// Two fractions typed as decimals or stored as float may add up to a little more than 1, as may shifted
/// laps.
constexpr double sum_rounding = 1e-7;

void check_ease(double ease_in, double ease_out) {
    require(ease_in >= 0.0 && ease_in <= 1.0, "ease_in: must be from 0 to 1");
    require(ease_out >= 0.0 && ease_out <= 1.0, "ease_out: must be from 0 to 1");
    require(ease_in + ease_out <= 1.0 + sum_rounding, "ease_out: must not be above 1 together with ease_in");
}

/// The checked shape of an ease: the ends of the middle part and the speed there.
struct Trapezium {
    double t1, t2, top_speed;

    Trapezium(double ease_in, double ease_out)
        : t1(ease_in), t2(std::max(ease_in, 1.0 - ease_out)), top_speed(2.0 / (1.0 + t2 - t1)) {}

    [[nodiscard]] double distance(double u) const {
        if (u <= 0.0) return 0.0;
        if (u >= 1.0) return 1.0;
        if (u < t1) return top_speed * u * u / (2.0 * t1);
        if (u <= t2) return top_speed * (u - 0.5 * t1);
        return 1.0 - top_speed * (1.0 - u) * (1.0 - u) /
                         (2.0 * (1.0 - t2));  // the same parabola, seen from its end
    }

    [[nodiscard]] double speed(double u) const {
        if (u < 0.0 || u > 1.0) return 0.0;
        if (u < t1) return top_speed * u / t1;
        if (u <= t2) return top_speed;
        return top_speed * (1.0 - u) / (1.0 - t2);
    }
};

void check_finite(std::span<const double> values, const char* name) {
    if (!are_finite(values)) throw std::invalid_argument(std::string(name) + ": must be finite");
}

/// Checks both columns of a profile: of one size, at least one row, finite, the first strictly increasing.
void check_profile(std::span<const double> keys, const char* keys_name, std::span<const double> values,
                   const char* values_name) {
    if (keys.empty()) throw std::invalid_argument(std::string(keys_name) + ": one at least is needed");
    if (keys.size() != values.size())
        throw std::invalid_argument(std::string(values_name) + ": must be as many as " + keys_name);
    check_finite(keys, keys_name);
    check_finite(values, values_name);
    if (std::adjacent_find(keys.begin(), keys.end(), std::greater_equal<>()) != keys.end()) {
        throw std::invalid_argument(std::string(keys_name) + ": must be strictly increasing");
    }
}

/// Weighted harmonic mean of the secants on both sides of a pin; 0 at a turning point, so that no piece
/// overshoots.
double inner_slope(double before_width, double before, double after_width, double after) {
    if (before * after <= 0.0) return 0.0;
    const double w1 = 2.0 * after_width + before_width;
    const double w2 = after_width + 2.0 * before_width;
    return (w1 + w2) / (w1 / before + w2 / after);
}

/// One-sided three-point slope at the first or last pin, kept within the monotone region.
double end_slope(double width, double secant, double next_width, double next_secant) {
    const double slope = ((2.0 * width + next_width) * secant - width * next_secant) / (width + next_width);
    if (slope * secant <= 0.0) return 0.0;
    if (secant * next_secant <= 0.0 && std::abs(slope) > 3.0 * std::abs(secant)) return 3.0 * secant;
    return slope;
}

std::vector<double> monotone_slopes(std::span<const double> x, std::span<const double> y) {
    const std::size_t count = x.size();
    const auto width = [&](std::size_t i) { return x[i + 1] - x[i]; };
    const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / width(i); };
    if (count == 2) return {secant(0), secant(0)};

    std::vector<double> slopes(count);
    slopes.front() = end_slope(width(0), secant(0), width(1), secant(1));
    slopes.back() = end_slope(width(count - 2), secant(count - 2), width(count - 3), secant(count - 3));
    for (std::size_t i = 1; i + 1 < count; ++i) {
        slopes[i] = inner_slope(width(i - 1), secant(i - 1), width(i), secant(i));
    }
    return slopes;
}

/// (e^x - 1) / x, 1 at 0.
double expm1_over(double x) {
    return x == 0.0 ? 1.0 : std::expm1(x) / x;
}

/// Time that a distance takes at a speed which changes evenly along it: the distance over the logarithmic
/// mean.
double time_across(double distance, double from_speed, double to_speed) {
    const double change = (to_speed - from_speed) / from_speed;
    if (change == 0.0) return distance / from_speed;
    // Near -1 the change has lost the digits that the ratio still has.
    const double logarithm = change > -0.5 ? std::log1p(change) : std::log(to_speed / from_speed);
    return distance / from_speed * (logarithm / change);
}

/// The last piece that begins at or before `time`; the first one before all.
template <class Piece>
const Piece& piece_at(const std::vector<Piece>& pieces, double time) {
    const auto after = std::upper_bound(pieces.begin(), pieces.end(), time,
                                        [](double value, const Piece& piece) { return value < piece.time; });
    return after == pieces.begin() ? pieces.front() : *std::prev(after);
}

}  // namespace

double ease(double u, double ease_in, double ease_out) {
    check_ease(ease_in, ease_out);
    require(std::isfinite(u), "u: must be finite");
    return Trapezium(ease_in, ease_out).distance(u);
}

double ease_derivative(double u, double ease_in, double ease_out) {
    check_ease(ease_in, ease_out);
    require(std::isfinite(u), "u: must be finite");
    return Trapezium(ease_in, ease_out).speed(u);
}

double Timing::Eased::distance(double time) const {
    const Trapezium shape(ease_in, ease_out);
    if (time <= duration || after == AfterEase::rest) return length * shape.distance(time / duration);
    if (after == AfterEase::go_on) return length + (time - duration) * (length / duration * shape.speed(1.0));
    const double laps = std::floor(time / duration);
    return length * shape.distance((time - laps * duration) / duration) + laps * length;
}

double Timing::Eased::speed(double time) const {
    double u = time / duration;
    if (u > 1.0 && after == AfterEase::go_on) u = 1.0;
    // Rounding may put a joint a little before the lap that begins there.
    if (u >= 1.0 && after == AfterEase::repeat) u = std::max(0.0, time - std::floor(u) * duration) / duration;
    return length / duration * Trapezium(ease_in, ease_out).speed(u);
}

const Timing::Cubic& Timing::Cubics::at(double time) const {
    return piece_at(pieces, time);
}

double Timing::Cubics::distance(double time) const {
    const Cubic& c = at(time);
    const double h = time - c.time;
    return c.value + h * (c.slope + h * (c.bend + h * c.twist));
}

double Timing::Cubics::speed(double time) const {
    const Cubic& c = at(time);
    const double h = time - c.time;
    return c.slope + h * (2.0 * c.bend + h * (3.0 * c.twist));
}

const Timing::Exponential& Timing::Exponentials::at(double time) const {
    return piece_at(pieces, time);
}

double Timing::Exponentials::distance(double time) const {
    const double laps = std::isfinite(lap_time) ? std::floor(time / lap_time) : 0.0;
    const double on_lap = laps == 0.0 ? time : time - laps * lap_time;
    const Exponential& e = at(on_lap);
    const double h = on_lap - e.time;
    return e.start + e.speed * h * expm1_over(e.growth * h) + laps * lap;
}

double Timing::Exponentials::speed(double time) const {
    const double laps = std::isfinite(lap_time) ? std::floor(time / lap_time) : 0.0;
    const double on_lap = laps == 0.0 ? time : time - laps * lap_time;
    const Exponential& e = at(on_lap);
    return e.speed * std::exp(e.growth * (on_lap - e.time));
}

Timing::Cubics Timing::checked(Cubics cubics, const char* message) {
    for (const Cubic& c : cubics.pieces) {
        // The last two as the derivative has them.
        const std::array numbers{c.value, c.slope, 2.0 * c.bend, 3.0 * c.twist};
        require(are_finite(numbers), message);
    }
    return cubics;
}

Timing::Timing(Profile profile) : profile_(std::move(profile)) {}

Timing Timing::eased(double duration, double length, double ease_in, double ease_out, AfterEase after) {
    require(std::isfinite(duration) && duration > 0.0, "duration: must be finite and greater than 0");
    require(std::isfinite(length) && std::isfinite(length / duration),
            "length: must be finite, and the speed it asks for");
    check_ease(ease_in, ease_out);
    return Timing(Eased{duration, length, ease_in, ease_out, after});
}

Timing Timing::constant(double speed) {
    require(std::isfinite(speed), "speed: must be finite");
    return Timing(Cubics{{Cubic{0.0, 0.0, speed, 0.0, 0.0}}});
}

Timing Timing::pins(std::span<const double> times, std::span<const double> distances) {
    check_profile(times, "times", distances, "distances");
    const std::size_t count = times.size();
    Cubics cubics;
    cubics.pieces.push_back({times[0], distances[0], 0.0, 0.0, 0.0});  // the rest before the first pin
    if (count > 1) {
        const std::vector<double> slopes = monotone_slopes(times, distances);
        for (std::size_t i = 0; i + 1 < count; ++i) {
            const double h = times[i + 1] - times[i];
            const double secant = (distances[i + 1] - distances[i]) / h;
            cubics.pieces.push_back({times[i], distances[i], slopes[i],
                                     (3.0 * secant - 2.0 * slopes[i] - slopes[i + 1]) / h,
                                     (slopes[i] + slopes[i + 1] - 2.0 * secant) / (h * h)});
        }
        cubics.pieces.push_back({times[count - 1], distances[count - 1], 0.0, 0.0, 0.0});
    }
    return Timing(checked(std::move(cubics), "times: must be so far apart that speeds are finite"));
}

Timing Timing::speeds(std::span<const double> times, std::span<const double> speeds) {
    check_profile(times, "times", speeds, "speeds");
    const std::size_t count = times.size();
    Cubics cubics;
    cubics.pieces.push_back({times[0], 0.0, speeds[0], 0.0, 0.0});  // the speed held before the first time
    double travelled = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double h = times[i + 1] - times[i];
        cubics.pieces.push_back({times[i], travelled, speeds[i], 0.5 * (speeds[i + 1] - speeds[i]) / h, 0.0});
        travelled += 0.5 * h * (speeds[i] + speeds[i + 1]);
    }
    cubics.pieces.push_back({times[count - 1], travelled, speeds[count - 1], 0.0, 0.0});
    const double at_zero = cubics.distance(0.0);
    for (Cubic& piece : cubics.pieces) piece.value -= at_zero;
    return Timing(checked(std::move(cubics), "times: must be so near together that distances are finite"));
}

Timing Timing::speeds_by_distance(std::span<const double> distances, std::span<const double> speeds) {
    check_profile(distances, "distances", speeds, "speeds");
    require(*std::min_element(speeds.begin(), speeds.end()) > 0.0, "speeds: must be greater than 0");
    const std::size_t count = distances.size();
    std::vector<Exponential> pieces;
    pieces.push_back({0.0, distances[0], speeds[0], 0.0});  // the speed held before the first distance
    double elapsed = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double width = distances[i + 1] - distances[i];
        const double growth = (speeds[i + 1] - speeds[i]) / width;
        pieces.push_back({elapsed, distances[i], speeds[i], growth});
        elapsed += time_across(width, speeds[i], speeds[i + 1]);
    }
    pieces.push_back({elapsed, distances[count - 1], speeds[count - 1], 0.0});

    // Where distance 0 lies: between the samples behind - 1 and behind, or outside them all.
    const auto behind = static_cast<std::size_t>(std::upper_bound(distances.begin(), distances.end(), 0.0) -
                                                 distances.begin());
    const Exponential& home = pieces[behind];
    const bool inside = behind > 0 && behind < count;
    const double speed_at_zero =
        inside ? std::lerp(home.speed, speeds[behind], -home.start / (distances[behind] - home.start))
               : home.speed;
    const double time_at_zero = home.time + time_across(-home.start, home.speed, speed_at_zero);
    for (Exponential& piece : pieces) piece.time -= time_at_zero;
    for (const Exponential& piece : pieces) {
        require(std::isfinite(piece.time) && std::isfinite(piece.growth), "speeds: must give finite times");
    }
    return Timing(Exponentials{std::move(pieces)});
}

Timing Timing::speeds_by_distance(std::span<const double> distances, std::span<const double> speeds,
                                  double lap) {
    check_profile(distances, "distances", speeds, "speeds");
    require(std::isfinite(lap) && lap > 0.0, "lap: must be finite and greater than 0");
    require(distances.back() - distances.front() <= lap * (1.0 + sum_rounding),
            "distances: must lie within one lap");
    // One lap from distance 0: the samples moved there by whole laps, and its two ends, which have one speed.
    std::vector<std::pair<double, double>> samples;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double laps = std::floor(distances[i] / lap);
        samples.emplace_back(std::clamp(distances[i] - laps * lap, 0.0, lap), speeds[i]);
    }
    std::ranges::stable_sort(samples, {}, &std::pair<double, double>::first);
    const auto [first, first_speed] = samples.front();
    const auto [last, last_speed] = samples.back();
    const double over_seam = first + (lap - last);
    const double at_seam =
        over_seam > 0.0 ? std::lerp(last_speed, first_speed, (lap - last) / over_seam) : first_speed;
    std::vector<double> places{0.0}, values{at_seam};
    for (const auto& [place, value] : samples) {
        if (place <= places.back() || place >= lap) continue;
        places.push_back(place);
        values.push_back(value);
    }
    places.push_back(lap);
    values.push_back(at_seam);
    const Timing once = speeds_by_distance(places, values);
    Exponentials laps = std::get<Exponentials>(once.profile_);
    laps.lap_time = laps.pieces.back().time;
    laps.lap = lap;
    require(laps.lap_time > 0.0, "speeds: must give finite times");
    return Timing(std::move(laps));
}

double Timing::distance(double time) const {
    return std::visit([time](const auto& profile) { return profile.distance(time); }, profile_);
}

double Timing::speed(double time) const {
    return std::visit([time](const auto& profile) { return profile.speed(time); }, profile_);
}

}  // namespace motus::path
