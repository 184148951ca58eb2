// What an argument may be: which numbers a function refuses, and what comes of those that it takes.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace motus::contracts {

/// What a function does with a number.
enum class Verdict {
    refused,    ///< it throws std::invalid_argument, whose message begins with the argument's name
    taken,      ///< it returns, and all of its results are finite
    open,       ///< either: what else it depends on decides
    unbounded,  ///< it returns; results may be infinite
    nan_out,    ///< it returns, and a result is NaN
    at_rest,    ///< it returns, and all of its results are finite though the number is not
    untested,   ///< a call would take too long, or too much memory
};

/// The numbers that an argument may have.
struct Domain {
    /// Of all numbers of an argument, of which the one at `changed` is an extreme; the `width` numbers around
    /// it are one vector, quaternion, matrix or struct.
    struct Seen {
        std::span<const double> all;
        std::size_t changed = 0;
        std::size_t width = 1;

        [[nodiscard]] double number() const { return all[changed]; }
        [[nodiscard]] std::span<const double> element() const {
            return all.subspan(changed / width * width, width);
        }
    };
    std::string says;  ///< for readers
    std::function<Verdict(const Seen&)> judge;

    /// The same, but whether a number is taken depends on other arguments too.
    [[nodiscard]] Domain open() const {
        return {says, [inner = judge](const Seen& seen) {
                    const Verdict verdict = inner(seen);
                    return verdict == Verdict::taken ? Verdict::open : verdict;
                }};
    }
    /// The same, but results may be infinite.
    [[nodiscard]] Domain unbounded() const {
        return {says, [inner = judge](const Seen& seen) {
                    const Verdict verdict = inner(seen);
                    return verdict == Verdict::taken ? Verdict::unbounded : verdict;
                }};
    }
    /// The same, infinities apart, which are taken, too.
    [[nodiscard]] Domain or_infinite() const {
        return {says + ", or infinite", [inner = judge](const Seen& seen) {
                    return std::isinf(seen.number()) ? Verdict::unbounded : inner(seen);
                }};
    }
    /// The same, infinity apart, which is taken, too.
    [[nodiscard]] Domain or_infinity() const {
        return {says + ", or infinity", [inner = judge](const Seen& seen) {
                    return seen.number() > std::numeric_limits<double>::max() ? Verdict::unbounded
                                                                              : inner(seen);
                }};
    }
    /// The same, tested up to a size: beyond it calls would take too long.
    [[nodiscard]] Domain tested_to(double most) const {
        return {says, [inner = judge, most](const Seen& seen) {
                    return std::abs(seen.number()) > most && std::isfinite(seen.number()) ? Verdict::untested
                                                                                          : inner(seen);
                }};
    }
    /// The same, in different words.
    [[nodiscard]] Domain in_words(std::string words) const { return {std::move(words), judge}; }
};

/// Numbers for which `holds` is true.
template <class Holds>
[[nodiscard]] Domain numbers(std::string says, Holds holds) {
    return {std::move(says), [holds](const Domain::Seen& seen) {
                return holds(seen.number()) ? Verdict::taken : Verdict::refused;
            }};
}
/// A number as text, shortest first.
[[nodiscard]] inline std::string text_of(double number) {
    char text[32];
    for (int digits = 1; digits < 18; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, number);
        if (std::strtod(text, nullptr) == number) break;
    }
    return text;
}
[[nodiscard]] inline Domain finite() {
    return numbers("finite", [](double x) { return std::isfinite(x); });
}
[[nodiscard]] inline Domain no_nan() {
    return {"not NaN", [](const Domain::Seen& seen) {
                if (std::isnan(seen.number())) return Verdict::refused;
                return std::isinf(seen.number()) ? Verdict::unbounded : Verdict::taken;
            }};
}
[[nodiscard]] inline Domain above(double low) {
    return numbers("> " + text_of(low) + ", finite", [low](double x) { return x > low && std::isfinite(x); });
}
[[nodiscard]] inline Domain at_least(double low) {
    return numbers("≥ " + text_of(low) + ", finite",
                   [low](double x) { return x >= low && std::isfinite(x); });
}
/// Both ends included.
[[nodiscard]] inline Domain from(double low, double high) {
    return numbers(text_of(low) + " to " + text_of(high), [=](double x) { return x >= low && x <= high; });
}
/// Both ends left out.
[[nodiscard]] inline Domain within(double low, double high) {
    return numbers("> " + text_of(low) + ", < " + text_of(high),
                   [=](double x) { return x > low && x < high; });
}
[[nodiscard]] inline Domain up_to(double size) {
    return numbers("at most " + text_of(size) + " in size", [=](double x) { return std::abs(x) <= size; });
}
/// A function of this number: NaN gives NaN.
[[nodiscard]] inline Domain any() {
    return {"any; NaN gives NaN", [](const Domain::Seen& seen) {
                if (std::isnan(seen.number())) return Verdict::nan_out;
                return std::isinf(seen.number()) ? Verdict::unbounded : Verdict::taken;
            }};
}
/// Whatever the number is: results are finite.
[[nodiscard]] inline Domain any_at_rest(std::string says) {
    return {std::move(says), [](const Domain::Seen&) { return Verdict::at_rest; }};
}
/// Whatever the number is: what it is a part of may be infinite or NaN.
[[nodiscard]] inline Domain any_passed_on() {
    return {"any; NaN gives NaN", [](const Domain::Seen& seen) {
                return std::isnan(seen.number()) ? Verdict::nan_out : Verdict::unbounded;
            }};
}
/// Vectors that have a direction.
[[nodiscard]] inline Domain direction() {
    return {"finite, not 0", [](const Domain::Seen& seen) {
                const auto element = seen.element();
                if (!std::ranges::all_of(element, [](double x) { return std::isfinite(x); }))
                    return Verdict::refused;
                return std::ranges::any_of(element, [](double x) { return x != 0.0; }) ? Verdict::taken
                                                                                       : Verdict::refused;
            }};
}
/// Unit vectors and quaternions, to a tolerance.
[[nodiscard]] inline Domain unit(double tolerance) {
    return {"of length 1 to " + text_of(tolerance), [=](const Domain::Seen& seen) {
                double square = 0.0;
                for (const double x : seen.element()) square += x * x;
                const double off = std::abs(std::sqrt(square) - 1.0);
                if (off < 0.5 * tolerance) return Verdict::taken;
                return off < 2.0 * tolerance ? Verdict::open : Verdict::refused;
            }};
}
/// Each greater than the one before.
[[nodiscard]] inline Domain rising() {
    return {"finite, strictly rising", [](const Domain::Seen& seen) {
                const bool rises =
                    std::ranges::adjacent_find(seen.all, std::ranges::greater_equal{}) == seen.all.end();
                return rises && std::isfinite(seen.number()) ? Verdict::taken : Verdict::refused;
            }};
}
/// Whole numbers from 0 to count - 1.
[[nodiscard]] inline Domain index(double count, std::string of) {
    return numbers("index of " + of, [=](double x) { return x >= 0.0 && x < count; });
}
/// -1, or an index.
[[nodiscard]] inline Domain parent(double count) {
    return numbers("-1, or index of a bone; no circles", [=](double x) { return x >= -1.0 && x < count; })
        .open();
}

/// How many elements a list may have.
struct Size {
    enum class Rule { any, exactly, at_least } rule = Rule::any;
    std::size_t least = 0;
    std::string says;
    bool or_none = false;
};
[[nodiscard]] inline Size as_many_as(std::string what) {
    return {Size::Rule::exactly, 0, "as many as " + what, false};
}
[[nodiscard]] inline Size as_many_or_none(std::string what) {
    return {Size::Rule::exactly, 0, "as many as " + what + ", or none", true};
}
[[nodiscard]] inline Size at_least_many(std::size_t least) {
    return {Size::Rule::at_least, least, std::to_string(least) + " or more", false};
}

}  // namespace motus::contracts
