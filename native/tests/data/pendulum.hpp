// Motions known to more digits than doubles have.
// Double pendulum: both masses 1 kg, both rods 1 m, g = 9.81 m/s^2, both angles 2 pi / 3 at rest;
// extrapolation (Gragg, Bulirsch, Stoer) in 50-digit arithmetic, right to 1e-36 up to 10 s. Errors grow about
// as exp(1.6 t). Single pendulum: periods for the largest angle, rod 1 m, g = 9.81 m/s^2.
#pragma once
#include <array>

namespace motus::reference {

struct DoublePendulumAt {
    double time;       ///< s
    double tolerance;  ///< what doubles can hold of it, rad and rad/s
    double theta1, theta2, omega1, omega2;
};

struct PendulumPeriod {
    double degrees;
    double seconds;
};

// clang-format off
inline constexpr std::array double_pendulum_states{
    DoublePendulumAt{1.0, 1e-10,
        -0.293623564119050531090324638411762182,
        -0.937493947612377177325890237268085012,
        -5.13602610757032003174392182988506078,
        -2.42817410088619442895704154664014385},
    DoublePendulumAt{3.0, 1e-9,
        1.58948110351146708491493562402291058,
        1.111489708521800577045958211083289,
        4.01713399256674145833628610722032646,
        0.657194130170318319637507083329166208},
    DoublePendulumAt{5.0, 1e-8,
        -2.07694074300381328164066231060148169,
        -1.59711636659436409027369090947050264,
        -1.96173531298801372957990542466258945,
        -0.544804079160430621844451929383241329},
    DoublePendulumAt{10.0, 1e-6,
        3.11622893816190179175242233703288187,
        13.2389456985126579106689923565839476,
        -0.0865534461365004273004021640888229209,
        -2.41986328531829810451142083015345708},
};

inline constexpr std::array pendulum_periods{
    PendulumPeriod{1.0, 2.0061048740557132728},
    PendulumPeriod{10.0, 2.0098926272986006829},
    PendulumPeriod{30.0, 2.0409898895191304105},
    PendulumPeriod{60.0, 2.1528746668805157034},
    PendulumPeriod{90.0, 2.3678419475762374493},
    PendulumPeriod{120.0, 2.754089828887825677},
    PendulumPeriod{150.0, 3.5350981863815234739},
    PendulumPeriod{170.0, 4.893524274105486164},
    PendulumPeriod{179.0, 7.825796837537682703},
};
// clang-format on

}  // namespace motus::reference
