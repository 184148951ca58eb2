// A rig of four bones, one after the other, and the arrays that Blender would have of it.
#pragma once
#include <vector>

namespace motus::contracts {

[[nodiscard]] inline std::vector<int> sample_parents() {
    return {-1, 0, 1, 2};
}
/// Along Y, each a unit behind the one before.
[[nodiscard]] inline std::vector<float> sample_matrices() {
    std::vector<float> all;
    for (int bone = 0; bone < 4; ++bone)
        for (int i = 0; i < 16; ++i)
            all.push_back(i % 5 == 0 ? 1.0F : i == 13 ? static_cast<float>(bone) : 0.0F);
    return all;
}
[[nodiscard]] inline std::vector<float> sample_basis() {
    std::vector<float> all;
    for (int bone = 0; bone < 4; ++bone)
        for (int i = 0; i < 16; ++i) all.push_back(i % 5 == 0 ? 1.0F : 0.0F);
    return all;
}

}  // namespace motus::contracts
