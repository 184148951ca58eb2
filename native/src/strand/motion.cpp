#include "motus/strand/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "checks.hpp"
#include "motus/core/numeric.hpp"
#include "stepper.hpp"

namespace motus::strand {
namespace {

/// The times between two resets, in steps of equal length.
struct Section {
    std::size_t first = 0, last = 0;  ///< samples
    double begin = 0.0;
    double duration = 0.0;  ///< of a step, s
    std::size_t steps = 0;
    std::size_t knots = 0;  ///< index of the state at `begin` among those kept

    [[nodiscard]] double time(std::size_t step) const { return begin + static_cast<double>(step) * duration; }
};

/// How many of its states are kept.
[[nodiscard]] std::size_t knots_of(const Section& section) {
    return section.steps / Motion::knot + 1;
}

[[nodiscard]] std::vector<Section> sections_of(const Inputs& inputs, const Solving& solving) {
    std::vector<Section> sections;
    std::size_t first = 0, knots = 0;
    const auto add = [&](std::size_t last, double end) {
        Section section{.first = first, .last = last, .begin = inputs.times[first], .knots = knots};
        const double seconds = end - section.begin;
        require(!solving.is_loop || seconds * solving.rate >= 1.0,
                "times: must span a step of the rate at least, in a loop");
        // A whole number of steps in a cycle; elsewhere steps are equally long whatever the end is, so that
        // it makes no difference.
        const double steps =
            solving.is_loop ? std::round(seconds * solving.rate) : std::ceil(seconds * solving.rate);
        require(steps < Motion::most_work, "times: must be a shorter time, or the rate lower");
        section.steps = static_cast<std::size_t>(steps);
        section.duration = solving.is_loop ? seconds / steps : 1.0 / solving.rate;
        sections.push_back(section);
        knots += knots_of(section);
        first = last + 1;
    };
    for (const std::size_t reset : inputs.resets) add(reset - 1, inputs.times[reset]);
    add(inputs.times.size() - 1, inputs.times.back());
    return sections;
}

}  // namespace

struct Motion::Solver {
    Solver(std::span<const Link> links, const Inputs& inputs, const Solving& how);

    [[nodiscard]] std::size_t size() const { return stepper.size(); }
    [[nodiscard]] const Section& now() const { return sections[section]; }

    void begin_section();
    void settle();
    void begin_steps();
    void advance();
    void keep(std::size_t index);
    void restore(std::size_t index, State& out) const;
    void end_cycle();
    void places(double time, std::span<glm::dvec3> out) const;

    Solving solving;
    Stepper stepper;
    std::vector<Section> sections;
    std::vector<glm::dvec3> kept;  ///< places, then velocities, of each state that is kept

    // How far it is solved.
    std::size_t ready = 0;  ///< sections whose first state is known
    std::size_t section = 0, step = 0, settled = 0, cycle = 0;
    bool is_begun = false, is_settled = false, is_done = false;
    std::vector<double> energies;  ///< of motion, by roots, while strands come to rest
    double gap = 0.0;
    State state;
    Driven driven, next;
    Stepper::Work work;
};

Motion::Solver::Solver(std::span<const Link> links, const Inputs& inputs, const Solving& how)
    : solving(how), stepper(links, inputs, how), sections(sections_of(inputs, how)), work(stepper) {
    double steps = 0.0;
    const double settling = std::ceil(how.settle * how.rate);
    for (const Section& one : sections)
        steps += static_cast<double>(one.steps) * (how.is_loop ? how.cycles : 1) + settling;
    const std::size_t knots = sections.back().knots + knots_of(sections.back());
    const auto count = static_cast<double>(links.size());
    // A surface is asked twice for each end and each middle of a link, before lengths are held and after.
    // Links that touch are compared with all whose boxes overlap along an axis, which takes little of a step.
    constexpr double compared = 1.0 / 16.0;
    const double asked = static_cast<double>(inputs.obstacles.size()) +
                         4.0 * static_cast<double>(inputs.surfaces.size()) +
                         (inputs.are_touching ? compared * count : 0.0);
    require(steps * count * (1.0 + asked) <= most_work &&
                static_cast<double>(knots) * count * 6.0 <= most_numbers,
            "times: must be a shorter time, or links and obstacles fewer, or the rate lower");
    kept.resize(knots * 2 * links.size());
    is_done = links.empty();
}

void Motion::Solver::begin_section() {
    stepper.read(now().begin, now().first, now().last, driven);
    stepper.start(driven, state);
    step = settled = 0;
    energies.assign(size(), 0.0);
    is_begun = true;
    is_settled = !(solving.settle > 0.0);
    if (is_settled) begin_steps();
}

/// One step of coming to rest: whenever the energy of motion has been largest, all stands still for a moment
/// (dynamic relaxation with kinetic damping: Barnes, "Form Finding and Analysis of Tension Structures by
/// Dynamic Relaxation", 1999).
void Motion::Solver::settle() {
    constexpr double still = 1e-7;  // m/s^2, of all forces that are left
    const double duration = 1.0 / solving.rate;
    stepper.step(state, driven, driven, duration, work);
    ++settled;
    // By roots, so that each strand comes to rest as it would alone.
    std::vector<double> moving(size(), 0.0), fastest(size(), 0.0);
    for (std::size_t i = 0; i < size(); ++i) {
        const double square = glm::dot(state.velocities[i], state.velocities[i]);
        moving[stepper.root(i)] += square;
        fastest[stepper.root(i)] = std::max(fastest[stepper.root(i)], square);
    }
    is_settled = true;
    for (std::size_t i = 0; i < size(); ++i) {
        const std::size_t root = stepper.root(i);
        if (!(energies[root] == 0.0 && std::sqrt(fastest[root]) < still * duration)) is_settled = false;
        if (moving[root] < energies[root]) state.velocities[i] = glm::dvec3(0.0);
    }
    for (std::size_t root = 0; root < size(); ++root)
        energies[root] = moving[root] < energies[root] ? 0.0 : moving[root];
    is_settled = is_settled || static_cast<double>(settled) >= solving.settle * solving.rate;
    if (!is_settled) return;
    std::fill(state.velocities.begin(), state.velocities.end(), glm::dvec3(0.0));
    begin_steps();
}

void Motion::Solver::begin_steps() {
    keep(0);
    ready = section + 1;
}

void Motion::Solver::keep(std::size_t index) {
    const auto to = kept.begin() + static_cast<std::ptrdiff_t>((now().knots + index) * 2 * size());
    std::copy(state.velocities.begin(), state.velocities.end(),
              std::copy(state.places.begin(), state.places.end(), to));
}

void Motion::Solver::restore(std::size_t index, State& out) const {
    const auto from = kept.begin() + static_cast<std::ptrdiff_t>(index * 2 * size());
    const auto middle = from + static_cast<std::ptrdiff_t>(size());
    out.places.assign(from, middle);
    out.velocities.assign(middle, middle + static_cast<std::ptrdiff_t>(size()));
}

void Motion::Solver::advance() {
    if (!is_begun) return begin_section();
    if (!is_settled) return settle();
    if (step < now().steps) {
        stepper.read(now().time(step + 1), now().first, now().last, next);
        stepper.step(state, driven, next, now().duration, work);
        std::swap(driven, next);
        ++step;
        if (step % knot == 0) keep(step / knot);
        if (step < now().steps) return;
    }
    if (solving.is_loop) return end_cycle();
    ++section;
    is_begun = false;
    is_done = section == sections.size();
}

/// Goes on with the next cycle from where this one ends, until it ends where it has begun.
void Motion::Solver::end_cycle() {
    constexpr double closed = 1e-9;  // m
    State began;
    restore(0, began);
    gap = 0.0;
    for (std::size_t i = 0; i < size(); ++i)
        gap = std::max({gap, glm::length(state.places[i] - began.places[i]),
                        now().duration * glm::length(state.velocities[i] - began.velocities[i])});
    ++cycle;
    is_done = gap <= closed || static_cast<double>(cycle) >= solving.cycles;
    if (is_done) return;
    step = 0;
    stepper.read(now().begin, now().first, now().last, driven);
    keep(0);
}

void Motion::Solver::places(double time, std::span<glm::dvec3> out) const {
    if (solving.is_loop) {
        const double begin = stepper.times().front(), seconds = stepper.times().back() - begin;
        const double cycles = std::floor((time - begin) / seconds);
        time = std::clamp(time - cycles * seconds, begin, begin + seconds);
    }
    if (ready == 0) {
        Driven first;
        stepper.read(now().begin, now().first, now().last, first);
        std::copy(first.pose.begin(), first.pose.end(), out.begin());
        return;
    }
    const auto after =
        std::upper_bound(sections.begin() + 1, sections.begin() + static_cast<std::ptrdiff_t>(ready), time,
                         [](double at, const Section& one) { return at < one.begin; });
    const Section& in = *(after - 1);
    const double local = std::max((time - in.begin) / in.duration, 0.0);
    const auto step_before =
        static_cast<std::size_t>(std::min(std::floor(local), static_cast<double>(in.steps)));
    const double share = step_before == in.steps ? 0.0 : local - static_cast<double>(step_before);
    const std::size_t first = step_before > 0 && share > 0.0 ? step_before - 1 : step_before;
    const std::size_t last = share > 0.0 ? step_before + 1 : step_before;
    State at;
    restore(in.knots + first / knot, at);
    Stepper::Work own(stepper);
    Driven start, end;
    std::size_t k = first / knot * knot;
    stepper.read(in.time(k), in.first, in.last, start);
    std::array<std::vector<glm::dvec3>, 3> near;  // at `first` to `last`, of which there are two or three
    for (;; ++k) {
        if (k >= first) near[k - first] = at.places;
        if (k == last) break;
        stepper.read(in.time(k + 1), in.first, in.last, end);
        stepper.step(at, start, end, in.duration, own);
        std::swap(start, end);
    }
    if (!(share > 0.0)) {
        std::copy(at.places.begin(), at.places.end(), out.begin());
        return;
    }
    stepper.read(time, in.first, in.last, start);
    const auto& before = near[step_before - first];
    const bool has_earlier = first < step_before;
    stepper.between({has_earlier ? std::span<const glm::dvec3>(near[0]) : std::span<const glm::dvec3>(),
                     before, at.places},
                    share, start, out);
}

Motion::Motion(std::span<const Link> links, const Inputs& inputs, const Solving& solving) {
    require_sound(links, inputs, solving);
    solver_ = std::make_unique<Solver>(links, inputs, solving);
}

Motion::~Motion() = default;
Motion::Motion(Motion&& other) noexcept = default;
Motion& Motion::operator=(Motion&& other) noexcept = default;

std::size_t Motion::size() const noexcept {
    return solver_ ? solver_->size() : 0;
}

bool Motion::solve(std::size_t steps) {
    while (!is_solved() && steps-- > 0) solver_->advance();
    return is_solved();
}

bool Motion::is_solved() const noexcept {
    return !solver_ || solver_->is_done;
}

double Motion::solved_until() const noexcept {
    if (!solver_) return 0.0;
    const Solver& solver = *solver_;
    if (solver.is_done) return solver.stepper.times().back();
    const Section& now = solver.now();
    return solver.solving.is_loop || !solver.is_begun || !solver.is_settled ? now.begin
                                                                            : now.time(solver.step);
}

double Motion::gap() const noexcept {
    return solver_ ? solver_->gap : 0.0;
}

void Motion::places(double time, std::span<glm::dvec3> out) const {
    require(std::isfinite(time), "time: must be finite");
    require(out.size() == size(), "out: must have a row for each link");
    if (out.empty()) return;
    const Solver& solver = *solver_;
    // What is not solved yet of a loop comes before its first time, too.
    const double known = solver.solving.is_loop ? solved_until() : std::min(time, solved_until());
    solver.places(solver.is_done ? time : known, out);
}

std::size_t Motion::near_pairs() const {
    return solver_ ? solver_->stepper.near_pairs() : 0;
}

std::size_t Motion::bytes() const noexcept {
    return solver_ ? sizeof(Solver) + solver_->stepper.bytes() + solver_->kept.size() * sizeof(glm::dvec3)
                   : 0;
}

}  // namespace motus::strand
