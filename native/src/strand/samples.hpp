// Inputs over time: a row of vectors or numbers at each sample, linear between. Private to the library.
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace motus::strand {

/// Where a time lies: between a sample and the one after it, or at it, if it is the last one.
struct Between {
    std::size_t sample = 0;
    std::size_t after = 0;
    double share = 0.0;
};

class Times {
  public:
    explicit Times(std::span<const double> times) : times_(times.begin(), times.end()) {}

    [[nodiscard]] std::size_t size() const noexcept { return times_.size(); }
    [[nodiscard]] double operator[](std::size_t sample) const { return times_[sample]; }
    [[nodiscard]] double front() const { return times_.front(); }
    [[nodiscard]] double back() const { return times_.back(); }

    /// Among the samples from `first` to `last`: earlier and later times have the values of these.
    [[nodiscard]] Between at(double time, std::size_t first, std::size_t last) const {
        const auto begin = times_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = times_.begin() + static_cast<std::ptrdiff_t>(last) + 1;
        const auto after = std::upper_bound(begin, end, time);
        if (after == begin) return {first, first, 0.0};
        if (after == end) return {last, last, 0.0};
        const auto sample = static_cast<std::size_t>(after - times_.begin()) - 1;
        return {sample, sample + 1, (time - times_[sample]) / (times_[sample + 1] - times_[sample])};
    }

  private:
    std::vector<double> times_;
};

/// Rows of `width` values, one for each time, or a single one for all times, or none, which is zero.
template <class Value>
class Rows {
  public:
    Rows(std::span<const Value> values, std::size_t width)
        : values_(values.begin(), values.end()), width_(width) {}

    [[nodiscard]] std::size_t width() const noexcept { return width_; }
    [[nodiscard]] bool is_still() const noexcept { return values_.size() <= width_; }

    [[nodiscard]] std::span<const Value> row(std::size_t sample) const {
        return std::span(values_).subspan(sample * width_, width_);
    }
    void at(const Between& place, std::span<Value> out) const {
        if (values_.empty()) {
            std::fill(out.begin(), out.end(), Value(0.0));
            return;
        }
        const Value* first = values_.data() + (is_still() ? 0 : place.sample * width_);
        const Value* second = values_.data() + (is_still() ? 0 : place.after * width_);
        if (place.share == 0.0) {
            std::copy_n(first, width_, out.begin());
            return;
        }
        for (std::size_t i = 0; i < width_; ++i) out[i] = first[i] + (second[i] - first[i]) * place.share;
    }
    [[nodiscard]] std::size_t bytes() const noexcept { return values_.size() * sizeof(Value); }

  private:
    std::vector<Value> values_;
    std::size_t width_;
};

}  // namespace motus::strand
