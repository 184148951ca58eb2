// F-curves: what a value costs.
#include <cstdio>
#include <utility>
#include <vector>

#include "motus/fcurve/fcurve.hpp"
#include "random.hpp"
#include "stopwatch.hpp"

using namespace motus;
using namespace motus::fcurve;

namespace {

constexpr int key_count = 12;

FCurve make(Interpolation interpolation, const std::optional<Cycles>& cycles = std::nullopt) {
    test::Random random(1);
    std::vector<Key> keys;
    for (int i = 0; i < key_count; ++i) {
        const glm::vec2 place(8.0 * i, random.between(-1.0, 1.0)), handle(2.6f, 0.0f);
        keys.push_back({place, place - handle, place + handle, interpolation});
    }
    return {std::move(keys), false, cycles};
}

void row(const char* name, const FCurve& curve, double first) {
    std::vector<double> frames(10000), values(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = first + static_cast<double>(i) / 120.0;
    const double taken = bench::nanoseconds(
        [&] {
            curve.values(frames, values);
            bench::keep(values);
        },
        20);
    std::printf("  %-38s %10.1f\n", name, taken / static_cast<double>(frames.size()));
}

}  // namespace

int main() {
    std::printf("F-curves: ns a value of 10,000 at once; one thread, best of 20.\n\n");
    row("linear", make(Interpolation::linear), 0.0);
    row("Bezier", make(Interpolation::bezier), 0.0);
    row("elastic", make(Interpolation::elastic), 0.0);
    row("Bezier, Cycles, at frame 1,000,000", make(Interpolation::bezier, Cycles{}), 1e6);
    return 0;
}
