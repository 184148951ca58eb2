// A signal and three ways of following it by second-order dynamics: follow_through FILE.csv
// Each line of the file is a time, the signal, and three outputs: one that overshoots, one that arrives late
// without overshooting, one that draws back before it goes.
#include <array>
#include <fstream>
#include <motus/dynamics/second_order.hpp>
#include <motus/dynamics/track.hpp>
#include <span>
#include <vector>

using namespace motus;

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    // A hand that reaches for a cup, waits and comes back: linear between these times, which need not be
    // equally far apart.
    const std::array<double, 6> times{0.0, 0.5, 0.8, 2.0, 2.4, 4.0};
    const std::array<double, 6> signal{0.0, 0.0, 1.0, 1.0, 0.0, 0.0};
    const std::array<dynamics::SecondOrder, 3> filters{
        dynamics::SecondOrder(2.5, 0.3, 0.0),  // Hz, damping ratio, initial response
        dynamics::SecondOrder(1.5, 1.0, 0.0),
        dynamics::SecondOrder(2.0, 0.6, -1.5),
    };
    std::vector<dynamics::Track> tracks;
    for (const dynamics::SecondOrder& filter : filters) tracks.emplace_back(filter, times, signal, 1);
    // A filter this stiff follows the signal itself.
    const dynamics::Track input(dynamics::SecondOrder(1e4, 1.0, 1.0), times, signal, 1);

    std::ofstream file(argv[1]);
    file << "time,signal,overshooting,smooth,anticipating\n";
    for (int sample = 0; sample <= 400; ++sample) {
        const double time = 0.01 * sample;
        double value = 0.0;
        input.evaluate(time, std::span(&value, 1));
        file << time << ',' << value;
        for (const dynamics::Track& track : tracks) {
            track.evaluate(time, std::span(&value, 1));
            file << ',' << value;
        }
        file << '\n';
    }
    return file.flush() ? 0 : 1;
}
