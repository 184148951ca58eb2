#include "motus/bones/layers/mask.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::bones::layers {

std::vector<int> parents_first(std::span<const int> parents) {
    const int count = static_cast<int>(parents.size());
    std::vector<int> order, above;
    std::vector<char> is_done(parents.size(), 0);
    order.reserve(parents.size());
    for (int bone = 0; bone < count; ++bone) {
        above.clear();
        for (int next = bone; next != -1 && is_done[static_cast<std::size_t>(next)] == 0;
             next = parents[static_cast<std::size_t>(next)]) {
            require(parents[static_cast<std::size_t>(next)] >= -1 &&
                        parents[static_cast<std::size_t>(next)] < count,
                    "parents: must be -1 or a bone");
            above.push_back(next);
            require(std::cmp_less_equal(above.size(), count), "parents: a bone is its own ancestor");
        }
        for (auto next = above.rbegin(); next != above.rend(); ++next) {
            is_done[static_cast<std::size_t>(*next)] = 1;
            order.push_back(*next);
        }
    }
    return order;
}

void feathered(std::span<const int> parents, std::span<const int> order, std::span<const double> chosen,
               int feather, std::span<double> mask) {
    const std::size_t count = parents.size();
    require(order.size() == count, "order: one entry for each bone is needed");
    require(chosen.size() == count, "chosen: one number for each bone is needed");
    require(mask.size() == count, "mask: one number for each bone is needed");
    require(feather >= 0, "feather: must be at least 0");
    require(std::ranges::all_of(chosen, [](double share) { return share >= 0.0 && share <= 1.0; }),
            "chosen: must be from 0 to 1");
    for (const int bone : order)
        require(bone >= 0 && std::cmp_less(bone, count), "order: a bone is not there");
    for (const int parent : parents)
        require(parent >= -1 && std::cmp_less(parent, count), "parents: must be -1 or a bone");
    // First how many bones lie up to the border; where there is none, more than count.
    const double inside = feather + 1.0;
    for (const int bone : order) {
        const auto at = static_cast<std::size_t>(bone);
        const int parent = parents[at];
        const double above = parent < 0 ? inside : mask[static_cast<std::size_t>(parent)];
        mask[at] = chosen[at] > 0.0 ? std::min(above + 1.0, inside) : 0.0;
    }
    for (std::size_t bone = 0; bone < mask.size(); ++bone) mask[bone] = chosen[bone] * (mask[bone] / inside);
}

}  // namespace motus::bones::layers
