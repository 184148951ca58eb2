// A cover as bytes, and back. Bytes are somebody else's: each number that a loop or an index relies on is
// checked.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "motus/core/numeric.hpp"
#include "motus/snow/cover.hpp"

namespace motus::snow {
namespace {

/// Of the layout below; as a number of 64 bits it differs where the order of bytes does.
constexpr std::uint64_t layout = 0x4d6f'7475'7343'0001;

/// What the bytes begin with.
struct Head {
    std::uint64_t layout = 0;
    double flake_volume = 0.0;
    std::uint64_t rounds = 0;
    std::uint64_t flakes = 0, vertices = 0, events = 0, links = 0;
};

class Writer {
  public:
    template <class T>
    void add(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto bytes = std::as_bytes(values);
        out_.insert(out_.end(), bytes.begin(), bytes.end());
    }
    [[nodiscard]] std::vector<std::byte> taken() && { return std::move(out_); }

  private:
    std::vector<std::byte> out_;
};

class Reader {
  public:
    explicit Reader(std::span<const std::byte> data) : data_(data) {}

    template <class T>
    [[nodiscard]] std::vector<T> next(std::uint64_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        require(count <= data_.size() / sizeof(T), "data: must have as many bytes as it says");
        std::vector<T> values(static_cast<std::size_t>(count));
        if (count > 0) std::memcpy(values.data(), data_.data(), values.size() * sizeof(T));
        data_ = data_.subspan(values.size() * sizeof(T));
        return values;
    }
    [[nodiscard]] bool is_at_end() const noexcept { return data_.empty(); }

  private:
    std::span<const std::byte> data_;
};

/// Whether the numbers are where the parts of a list of `size` begin, and where the last one ends.
[[nodiscard]] bool are_starts(std::span<const std::size_t> starts, std::size_t size) {
    return starts.front() == 0 && starts.back() == size && std::ranges::is_sorted(starts);
}

[[nodiscard]] std::vector<std::size_t> indices(std::span<const std::uint64_t> given) {
    std::vector<std::size_t> found(given.size());
    std::ranges::transform(given, found.begin(),
                           [](std::uint64_t one) { return static_cast<std::size_t>(one); });
    return found;
}

[[nodiscard]] std::vector<std::uint64_t> wide(std::span<const std::size_t> given) {
    return {given.begin(), given.end()};
}

}  // namespace

std::vector<std::byte> Cover::bytes() const {
    const Head head{layout,        flake_volume_, static_cast<std::uint64_t>(rounds_),
                    times_.size(), areas_.size(), events_.size(),
                    links_.size()};
    Writer out;
    out.add(std::span(&head, 1));
    out.add(std::span(times_));
    out.add(std::span(areas_));
    out.add(std::span(events_));
    out.add(std::span(links_));
    out.add(std::span(shares_));
    if (head.vertices == 0) return std::move(out).taken();
    out.add(std::span<const std::uint64_t>(wide(starts_)));
    if (head.rounds > 0) out.add(std::span<const std::uint64_t>(wide(link_starts_)));
    return std::move(out).taken();
}

Cover Cover::restored(std::span<const std::byte> data) {
    Reader in(data);
    const Head head = in.next<Head>(1).front();
    require(head.layout == layout, "data: must be what bytes() gives");
    require(head.flake_volume > 0.0 && head.flake_volume <= 1e30 && head.rounds <= CoverSettings::most_rounds,
            "data: must have the settings of a cover");
    Cover made;
    made.flake_volume_ = head.flake_volume;
    made.rounds_ = static_cast<int>(head.rounds);
    made.times_ = in.next<double>(head.flakes);
    made.areas_ = in.next<double>(head.vertices);
    made.events_ = in.next<Event>(head.events);
    made.links_ = in.next<std::uint32_t>(head.links);
    made.shares_ = in.next<float>(head.links);
    const bool has_vertices = head.vertices > 0, has_links = has_vertices && head.rounds > 0;
    if (has_vertices) made.starts_ = indices(in.next<std::uint64_t>(head.vertices + 1));
    if (has_links) made.link_starts_ = indices(in.next<std::uint64_t>(head.vertices + 1));
    require(in.is_at_end(), "data: must have as many bytes as it says");

    require(are_finite(made.times_) && std::ranges::is_sorted(made.times_), "data: times must rise");
    require(are_finite(made.areas_) && are_finite(made.shares_), "data: areas and shares must be finite");
    require(has_vertices ? are_starts(made.starts_, made.events_.size()) : made.events_.empty(),
            "data: each vertex must have its events");
    require(has_links ? are_starts(made.link_starts_, made.links_.size()) : made.links_.empty(),
            "data: each vertex must have its links");
    require(std::ranges::all_of(made.events_, [](const Event& one) { return std::isfinite(one.height); }),
            "data: heights must be finite");
    require(std::ranges::all_of(made.links_, [&](std::uint32_t one) { return one < head.vertices; }),
            "data: links must lead to vertices");
    return made;
}

}  // namespace motus::snow
