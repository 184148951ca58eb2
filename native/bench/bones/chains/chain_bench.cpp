// Chains of many bones: time of a solve, compared with textbook FABRIK and CCD.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "motus/bones/chains/chain.hpp"
#include "motus/bones/chains/limited.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;

namespace {

using Joints = std::vector<glm::dvec3>;

constexpr double tolerance = 1e-6;  // of the length
constexpr int most_rounds = 10000;

using test::Random;

struct Task {
    Joints joints;
    glm::dvec3 target{0.0};
};

/// Chains of length 1 that bend by 2 rad, crooked by some tenths of it; targets at `reach` of their length,
/// anywhere within where it is 0.
std::vector<Task> make_tasks(std::size_t bones, double reach, std::size_t count) {
    Random random(7);
    std::vector<Task> tasks(count);
    const double length = 1.0 / static_cast<double>(bones);
    for (Task& task : tasks) {
        glm::dvec3 direction = random.direction();
        const glm::dquat turn = glm::angleAxis(2.0 * length, random.direction());
        task.joints = {glm::dvec3(0.0)};
        for (std::size_t i = 0; i < bones; ++i) {
            direction = turn * direction;
            task.joints.push_back(task.joints.back() +
                                  length * glm::normalize(direction + 0.2 * random.direction()));
        }
        const double distance = reach > 0.0 ? reach : random.between(0.02, 0.95);
        task.target = distance * random.direction();
    }
    return tasks;
}

/// Aristidou and Lasenby's, as published: out of reach straight, else sweeps to and fro.
int fabrik(Joints& joints, const glm::dvec3& target) {
    const std::size_t last = joints.size() - 1;
    const glm::dvec3 root = joints[0];
    std::vector<double> lengths(last);
    double total = 0.0;
    for (std::size_t i = 0; i < last; ++i) total += lengths[i] = glm::distance(joints[i], joints[i + 1]);
    if (glm::distance(root, target) > total) {
        for (std::size_t i = 0; i < last; ++i)
            joints[i + 1] = joints[i] + lengths[i] * glm::normalize(target - joints[i]);
        return 0;
    }
    int rounds = 0;
    while (glm::distance(joints[last], target) > tolerance && rounds < most_rounds) {
        joints[last] = target;
        for (std::size_t i = last; i-- > 0;)
            joints[i] = joints[i + 1] + lengths[i] * glm::normalize(joints[i] - joints[i + 1]);
        joints[0] = root;
        for (std::size_t i = 0; i < last; ++i)
            joints[i + 1] = joints[i] + lengths[i] * glm::normalize(joints[i + 1] - joints[i]);
        ++rounds;
    }
    return rounds;
}

/// Cyclic coordinate descent: from the tip to the root each joint turns the tip towards the target.
int ccd(Joints& joints, const glm::dvec3& target) {
    const std::size_t last = joints.size() - 1;
    double total = 0.0;
    for (std::size_t i = 0; i < last; ++i) total += glm::distance(joints[i], joints[i + 1]);
    int rounds = 0;
    while (glm::distance(joints[last], target) >
               std::max(glm::distance(joints[0], target) - total, 0.0) + tolerance &&
           rounds < most_rounds / 10) {
        for (std::size_t i = last; i-- > 0;) {
            const glm::dvec3 from = joints[last] - joints[i];
            const glm::dvec3 to = target - joints[i];
            const glm::dvec3 axis = glm::cross(from, to);
            const double sine = glm::length(axis);
            if (sine < 1e-14) continue;
            const glm::dquat turn = glm::angleAxis(std::atan2(sine, glm::dot(from, to)), axis / sine);
            for (std::size_t k = i + 1; k <= last; ++k)
                joints[k] = joints[i] + turn * (joints[k] - joints[i]);
        }
        ++rounds;
    }
    return rounds;
}

struct Result {
    double microseconds = 0.0;  // a chain
    double rounds = 0.0;        // the same
    double missed = 0.0;        // share of chains that do not come as near as can be
};

using Solver = std::function<int(Joints&, const glm::dvec3&)>;

Result measure(const std::vector<Task>& tasks, const Solver& solver) {
    Result result;
    std::vector<Joints> joints(tasks.size());
    int rounds = 0;
    const double count = static_cast<double>(tasks.size());
    const auto fill = [&] {
        for (std::size_t i = 0; i < tasks.size(); ++i) joints[i] = tasks[i].joints;
    };
    const double filling = bench::nanoseconds(fill, 3);
    const double all = bench::nanoseconds(
        [&] {
            fill();
            rounds = 0;
            for (std::size_t i = 0; i < tasks.size(); ++i) rounds += solver(joints[i], tasks[i].target);
        },
        3);
    result.microseconds = (all - filling) / count / 1e3;
    result.rounds = rounds / count;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const double least = std::max(glm::length(tasks[i].target) - 1.0, 0.0);
        if (!(glm::distance(joints[i].back(), tasks[i].target) <= least + 1.001 * tolerance))
            result.missed += 1.0 / count;
    }
    return result;
}

void free_chains() {
    std::printf("Chains come to %.0e of their length, where that can be.\n", tolerance);
    std::printf("FABRIK and CCD: as published, until they are there or %d and %d rounds have passed.\n",
                most_rounds, most_rounds / 10);
    const bench::Table table("A chain without limits, target at a share of its length; one thread, best of 3",
                             {{"taken", "us"}, {"of Motus", "x", 1}, {"rounds", "", 1}, {"missed", "%"}}, 36);
    const Solver motus = [](Joints& joints, const glm::dvec3& target) {
        return chains::solve(joints, target, {}).iterations;
    };
    for (const std::size_t bones : {5, 20, 100, 255}) {
        for (const double reach : {0.0, 0.999, 1.0, 1.2}) {
            // Few, if the others take long.
            const std::vector<Task> tasks = make_tasks(bones, reach, bones >= 100 ? 4 : 40);
            const Result own = measure(make_tasks(bones, reach, 400), motus);
            const Result by_fabrik = measure(tasks, fabrik);
            const Result by_ccd = measure(tasks, ccd);
            char name[40];
            std::snprintf(name, sizeof name, reach > 0.0 ? "%zu bones, %.3f" : "%zu bones, within", bones,
                          reach);
            const auto row = [&](const char* solver, const Result& found) {
                table.row(name + std::string(": ") + solver,
                          {found.microseconds, found.microseconds / own.microseconds, found.rounds,
                           100.0 * found.missed});
            };
            row("Motus", own);
            row("FABRIK", by_fabrik);
            row("CCD", by_ccd);
        }
    }
}

/// The greatest change of an angle between neighbouring bones, in degrees.
double sharpest(const Joints& before, const Joints& after) {
    const auto angle = [](const Joints& joints, std::size_t i) {
        const glm::dvec3 above = glm::normalize(joints[i] - joints[i - 1]);
        const glm::dvec3 below = glm::normalize(joints[i + 1] - joints[i]);
        return std::atan2(glm::length(glm::cross(above, below)), glm::dot(above, below));
    };
    double most = 0.0;
    for (std::size_t i = 1; i + 1 < before.size(); ++i)
        most = std::max(most, std::abs(angle(after, i) - angle(before, i)));
    return glm::degrees(most);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How well each solver keeps the given pose, and how far a chain would jump if one solver handed over to the
/// other.
void kept_shapes() {
    std::printf(
        "\nTargets within reach: by how much the joint that changes most does, and how far apart the\n");
    std::printf("joint is that stands farthest from where FABRIK has it; medians.\n");
    const bench::Table table("Kept shapes",
                             {{"Motus", "deg", 0}, {"FABRIK", "deg", 0}, {"apart, of the length", "", 2}});
    for (const std::size_t bones : {3, 5, 8, 20}) {
        std::vector<double> own, by_fabrik, apart;
        for (const Task& task : make_tasks(bones, 0.0, 1000)) {
            Joints ours = task.joints;
            Joints theirs = task.joints;
            chains::solve(ours, task.target, {});
            fabrik(theirs, task.target);
            own.push_back(sharpest(task.joints, ours));
            by_fabrik.push_back(sharpest(task.joints, theirs));
            double farthest = 0.0;
            for (std::size_t i = 0; i < ours.size(); ++i)
                farthest = std::max(farthest, glm::distance(ours[i], theirs[i]));
            apart.push_back(farthest);
        }
        table.row(std::to_string(bones) + " bones", {median(own), median(by_fabrik), median(apart)});
    }
}

/// Time of one chain: in the middle, of nine in ten, of all.
void print_times(const bench::Table& table, const char* name, std::size_t bones, std::vector<double>& times) {
    if (times.empty()) return;
    std::sort(times.begin(), times.end());
    const auto at = [&](double share) {
        return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))] / 1e3;
    };
    table.row(std::to_string(bones) + " bones, " + name,
              {static_cast<double>(times.size()), at(0.5), at(0.9), at(1.0)});
}

void limited_chains() {
    const bench::Table table(
        "A chain with limits (hinges, ball joints), targets within 1.1 of its length",
        {{"chains", "", 0}, {"median", "us", 1}, {"90 %", "us", 1}, {"longest", "us", 1}});
    for (const std::size_t bones : {2, 3, 5, 10, 40}) {
        Random random(11);
        std::vector<double> reached, kept_away;
        for (int round = 0; round < 400; ++round) {
            std::vector<glm::dquat> rest, rotations(bones, {1.0, 0.0, 0.0, 0.0});
            std::vector<JointLimits> limits;
            for (std::size_t i = 0; i < bones; ++i) {
                rest.push_back(random.rotation(0.5));
                const double wide = random.between(0.3, 2.0);
                const double narrow = i % 2 == 0 ? random.between(0.1, 0.8) : 0.0;
                limits.push_back({{-0.1, -narrow, -narrow}, {wide, narrow, narrow}});
            }
            const std::vector<glm::dvec3> offsets(bones, {0.0, 1.0 / static_cast<double>(bones), 0.0});
            const Limited chain{.rest = rest, .offsets = offsets, .limits = limits};
            const glm::dvec3 target = random.at_distance(0.1, 1.1);
            Convergence report;
            const double time = bench::nanoseconds(
                [&] {
                    std::fill(rotations.begin(), rotations.end(), glm::dquat(1.0, 0.0, 0.0, 0.0));
                    report = solve_limited(chain, target, {}, rotations);
                },
                3);
            (report.reason == Reason::reached ? reached : kept_away).push_back(time);
        }
        print_times(table, "reached", bones, reached);
        print_times(table, "out of reach", bones, kept_away);
    }
}

}  // namespace

int main() {
    free_chains();
    kept_shapes();
    limited_chains();
    return 0;
}
