#include "landings.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <optional>

#include "flight_model.hpp"

using namespace motus::snow;

TEST_CASE("pages of landings are kept as long as their snow, and no longer", "[snow]") {
    SnowSettings settings;
    settings.ground = 0.0;
    const FlightModel model(settings);
    std::optional<Landings> first(std::in_place, model, settings);
    const Landings second(model, settings);
    const std::weak_ptr<const LandingPage> of_first = first->page(0), of_second = second.page(0);
    CHECK(first->page(0) == of_first.lock());
    CHECK(of_first.lock() != of_second.lock());
    first.reset();
    CHECK(of_first.expired());
    CHECK(second.kept(0) == of_second.lock());
}
