// Responses of  y + k1 y' + k2 y'' = x + k3 x'  to a unit step at time 0, known to 20 digits by the closed
// form, which an independent integration confirms to 1e-13.
#pragma once
#include <array>

namespace motus::reference {

struct StepValue {
    double time;  ///< s
    double value;
    double derivative;  ///< 1/s, to 1e-12
};

struct StepResponse {
    double frequency;  ///< Hz
    double damping;
    double response;
    std::array<StepValue, 6> values;
};

// clang-format off
inline constexpr std::array step_responses{
    StepResponse{2.0, 0.5, 0.0, {{
        {0.0, 0.0, 0.0},
        {0.1, 0.47961214688455489697, 6.857318508606917},
        {0.2, 1.0269719504333410966, 3.394973621593363},
        {0.5, 0.98982212901473562285, -0.46767649031226277},
        {1.0, 1.0012814797523529274, -0.026925189957158178},
        {2.0, 1.0000029487095474824, 1.131722188001318e-05},
    }}},
    StepResponse{1.0, 1.0, 0.0, {{
        {0.0, 0.0, 0.0},
        {0.1, 0.13131145535900626953, 2.1061265647046055},
        {0.2, 0.35773955646956452754, 2.2471868812010456},
        {0.5, 0.82102555358593105747, 0.8530085557688848},
        {1.0, 0.98639906853442506539, 0.07372368401459001},
        {2.0, 0.9999526894211365162, 0.0002753495157355651},
    }}},
    StepResponse{3.0, 2.0, 1.0, {{
        {0.0, 0.0, 37.69911184307752},
        {0.1, 0.69782866773646876845, 1.5549384702898277},
        {0.2, 0.81791646393924281655, 0.9196788810888832},
        {0.5, 0.95998531727077901568, 0.2021030898768723},
        {1.0, 0.99679765033215961017, 0.01617418204003496},
        {2.0, 0.99997948991320976509, 0.0001035907729669919},
    }}},
};
// clang-format on

}  // namespace motus::reference
