#include "landings.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <optional>

#include "course.hpp"

using namespace motus::snow;

TEST_CASE("pages of landings are kept as long as their snow, and no longer", "[snow]") {
    Settings settings;
    settings.ground = 0.0;
    const Course course(settings);
    std::optional<Landings> first(std::in_place, course, settings);
    const Landings second(course, settings);
    const std::weak_ptr<const LandingPage> of_first = first->page(0), of_second = second.page(0);
    CHECK(first->page(0) == of_first.lock());
    CHECK(of_first.lock() != of_second.lock());
    first.reset();
    CHECK(of_first.expired());
    CHECK(second.kept(0) == of_second.lock());
}
