#include "state.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace motus::strand {

std::vector<std::size_t> interleaved(std::span<const Link> links) {
    constexpr std::size_t together = 8;  // strands
    std::vector<std::size_t> blocks(links.size()), depths(links.size(), 0), order(links.size());
    std::size_t strands = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (links[i].parent < 0) {
            blocks[i] = strands++ / together;
            continue;
        }
        const auto parent = static_cast<std::size_t>(links[i].parent);
        blocks[i] = blocks[parent];
        depths[i] = depths[parent] + 1;
    }
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::tuple(blocks[i], depths[i]); });
    return order;
}

}  // namespace motus::strand
