// A double pendulum at any time, without playing from the start: double_pendulum FILE.csv
// Each line of the file is a frame: its time, both bobs in the plane of the swing, and the energy, which does
// not drift.
#include <cmath>
#include <fstream>
#include <motus/dynamics/double_pendulum.hpp>
#include <vector>

using namespace motus;

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    const dynamics::DoublePendulum pendulum{.mass1 = 2.0, .mass2 = 1.0, .length1 = 1.0, .length2 = 0.7};
    const dynamics::DoublePendulumState start{.theta1 = 2.0, .theta2 = 2.5};

    // The times may come in any order; each state depends on its own time alone.
    std::vector<double> times;
    const int frames_a_second = 24, seconds = 60;
    for (int frame = 0; frame <= seconds * frames_a_second; ++frame) {
        times.push_back(static_cast<double>(frame) / frames_a_second);
    }
    std::vector<dynamics::DoublePendulumState> states(times.size());
    dynamics::double_pendulum(pendulum, start, times, states);

    std::ofstream file(argv[1]);
    file << "time,x1,z1,x2,z2,energy\n";
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        const dynamics::DoublePendulumState& state = states[frame];
        const double x1 = pendulum.length1 * std::sin(state.theta1),
                     z1 = -pendulum.length1 * std::cos(state.theta1);
        const double x2 = x1 + pendulum.length2 * std::sin(state.theta2);
        const double z2 = z1 - pendulum.length2 * std::cos(state.theta2);
        file << times[frame] << ',' << x1 << ',' << z1 << ',' << x2 << ',' << z2 << ','
             << dynamics::energy(pendulum, state) << '\n';
    }
    return file.flush() ? 0 : 1;
}
