// Two bones: time and error of a solve, compared with the textbook's formula.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "motus/bones/chains/two_bone.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;

namespace {

constexpr std::size_t chain_count = 2000;

/// The plain way: law of cosines by acos, the plane by a cross product, the first bone turned by axis and
/// angle.
TwoBoneSolution solve_plainly(const TwoBone& chain) {
    const glm::dvec3 line = chain.target - chain.root;
    const double d =
        std::clamp(glm::length(line), std::abs(chain.length1 - chain.length2), chain.length1 + chain.length2);
    const double cosine =
        (chain.length1 * chain.length1 + d * d - chain.length2 * chain.length2) / (2.0 * chain.length1 * d);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    const glm::dvec3 along = glm::normalize(line);
    const glm::dvec3 normal = glm::normalize(glm::cross(along, chain.pole - chain.root));
    TwoBoneSolution at;
    at.normal = normal;
    at.elbow = chain.root + chain.length1 * (glm::angleAxis(chain.bend * angle, normal) * along);
    at.tip = chain.root + d * along;
    at.residual = glm::distance(at.tip, chain.target);
    at.reason = at.residual < 1e-9 ? Reason::reached : Reason::too_far;
    return at;
}

/// Random chains near the origin, their targets at shares of the way from folded to straight.
std::vector<TwoBone> random_chains(std::size_t count, double nearest, double farthest) {
    test::Random random(1);
    std::vector<TwoBone> chains(count);
    for (TwoBone& chain : chains) {
        chain.length1 = random.between(0.1, 2.0);
        chain.length2 = random.between(0.1, 2.0);
        const double folded = std::abs(chain.length1 - chain.length2);
        const double straight = chain.length1 + chain.length2;
        chain.root = random.direction();
        const double distance = folded + (straight - folded) * random.between(nearest, farthest);
        chain.target = chain.root + distance * random.direction();
        chain.pole = chain.root + random.at_distance(1.0, 5.0);
        chain.plane = random.direction();
        chain.bend = random.chance(0.5) ? 1 : -1;
    }
    return chains;
}

/// How far the end of two bones of the right lengths, laid along the solution, is from the target.
double misfit(const TwoBone& chain, const TwoBoneSolution& at) {
    const glm::dvec3 elbow = chain.root + chain.length1 * glm::normalize(at.elbow - chain.root);
    const glm::dvec3 tip = elbow + chain.length2 * glm::normalize(at.tip - at.elbow);
    return glm::distance(tip, chain.target) / (chain.length1 + chain.length2);
}

/// Largest of a quantity over the solutions.
template <class Quantity>
double largest(const std::vector<TwoBone>& chains, TwoBoneSolution (*solve)(const TwoBone&),
               Quantity&& quantity) {
    double result = 0.0;
    for (const TwoBone& chain : chains) result = std::max(result, quantity(chain, solve(chain)));
    return result;
}

double relative_residual(const TwoBone& chain, const TwoBoneSolution& at) {
    return at.residual / (chain.length1 + chain.length2);
}

template <class Work>
double nanoseconds_each(Work&& work) {
    return bench::nanoseconds(work, 101) / static_cast<double>(chain_count);
}

double one_by_one(const std::vector<TwoBone>& chains, std::vector<TwoBoneSolution>& out,
                  TwoBoneSolution (*solve)(const TwoBone&)) {
    return nanoseconds_each([&] {
        for (std::size_t i = 0; i < chains.size(); ++i) out[i] = solve(chains[i]);
        bench::keep(out);
    });
}

void compare(const bench::Table& table, const char* name, const std::vector<TwoBone>& chains) {
    std::vector<TwoBoneSolution> out(chains.size());
    const double batch = nanoseconds_each([&] {
        solve_two_bones(chains, out);
        bench::keep(out);
    });
    const double single = one_by_one(chains, out, &solve_two_bone);
    const double plain = one_by_one(chains, out, &solve_plainly);
    table.row(name, {batch, single, plain, plain / batch});
}

void compare_precision(const bench::Table& table, const char* name, double nearest, double farthest) {
    const std::vector<TwoBone> chains = random_chains(200000, nearest, farthest);
    table.row(name, {largest(chains, &solve_two_bone, relative_residual),
                     largest(chains, &solve_plainly, relative_residual),
                     largest(chains, &solve_two_bone, misfit), largest(chains, &solve_plainly, misfit)});
}

}  // namespace

int main() {
    std::printf(
        "Plain: acos, a cross product for the plane, a quaternion for the elbow; no soft reach, no "
        "stretch.\n");
    const bench::Table times(
        "A solve of " + std::to_string(chain_count) + " of two bones, one thread, best of 101",
        {{"all", "ns", 1}, {"one by one", "ns", 1}, {"plain", "ns", 1}, {"faster by", "x"}}, 34);
    compare(times, "within reach", random_chains(chain_count, 0.0, 1.0));
    compare(times, "out of reach", random_chains(chain_count, 1.01, 2.0));
    compare(times, "half of them within reach", random_chains(chain_count, 0.0, 2.0));
    std::vector<TwoBone> soft = random_chains(chain_count, 0.5, 1.5);
    for (TwoBone& chain : soft) {
        chain.softness = 0.2 * (chain.length1 + chain.length2);
        chain.stretch = 0.5;
    }
    compare(times, "soft, and half stretched", soft);
    std::vector<TwoBone> in_band = random_chains(chain_count, 0.0, 1.0);
    for (TwoBone& chain : in_band) chain.pole = chain.target + 0.05 * (chain.pole - chain.target);
    compare(times, "pole near the line, with a plane", in_band);

    std::printf(
        "\nOf 200000 random chains within reach, as fractions of the chain's length: the largest residual, "
        "and how far\nthe end of two bones of the right lengths, laid along the solution, is from the "
        "target.\n");
    const bench::Table errors("Exactness of two bones",
                              {{"residual", "", 1, true},
                               {"residual, plain", "", 1, true},
                               {"end is off", "", 1, true},
                               {"end is off, plain", "", 1, true}},
                              36);
    compare_precision(errors, "anywhere within reach", 0.0, 1.0);
    compare_precision(errors, "the last millionth before straight", 1.0 - 1e-6, 1.0);
    compare_precision(errors, "the first millionth after folded", 0.0, 1e-6);
    return 0;
}
