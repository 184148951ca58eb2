// Time and error of a look-up by arc length, compared with two simpler methods.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "motus/curve/arc_length.hpp"
#include "motus/curve/nearest.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::curve;

namespace {

/// The usual table: t at 100 distances, looked up by bisection and interpolated linearly.
class LinearTable {
  public:
    explicit LinearTable(const Curve& curve, std::size_t entries = 100) {
        const double end = static_cast<double>(curve.segment_count());
        double length = 0.0;
        glm::dvec3 last = position(curve, 0.0);
        for (std::size_t i = 0; i < entries; ++i) {
            t_.push_back(end * static_cast<double>(i) / static_cast<double>(entries - 1));
            const glm::dvec3 next = position(curve, t_.back());
            length += glm::distance(last, next);
            s_.push_back(length);
            last = next;
        }
    }
    [[nodiscard]] double length() const { return s_.back(); }
    [[nodiscard]] double t_at_length(double s) const {
        const auto after = std::lower_bound(s_.begin() + 1, s_.end() - 1, s) - s_.begin();
        const std::size_t i = static_cast<std::size_t>(after);
        return t_[i - 1] + (t_[i] - t_[i - 1]) * (s - s_[i - 1]) / (s_[i] - s_[i - 1]);
    }

  private:
    std::vector<double> t_;
    std::vector<double> s_;
};

/// Without a table: bisection of t, each step a quadrature (5-point Gauss-Legendre, 16 panels a segment).
class Bisection {
  public:
    explicit Bisection(const Curve& curve) : curve_(curve) {}

    [[nodiscard]] double length_at(double t) const {
        constexpr double x[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                 0.9061798459386640};
        constexpr double w[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                 0.4786286704993665, 0.2369268850561891};
        double sum = 0.0;
        for (double start = 0.0; start < t; start += 1.0 / 16.0) {
            const double half = 0.5 * (std::min(t, start + 1.0 / 16.0) - start);
            for (int i = 0; i < 5; ++i)
                sum += half * w[i] * glm::length(derivative(curve_, start + half * (1.0 + x[i])));
        }
        return sum;
    }
    [[nodiscard]] double t_at_length(double s) const {
        double low = 0.0;
        double high = static_cast<double>(curve_.segment_count());
        for (int step = 0; step < 45; ++step) {
            const double middle = 0.5 * (low + high);
            (length_at(middle) < s ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

  private:
    const Curve& curve_;
};

[[nodiscard]] std::vector<double> random_distances(std::size_t count, double length) {
    test::Random random(1);
    std::vector<double> s(count);
    for (double& value : s) value = random.between(0.0, length);
    return s;
}

/// Time of one look-up of each of `s`.
template <class Table>
[[nodiscard]] double look_up_time(const Table& table, const std::vector<double>& s) {
    std::vector<double> t(s.size());
    const double all = bench::nanoseconds([&] {
        for (std::size_t i = 0; i < s.size(); ++i) t[i] = table.t_at_length(s[i]);
        bench::keep(t);
    });
    return all / static_cast<double>(s.size());
}

template <class Table>
[[nodiscard]] double error(const Table& table, const ArcLength& path, const std::vector<double>& s) {
    double worst = 0.0;
    for (const double distance : s)
        worst = std::max(worst, std::abs(path.length_at(table.t_at_length(distance)) - distance));
    return worst / path.length();
}

void run(const std::string& name, const Curve& curve) {
    const ArcLength path(curve);
    const LinearTable linear(curve);
    const Bisection bisection(curve);
    const std::vector<double> many = random_distances(100'000, std::min(path.length(), linear.length()));
    const std::vector<double> few = random_distances(20, path.length());

    const std::string of_curve = name + ", " + std::to_string(curve.segment_count()) +
                                 " segments of degree " + std::to_string(curve.degree()) +
                                 "; one thread, best of 7";
    const bench::Table table("t at a random distance: " + of_curve,
                             {{"each", "ns", 1}, {"of linear", "x"}, {"error / length", "", 1, true}});
    const auto print_row = [&](const char* what, double nanoseconds, double error, double linear_time) {
        table.row(what, {nanoseconds, nanoseconds / linear_time, error});
    };
    const double reference = look_up_time(linear, many);
    print_row("linear table of 100", reference, error(linear, path, many), reference);
    print_row("bisection and quadrature", look_up_time(bisection, few), error(bisection, path, few),
              reference);
    print_row("Motus", look_up_time(path, many), error(path, path, many), reference);

    const std::vector<double> million = random_distances(1'000'000, path.length());
    std::vector<glm::dvec3> positions(million.size());
    const double batch = bench::nanoseconds([&] {
        positions_at_length(path, million, Extend::clamp, positions);
        bench::keep(positions);
    });
    const double forward = bench::nanoseconds([&] { bench::keep(ArcLength(curve).length()); });
    const double both = bench::nanoseconds([&] { bench::keep(ArcLength(curve).interval_count()); });
    const double plain = bench::nanoseconds([&] { bench::keep(LinearTable(curve).length()); });
    const bench::Table other("Positions and tables: " + of_curve, {{"taken", "us", 1}});
    other.row("Motus, 1 M positions", {batch * 1e-3});
    other.row("linear table, building", {plain * 1e-3});
    other.row("Motus, building for the length", {forward * 1e-3});
    other.row("Motus, building for t at s too", {both * 1e-3});
}

[[nodiscard]] Curve random_spline(std::size_t count) {
    test::Random random(2);
    std::vector<glm::dvec3> points(count);
    for (glm::dvec3& p : points) p = random.in_cube();
    std::vector<glm::dvec3> left(count);
    std::vector<glm::dvec3> right(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 arm = (points[(i + 1) % count] - points[(i + count - 1) % count]) / 6.0;
        left[i] = points[i] - arm;
        right[i] = points[i] + arm;
    }
    return Curve::spline(points, left, right, true);
}

}  // namespace

int main() {
    using Points = std::vector<glm::dvec3>;
    run("S curve", Curve::bezier(Points{{0, 0, 0}, {3, 0, 0}, {1, 4, 0}, {4, 4, 0}}));
    run("cusp", Curve::bezier(Points{{0, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 0, 0}}));
    run("cyclic spline", random_spline(20));

    // A quarter of a circle: all of it is as far away, to 1e-9.
    const Curve arc = Curve::bezier(Points{{1, 0, 0},
                                           {1.00000000625, 0.196349533525, 0},
                                           {0.95593920208, 0.392699157297, 0},
                                           {0.86781806787, 0.577513221277, 0},
                                           {0.73925876301, 0.73925876301, 0},
                                           {0.577513221277, 0.86781806787, 0},
                                           {0.392699157297, 0.95593920208, 0},
                                           {0.196349533525, 1.00000000625, 0},
                                           {0, 1, 0}});
    const double taken =
        bench::nanoseconds([&] { bench::keep(nearest(arc, glm::dvec3(0.0)).distance); }) * 1e-3;
    bench::Table("Nearest point", {{"taken", "us", 1}}).row("of an arc, from its centre", {taken});
}
