#include "picker_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <mutex>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "motus/core/parallel.hpp"

namespace motus::mesh {
namespace {

// Two levels of the curve at once: 64 subcells in each of the 24 positions of the curve in a cube.
struct Step {
    std::uint8_t place;  ///< along the curve, of 64
    std::uint8_t state;  ///< of the curve within the subcell
};
constexpr std::size_t cells = 64;
using Steps = std::array<Step, 24 * cells>;

constexpr unsigned turned(unsigned bits, unsigned by) {
    return (bits << by | bits >> (3 - by)) & 7u;
}

/// The step of one level: the state is 3 * entry corner + direction, the cell has one bit an axis.
constexpr Step half_step(unsigned state, unsigned cell) {
    const unsigned entry = state / 3, direction = state % 3;
    const unsigned gray = turned(cell ^ entry, (2 - direction) % 3);
    const unsigned place = gray ^ gray >> 1 ^ gray >> 2;
    const auto trailing_ones = [](unsigned i) { return static_cast<unsigned>(std::countr_one(i)); };
    const auto gray_code = [](unsigned i) { return i ^ i >> 1; };
    const unsigned corner = place == 0 ? 0 : gray_code(2 * ((place - 1) / 2));
    const unsigned along =
        place == 0 ? 0 : (place % 2 == 0 ? trailing_ones(place - 1) : trailing_ones(place)) % 3;
    const unsigned next_entry = entry ^ turned(corner, (direction + 1) % 3);
    const unsigned next = 3 * next_entry + (direction + along + 1) % 3;
    return {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(next)};
}

constexpr Steps make_steps() {
    Steps steps{};
    for (unsigned state = 0; state < 24; ++state) {
        for (unsigned cell = 0; cell < cells; ++cell) {
            const Step coarse = half_step(state, cell >> 3);
            const Step fine = half_step(coarse.state, cell & 7u);
            steps[state * cells + cell] = {static_cast<std::uint8_t>(coarse.place << 3 | fine.place),
                                           fine.state};
        }
    }
    return steps;
}

constexpr Steps steps = make_steps();

/// The bits of `value`, hilbert_bits of them, with two zeros between each and the next.
std::uint64_t spread(std::uint64_t value) noexcept {
    value = (value | value << 32) & 0x001f00000000ffffULL;
    value = (value | value << 16) & 0x001f0000ff0000ffULL;
    value = (value | value << 8) & 0x100f00f00f00f00fULL;
    value = (value | value << 4) & 0x10c30c30c30c30c3ULL;
    return (value | value << 2) & 0x1249249249249249ULL;
}

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
};

/// Bounds of the finite points.
Bounds bounds_of(std::span<const glm::vec3> points, const Executor& executor) {
    Bounds all;
    std::mutex merging;
    in_parts(
        points.size(), 16384,
        [&](std::size_t first, std::size_t last) {
            Bounds part;
            for (const glm::vec3& p : points.subspan(first, last - first)) {
                // Infinity and NaN times 0 are NaN, the only value that differs from itself.
                const float sum = 0.0f * p.x + 0.0f * p.y + 0.0f * p.z;
                if (std::isnan(sum)) continue;
                part.low = glm::min(part.low, p);
                part.high = glm::max(part.high, p);
            }
            const std::lock_guard lock(merging);
            all.low = glm::min(all.low, part.low);
            all.high = glm::max(all.high, part.high);
        },
        executor);
    return all;
}

// Below some pages it is not worth the memory that remains of the last one.
constexpr std::size_t large_page = std::size_t{1} << 21, few_pages = 2 * large_page;
constexpr std::align_val_t small_alignment{64}, large_alignment{large_page};

}  // namespace

void* allocate_pages(std::size_t bytes) {
    if (bytes < few_pages) return ::operator new(bytes, small_alignment);
    void* memory = ::operator new(bytes, large_alignment);
#ifdef __linux__
    // A wish: if the system does not grant it, the memory is as good.
    static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
#endif
    return memory;
}

void free_pages(void* memory, std::size_t bytes) noexcept {
    ::operator delete(memory, bytes < few_pages ? small_alignment : large_alignment);
}

std::uint64_t hilbert_place(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
    const std::uint64_t morton = spread(x) | spread(y) << 1 | spread(z) << 2;
    std::uint64_t place = 0;
    std::size_t state = 0;
    for (int shift = 3 * hilbert_bits - 6; shift >= 0; shift -= 6) {
        const Step step = steps[state * cells + (morton >> shift & (cells - 1))];
        place = place << 6 | step.place;
        state = step.state;
    }
    return place;
}

void sort_by_key(Array<Keyed>& items, int bits, const Executor& executor) {
    // Counted and dealt out in blocks of fixed number, which several threads may share.
    constexpr int digit_bits = 10;
    constexpr std::size_t digits = std::size_t{1} << digit_bits, blocks = 16;
    const std::size_t length = (items.size() + blocks - 1) / blocks;
    Array<Keyed> sorted(items.size());
    std::vector<std::array<std::uint32_t, digits>> counts(blocks);
    const auto each_block = [&](auto&& work) {
        const auto work_on = [&](std::size_t first_block, std::size_t last_block) {
            for (std::size_t block = first_block; block < last_block; ++block) {
                const std::size_t first = std::min(items.size(), block * length);
                const std::size_t last = std::min(items.size(), first + length);
                work(std::span(items).subspan(first, last - first), counts[block]);
            }
        };
        in_parts(blocks, 1, work_on, items.size() < 16384 ? Executor{1} : executor);
    };
    for (int shift = 0; shift < bits; shift += digit_bits) {
        const auto digit = [shift](const Keyed& item) { return item >> (32 + shift) & (digits - 1); };
        each_block([&](std::span<const Keyed> block, auto& count) {
            count.fill(0);
            for (const Keyed& item : block) ++count[digit(item)];
        });
        std::uint32_t before = 0;
        for (std::size_t i = 0; i < digits; ++i)
            for (auto& count : counts) before += std::exchange(count[i], before);
        each_block([&](std::span<const Keyed> block, auto& place) {
            for (const Keyed& item : block) sorted[place[digit(item)]++] = item;
        });
        items.swap(sorted);
    }
}

Array<std::uint32_t> hilbert_order(std::span<const glm::vec3> points, const Executor& executor) {
    const Bounds bounds = bounds_of(points, executor);
    const glm::dvec3 low(bounds.low), size = glm::dvec3(bounds.high) - low;
    const double longest = std::max({size.x, size.y, size.z});
    constexpr double last_cell = (1u << hilbert_bits) - 1;
    const double cells_a_unit = longest > 0.0 ? last_cell / longest : 0.0;
    // NaN and infinity also get a cell.
    const auto cell = [&](float coordinate, double from) {
        const double at = (static_cast<double>(coordinate) - from) * cells_a_unit;
        return at > 0.0 ? static_cast<std::uint32_t>(std::min(at, last_cell)) : 0u;
    };
    constexpr std::size_t grain = 4096;
    // Sorted by the leading bits, which tell nearly all keys apart, and the few equal ones by the rest.
    constexpr int coarse_bits = 30;
    Array<std::uint64_t> keys(points.size());
    Array<Keyed> keyed(points.size());
    const auto find_keys = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const glm::vec3& p = points[i];
            keys[i] = hilbert_place(cell(p.x, low.x), cell(p.y, low.y), cell(p.z, low.z));
            keyed[i] = keys[i] >> (3 * hilbert_bits - coarse_bits) << 32 | i;
        }
    };
    in_parts(points.size(), grain, find_keys, executor);
    sort_by_key(keyed, coarse_bits, executor);

    Array<std::uint32_t> order(points.size());
    const auto index_of = [](Keyed item) { return static_cast<std::uint32_t>(item); };
    const auto refine = [&](std::size_t first, std::size_t last) {
        const auto alike = [&](std::size_t i) { return keyed[i] >> 32 == keyed[i - 1] >> 32; };
        // A part has the runs that begin in it.
        while (first > 0 && first < last && alike(first)) ++first;
        while (first < last) {
            std::size_t end = first + 1;
            while (end < keyed.size() && alike(end)) ++end;
            const auto run = order.begin() + static_cast<std::ptrdiff_t>(first);
            const auto run_end = std::transform(&keyed[first], &keyed[first] + (end - first), run, index_of);
            std::sort(run, run_end, [&](std::uint32_t a, std::uint32_t b) {
                return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
            });
            first = end;
        }
    };
    in_parts(points.size(), grain, refine, executor);
    return order;
}

}  // namespace motus::mesh
