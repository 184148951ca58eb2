#include <atomic>

#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/core/executor.hpp"
#include "motus/core/memory.hpp"
#include "motus/core/numeric.hpp"
#include "motus/noise/gusts.hpp"
#include "motus/noise/noise.hpp"

namespace motus::contracts {
namespace {

[[nodiscard]] Domain tells() {
    return any_at_rest("any");
}

}  // namespace

void add_core(Table& table) {
    add(
        table, "Executor::Executor(threads)", [](std::size_t threads) { return Executor(threads).threads(); },
        arg("threads", std::size_t{2}, tells().in_words("any; 0 is 1")))
        .costs("O(1)");
    add(
        table, "Executor::Executor(threads, run)",
        [](std::size_t threads) {
            return Executor(threads, [](std::size_t, const std::function<void()>& work) { work(); })
                .threads();
        },
        arg("threads", std::size_t{2}, tells().in_words("any; 0 is 1")))
        .costs("O(1)")
        .adds("`run` must be a function")
        .allocates(Memory::scratch);
    add(
        table, "Executor::run(times, work)",
        [](std::size_t times) {
            std::atomic<int> calls{0};
            Executor(2).run(times, [&] { ++calls; });
            return calls.load();
        },
        arg("times", std::size_t{2}, tells()))
        .costs("some 20 µs a thread")
        .allocates(Memory::scratch);
    add(
        table, "set_cache_budget(bytes)",
        [](std::size_t bytes) {
            const std::size_t before = cache_budget();
            set_cache_budget(bytes);
            set_cache_budget(before);
        },
        arg("bytes", std::size_t{1} << 30U, tells()))
        .costs("O(kept tables)");
    add(table, "cache_budget()", [] { return cache_budget(); }).costs("O(1)");
    add(table, "cached_bytes()", [] { return cached_bytes(); }).costs("O(1)");
    add(table, "thread_count()", [] { return thread_count(); }).costs("O(1)");
    add(table, "clear_caches()", [] { clear_caches(); }).costs("O(kept tables)");
    add(table, "require(holds, problem)", [] { require(true, "holds: must be true"); }).costs("O(1)");
    add(
        table, "are_finite(values)", [](double value) { return are_finite(value); },
        arg("values", 1.0, tells()))
        .costs("O(1)");
    add(
        table, "are_finite(values)",
        [](const auto& values) { return are_finite(std::span<const float>(values)); },
        arg("values", std::vector<float>{1.0F, 2.0F}, tells()))
        .costs("O(n)");
    add(
        table, "are_finite(values)",
        [](const auto& values) { return are_finite(std::span<const double>(values)); },
        arg("values", std::vector<double>{1.0, 2.0}, tells()))
        .costs("O(n)");
    add(
        table, "is_finite(v)", [](const glm::dvec3& v) { return is_finite(v); },
        arg("v", glm::dvec3(1.0), tells()))
        .costs("O(1)");
    add(
        table, "is_finite(q)", [](const glm::dquat& q) { return is_finite(q); },
        arg("q", glm::dquat(1.0, 0.0, 0.0, 0.0), tells()))
        .costs("O(1)");
    add(
        table, "is_finite(matrix)", [](const glm::dmat4& matrix) { return is_finite(matrix); },
        arg("matrix", glm::dmat4(1.0), tells()))
        .costs("O(1)");
    const glm::dvec3 along{0.3, 0.4, 0.5};
    add(
        table, "unit_vector(v)", [](const glm::dvec3& v) { return unit_vector(v); },
        arg("v", along, any_passed_on()))
        .costs("O(1)");
    add(
        table, "direction_of(v)", [](const glm::dvec3& v) { return direction_of(v); },
        arg("v", along, tells().in_words("any; none if it is not finite")))
        .costs("O(1)");
    add(
        table, "direction_or(v, otherwise)",
        [](const glm::dvec3& v, const glm::dvec3& otherwise) { return direction_or(v, otherwise); },
        arg("v", along, any_passed_on().in_words("up to 1e150 in size; of NaN it is `otherwise`")),
        arg("otherwise", along, tells()))
        .costs("O(1)")
        .infinite();
    add(
        table, "length_of(v)", [](const glm::dvec3& v) { return length_of(v); },
        arg("v", along, any().unbounded()))
        .costs("O(1)");
    add(
        table, "smooth_step(x)", [](double x) { return smooth_step(x); }, arg("x", 0.4, any()))
        .costs("O(1)");
    table.moved.push_back({"Executor", "one thread of the library's, or the host's", [] {
                               Executor executor(3);
                               const Executor taken = std::move(executor);
                               int calls = 0;
                               executor.run(1, [&] { ++calls; });  // NOLINT(bugprone-use-after-move)
                               expect(calls == 1 && taken.threads() == 3, "works");
                               executor = taken;
                           }});
}

void add_noise(Table& table) {
    const auto row = [&](const char* signature, auto call, auto place) {
        add(table, signature, call, arg("place", place, any())).costs("O(1), some 100 ns");
    };
    row(
        "noise::value(place, seed)", [](double place) { return noise::value(place, 7); }, 0.3);
    row(
        "noise::value(place, seed)", [](const glm::dvec2& place) { return noise::value(place, 7); },
        glm::dvec2(0.3));
    row(
        "noise::value(place, seed)", [](const glm::dvec3& place) { return noise::value(place, 7); },
        glm::dvec3(0.3));
    row(
        "noise::gradient(place, seed)", [](double place) { return noise::gradient(place, 7); }, 0.3);
    row(
        "noise::gradient(place, seed)", [](const glm::dvec2& place) { return noise::gradient(place, 7); },
        glm::dvec2(0.3));
    row(
        "noise::gradient(place, seed)", [](const glm::dvec3& place) { return noise::gradient(place, 7); },
        glm::dvec3(0.3));
    add(
        table, "noise::looped(place, period, seed)",
        [](double place, std::uint32_t period) { return noise::looped(place, period, 7); },
        arg("place", 0.3, any()), arg("period", 5U, from(1.0, 0x1p28)))
        .costs("O(1), some 100 ns");
    add(
        table, "noise::steps(place, blend, seed)",
        [](double place, double blend) { return noise::steps(place, blend, 7); }, arg("place", 0.3, any()),
        arg("blend", 0.5, from(0.0, 1.0)))
        .costs("O(1)");
    const auto rows = [&]<class Element>(std::vector<Element> places) {
        add(
            table, "noise::values(places, seed, out)",
            [](const auto& given, auto found) { noise::values(given, 7, found); },
            arg("places", std::move(places), any(), as_many_as("`out`")), out<float>("out", 5, "`places`"))
            .costs("O(n), 1 to 4 ns a place");
    };
    rows(std::vector<float>(5, 0.3F));
    rows(std::vector<glm::vec2>(5, glm::vec2(0.3F)));
    rows(std::vector<glm::vec3>(5, glm::vec3(0.3F)));
    add(
        table, "noise::Gusts::Gusts(frequency, period)",
        [](double frequency, double period) { return noise::Gusts(frequency, period).value(0.7); },
        arg("frequency", 0.3, numbers("> 0 to 1000", [](double x) { return x > 0.0 && x <= 1000.0; })),
        arg("period", 2.0,
            numbers("0, or 1e-06 to 1e+30", [](double x) { return x == 0.0 || (x >= 1e-6 && x <= 1e30); })))
        .costs("O(1)");
    add(
        table, "noise::Gusts::value(time)", [](double time) { return noise::Gusts(0.3).value(time); },
        arg("time", 0.7, any().unbounded()))
        .costs("O(1), some 50 ns");
    add(
        table, "noise::values(gusts, times, out)",
        [](const auto& times, auto found) { noise::values(noise::Gusts(0.3), times, found); },
        arg("times", std::vector<double>(5, 0.3), any().unbounded(), as_many_as("`out`")),
        out<double>("out", 5, "`times`"))
        .costs("O(n), some 50 ns a time");
}

}  // namespace motus::contracts
