#include "motus/snow/snow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "flight_model.hpp"
#include "kernel.hpp"
#include "landings.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/core/unfilled.hpp"

namespace motus::snow {

struct Snow::Parts {
    explicit Parts(const SnowSettings& settings) : model(settings), landings(model, settings) {}

    FlightModel model;
    Landings landings;
};

namespace {

constexpr std::size_t landing_grain = 2;  // blocks whose landings are looked for: some 2 ms each

/// The living flakes of a block, and what the runs in it need.
class Block {
  public:
    Block(const FlightModel& model, const Landings& landings)
        : births_(model.births),
          lifetime_(model.lifetime),
          random_lifetime_(model.random_lifetime),
          kind_(model.kind),
          kernel_(*model.kernel),
          landings_(landings) {}

    /// Those of numbers from first to last, all in one block of block_size, as they land by its page.
    void take(double time, std::uint64_t first, std::uint64_t last, std::shared_ptr<const LandingPage> page) {
        count_ = 0;
        page_ = std::move(page);
        if (!page_ && landings_.are_any()) return;
        auto piece = std::ranges::upper_bound(births_.pieces(), first, {}, &Births::Piece::first);
        for (--piece; first < last; ++piece) {
            const std::uint64_t until = std::min(last, piece->last);
            const auto length = static_cast<std::size_t>(until - first);
            double* to = ages_.data() + count_;
            const std::uint64_t streamed = piece->streamed + (first - piece->first);
            if (piece->is_burst) {
                std::fill_n(to, length, time - piece->burst);
            } else if (births_.has_keys()) {
                births_.streamed(streamed, {to, length});
                for (std::size_t i = 0; i < length; ++i) to[i] = time - to[i];
            } else {
                kernel_.ages(time, births_.delay(), births_.rate(), streamed, length, to);
            }
            for (std::size_t i = 0; i < length; ++i)
                lows_[count_ + i] = static_cast<std::uint32_t>(first + i);
            high_ = static_cast<std::uint32_t>(first >> 32U);
            count_ += length;
            first = until;
        }
        pad();
        const std::size_t all = count_;
        if (random_lifetime_ && ages_[0] >= lifetime_ - lifetime_range) keep_living();
        if (page_ && landings_.rest_time() < std::numeric_limits<double>::infinity()) keep_resting(time);
        if (count_ > 0 && count_ < all) pad();
    }

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Falling.
    [[nodiscard]] const double* ages() const noexcept { return ages_.data(); }
    [[nodiscard]] const std::uint32_t* lows() const noexcept { return lows_.data(); }
    [[nodiscard]] std::uint32_t high() const noexcept { return high_; }
    /// Where its flakes land; nullptr where nothing is to land on.
    [[nodiscard]] const LandingPage* page() const noexcept { return page_.get(); }

  private:
    void pad() {
        std::fill_n(ages_.data() + count_, padding, ages_[count_ - 1]);
        std::fill_n(lows_.data() + count_, padding, lows_[count_ - 1]);
    }

    void keep_living() {
        Unfilled<float, block_size> draws;
        kernel_.lives(kind_.key, high_, lows_.data(), count_, draws.data());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            ages_[kept] = ages_[i];
            lows_[kept] = lows_[i];
            const double life = lifetime_ + lifetime_range * static_cast<double>(draws[i]);
            kept += ages_[i] < life ? 1 : 0;
        }
        count_ = kept;
    }

    /// Those that are in the air, or have not been on the ground for long.
    void keep_resting(double time) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            ages_[kept] = ages_[i];
            lows_[kept] = lows_[i];
            kept += time - page_->times[lows_[i] % block_size] < landings_.rest_time() ? 1 : 0;
        }
        count_ = kept;
    }

    const Births& births_;
    double lifetime_;
    bool random_lifetime_;
    const Kind& kind_;
    const Kernel& kernel_;
    const Landings& landings_;
    std::shared_ptr<const LandingPage> page_;
    Unfilled<double, block_size + padding> ages_;
    Unfilled<std::uint32_t, block_size + padding> lows_;
    std::uint32_t high_ = 0;
    std::size_t count_ = 0;
};

}  // namespace

/// What living flakes are, block by block.
class Snow::Rows {
  public:
    Rows(const Parts& snow, const Living::Parts& living) : snow_(snow), living_(living) {}

    /// Those that may live at a time.
    [[nodiscard]] static Living::Parts candidates(const std::shared_ptr<const Parts>& snow, double time) {
        require(std::isfinite(time), "time: must be finite");
        const FlightModel& model = snow->model;
        Living::Parts living{time, model.births.count_older(time, model.longest()), model.births.count(time)};
        living.count = static_cast<std::size_t>(living.last - living.first);
        living.snow = snow;
        return living;
    }

    static void count_living(const Parts& snow, Living::Parts& living, const Executor& executor) {
        const Rows rows(snow, living);
        std::vector<std::size_t> counts(rows.block_count() + 1);
        in_parts(
            counts.size() - 1, snow.landings.are_any() ? landing_grain : std::size_t{256},
            [&](std::size_t from, std::size_t to) {
                Block block(snow.model, snow.landings);
                for (std::size_t i = from; i < to; ++i) {
                    rows.take(i, block);
                    counts[i + 1] = block.count();
                }
            },
            executor);
        for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
        living.count = counts.back();
        living.before = std::move(counts);
    }

    /// Blocks with flakes that may be living.
    [[nodiscard]] std::size_t block_count() const {
        if (living_.first == living_.last) return 0;
        return static_cast<std::size_t>((living_.last - 1) / block_size - living_.first / block_size + 1);
    }
    /// Number of a block among all flakes that are ever born.
    [[nodiscard]] std::uint64_t number_of(std::size_t block) const {
        return living_.first / block_size + block;
    }
    /// That live before a block.
    [[nodiscard]] std::size_t before(std::size_t block) const {
        return living_.before.empty() ? static_cast<std::size_t>(numbers_of(block).first - living_.first)
                                      : living_.before[block];
    }

    void take(std::size_t index, Block& block) const {
        const auto [first, last] = numbers_of(index);
        block.take(living_.time, first, last, page_of(index));
    }

  private:
    [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> numbers_of(std::size_t block) const {
        const std::uint64_t start = number_of(block) * block_size;
        return {std::max(living_.first, start), std::min(living_.last, start + block_size)};
    }
    /// Where the flakes of a block land: as it was known, or as it is found now.
    [[nodiscard]] std::shared_ptr<const LandingPage> page_of(std::size_t block) const {
        if (!living_.pages.empty()) return living_.pages[block];
        return snow_.landings.are_any() ? snow_.landings.page(number_of(block)) : nullptr;
    }

    const Parts& snow_;
    const Living::Parts& living_;
};

Snow::Snow(const SnowSettings& settings)
    : parts_(in_ieee_floats([&] { return std::make_shared<const Parts>(settings); })) {}

Living Snow::living(double time, const Executor& executor) const {
    const Landings& landings = parts_->landings;
    return in_ieee_floats([&] {
        Living::Parts living = Rows::candidates(parts_, time);
        const bool may_rest =
            landings.are_any() && landings.rest_time() < std::numeric_limits<double>::infinity();
        if (parts_->model.random_lifetime || may_rest) Rows::count_living(*parts_, living, executor);
        return Living(std::move(living));
    });
}

Living Snow::known(double time, const Executor& executor) const {
    const Landings& landings = parts_->landings;
    if (!landings.are_any()) return living(time, executor);
    return in_ieee_floats([&] {
        Living::Parts living = Rows::candidates(parts_, time);
        const Rows rows(*parts_, living);
        for (std::size_t block = 0; block < rows.block_count(); ++block)
            living.pages.push_back(landings.kept(rows.number_of(block)));
        Rows::count_living(*parts_, living, executor);
        return Living(std::move(living));
    });
}

std::size_t Snow::find_landings(double time, std::size_t most, const Executor& executor) const {
    const Landings& landings = parts_->landings;
    return in_ieee_floats([&] {
        const Living::Parts living = Rows::candidates(parts_, time);
        const Rows rows(*parts_, living);
        std::vector<std::uint64_t> missing;
        for (std::size_t i = 0; landings.are_any() && i < rows.block_count(); ++i)
            if (!landings.kept(rows.number_of(i))) missing.push_back(rows.number_of(i));
        const std::size_t found = std::min(most, missing.size());
        in_parts(
            found, landing_grain,
            [&](std::size_t from, std::size_t to) {
                for (std::size_t i = from; i < to; ++i) static_cast<void>(landings.page(missing[i]));
            },
            executor);
        return missing.size() - found;
    });
}

void Snow::evaluate(const Living& living, const Fields& out, const Executor& executor) const {
    require(living.parts_ != nullptr && living.parts_->snow == parts_, "living: must be of this snow");
    const auto fits = [&](const auto& field) { return field.empty() || field.size() == living.count(); };
    require(fits(out.position) && fits(out.velocity) && fits(out.size) && fits(out.color) && fits(out.age) &&
                fits(out.rotation) && fits(out.id),
            "out: must have a row for each living flake");
    const FlightModel& model = parts_->model;
    const Landings& landings = parts_->landings;
    const Rows rows(*parts_, *living.parts_);
    const auto fill = [&](std::size_t from, std::size_t to) {
        Block block(model, landings);
        Flight flight(model);
        for (std::size_t i = from; i < to; ++i) {
            rows.take(i, block);
            const std::size_t before = rows.before(i);
            flight.fill(living.time(), block.ages(), block.lows(), block.high(), block.count(), out, before);
            if (block.page() != nullptr)
                landings.land(*block.page(), living.time(), block.lows(), block.count(), out, before);
        }
    };
    constexpr std::size_t grain = 32;  // of blocks: some 50 us
    in_ieee_floats(
        [&] { in_parts(rows.block_count(), landings.are_any() ? landing_grain : grain, fill, executor); });
}

std::vector<Touchdown> Snow::touchdowns(double end, const Executor& executor) const {
    require(std::isfinite(end), "end: must be finite");
    const Landings& landings = parts_->landings;
    return in_ieee_floats([&] {
        std::vector<Touchdown> all;
        if (!landings.are_any()) return all;
        const std::uint64_t count = parts_->model.births.count(end);
        require(static_cast<double>(count) <= most_touchdowns,
                "end: must be earlier: more than 1e7 flakes are born until then");
        std::vector<std::vector<Touchdown>> of_blocks((count + block_size - 1) / block_size);
        in_parts(
            of_blocks.size(), landing_grain,
            [&](std::size_t from, std::size_t to) {
                for (std::size_t block = from; block < to; ++block) {
                    const auto page = landings.page(block);
                    for (std::size_t slot = 0; slot < block_size; ++slot) {
                        const Landing& landing = page->landings.at(slot);
                        if (page->times.at(slot) <= end && landing.triangle != Landing::carried)
                            of_blocks[block].push_back({page->times.at(slot), block * block_size + slot,
                                                        landing.point, landing.triangle, landing.is_behind});
                    }
                }
            },
            executor);
        for (const std::vector<Touchdown>& some : of_blocks) all.insert(all.end(), some.begin(), some.end());
        std::ranges::sort(all, {}, [](const Touchdown& one) { return std::tuple(one.time, one.id); });
        return all;
    });
}

const std::shared_ptr<const Collider>& Snow::collider() const noexcept {
    return parts_->landings.collider();
}
const glm::dvec3& Snow::acceleration() const noexcept {
    return parts_->landings.pull();
}

}  // namespace motus::snow
