// Calls each function of the table with every kind of extreme.
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "allocations.hpp"
#include "contracts/contract.hpp"

namespace motus::contracts {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array reals{0.0,
                           -0.0,
                           1.0,
                           -1.0,
                           0.5,
                           -1e-3,
                           3.5,
                           std::numeric_limits<double>::denorm_min(),
                           -std::numeric_limits<double>::denorm_min(),
                           1e-310,
                           1e-200,
                           -1e-45,
                           1.2e-38,
                           1e-16,
                           1e6,
                           -4294967296.0,
                           0x1p53,
                           -1e18,
                           3.5e38,
                           3.4e38,
                           -1e100,
                           1e154,
                           -1e200,
                           1e300,
                           std::numeric_limits<double>::max(),
                           -std::numeric_limits<double>::max(),
                           infinity,
                           -infinity,
                           std::numeric_limits<double>::quiet_NaN()};
constexpr std::array wholes{-infinity, -1.0,    0.0,          1.0,          2.0,    3.0,     7.0,
                            255.0,     65536.0, 2147483647.0, 4294967295.0, 0x1p53, infinity};

/// What came of a call: nothing, or what it threw.
struct Outcome {
    std::optional<std::string> message;
    bool is_wrong_type = false;
};

Outcome outcome_of(Trial& trial) {
    try {
        trial.call();
    } catch (const std::invalid_argument& problem) {
        return {problem.what(), false};
    } catch (const std::exception& problem) {
        return {problem.what(), true};
    }
    return {};
}

[[nodiscard]] bool are_all_finite(const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

/// One row under test.
class Examination {
  public:
    explicit Examination(const Row& row) : row_(row) {}

    [[nodiscard]] std::vector<std::string> breaches() {
        good_call();
        for (std::size_t slot = 0; slot < row_.slots.size(); ++slot) {
            if (!row_.slots[slot].is_out) change_numbers(slot);
            change_size(slot);
        }
        return std::move(breaches_);
    }

  private:
    /// Of breaches of one kind by one argument the first alone is told.
    void breach(const std::string& where, const std::string& what) {
        if (!seen_.insert(where.substr(0, where.find('[')) + what.substr(0, what.find(':'))).second) return;
        breaches_.push_back(row_.signature + (where.empty() ? "" : ", " + where) + ": " + what);
    }

    void good_call() {
        const auto trial = row_.make(), warm = row_.make();
        (void)outcome_of(*warm);  // caches are filled
        Outcome outcome;
        // An std::function that copies the case allocates; the call itself alone is counted.
        const std::size_t bytes = test::bytes_allocated_by([&] { outcome = outcome_of(*trial); });
        if (outcome.message) return breach("good arguments", "throws " + *outcome.message);
        if (row_.memory == Memory::nothing && bytes != 0)
            breach("", "allocates " + std::to_string(bytes) + " bytes");
        if (!are_all_finite(trial->results()) && !row_.is_infinite)
            breach("good arguments", "a result is not finite");
        if (!trial->is_untouched(false)) breach("good arguments", "writes beside its room");
    }

    void change_numbers(std::size_t slot) {
        const std::size_t count = row_.make()->places(slot).size();
        for (std::size_t place = 0; place < count; ++place) {
            // Of long lists the first elements, the middle and the end.
            if (count > 24 && place > 9 && place + 3 < count && place != count / 2) continue;
            const bool is_whole = row_.make()->places(slot)[place].is_whole();
            for (const double extreme :
                 is_whole ? std::span<const double>(wholes) : std::span<const double>(reals))
                change_number(slot, place, extreme);
        }
    }

    void change_number(std::size_t slot, std::size_t place, double extreme) {
        const auto trial = row_.make();
        const std::vector<Place> places = trial->places(slot);
        if (!places[place].set(extreme)) return;
        std::vector<double> all;
        all.reserve(places.size());
        for (const Place& one : places) all.push_back(one.get());
        const Domain& domain = row_.slots[slot].domain;
        const Verdict verdict = domain.judge({all, place, trial->width(slot)});
        if (verdict == Verdict::untested) return;
        const std::string where =
            row_.slots[slot].name + "[" + std::to_string(place) + "] = " + text_of(all[place]);
        const Outcome outcome = outcome_of(*trial);
        if (outcome.message) return judge_refusal(where, row_.slots[slot].name, verdict, outcome, *trial);
        const std::vector<double> results = trial->results();
        if (!trial->is_untouched(false)) breach(where, "writes beside its room");
        if (verdict == Verdict::refused) return breach(where, "is taken");
        const bool has_nan = std::ranges::any_of(results, [](double x) { return std::isnan(x); });
        if (verdict == Verdict::nan_out && !has_nan) breach(where, "no result is NaN");
        const bool must_be_finite =
            verdict == Verdict::at_rest ||
            (!row_.is_infinite && (verdict == Verdict::taken || verdict == Verdict::open));
        if (must_be_finite && !are_all_finite(results)) breach(where, "a result is not finite");
        if (has_nan && must_be_finite) breach(where, "a result is NaN");
    }

    void judge_refusal(const std::string& where, const std::string& name, Verdict verdict,
                       const Outcome& outcome, Trial& trial) {
        const std::string& message = *outcome.message;
        if (outcome.is_wrong_type)
            return breach(where, "throws what is not std::invalid_argument: " + message);
        if (verdict != Verdict::refused && verdict != Verdict::open) breach(where, "is refused: " + message);
        if (verdict == Verdict::refused && message.rfind(name + ": ", 0) != 0)
            breach(where, "its message does not begin with its name: " + message);
        if (!names_a_slot(message)) breach(where, "the message names no argument: " + message);
        if (!trial.is_untouched(true)) breach(where, "has written before it threw");
    }

    void change_size(std::size_t slot) {
        const Size& size = row_.slots[slot].size;
        for (const int by : {1, -1, -1000}) {
            const auto trial = row_.make();
            int changed = 0;
            for (int i = 0; i < std::abs(by) && trial->resize(slot, by); ++i) ++changed;
            if (changed == 0) continue;
            const bool is_none = by == -1000;
            const std::string where = row_.slots[slot].name + (is_none  ? ", empty"
                                                               : by > 0 ? ", one more"
                                                                        : ", one less");
            const Outcome outcome = outcome_of(*trial);
            const bool may_be_none = is_none && size.or_none;
            const std::size_t left =
                trial->places(slot).size() / std::max<std::size_t>(1, trial->width(slot));
            const bool must_refuse = (size.rule == Size::Rule::exactly && !may_be_none) ||
                                     (size.rule == Size::Rule::at_least && left < size.least);
            if (!outcome.message) {
                if (must_refuse) breach(where, "is taken");
                if (!are_all_finite(trial->results()) && !row_.is_infinite)
                    breach(where, "a result is not finite");
                continue;
            }
            if (may_be_none) breach(where, "is refused: " + *outcome.message);
            if (outcome.is_wrong_type)
                breach(where, "throws what is not std::invalid_argument: " + *outcome.message);
            if (!names_a_slot(*outcome.message))
                breach(where, "the message names no argument: " + *outcome.message);
            if (!trial->is_untouched(true)) breach(where, "has written before it threw");
        }
    }

    [[nodiscard]] bool names_a_slot(const std::string& message) const {
        if (std::ranges::any_of(row_.slots,
                                [&](const Slot& one) { return message.rfind(one.name + ": ", 0) == 0; }))
            return true;
        const std::string name = message.substr(0, message.find(": "));
        const std::string list = row_.signature.substr(row_.signature.find('('));
        return list.find("(" + name + ",") != std::string::npos ||
               list.find(" " + name + ",") != std::string::npos ||
               list.find("(" + name + ")") != std::string::npos ||
               list.find(" " + name + ")") != std::string::npos;
    }

    const Row& row_;
    std::vector<std::string> breaches_;
    std::set<std::string> seen_;
};

}  // namespace

std::vector<std::string> breaches(const Row& row) {
    return Examination(row).breaches();
}

}  // namespace motus::contracts
