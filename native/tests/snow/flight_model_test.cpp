#include "flight_model.hpp"

#include <catch2/catch.hpp>

using namespace motus::snow;

TEST_CASE("a way is looked at as often, however fine the steps of what moves flakes are", "[snow]") {
    SnowSettings settings;
    for (const double frequency : {1e-3, 1.0, 1000.0}) {
        settings.snow = true;
        settings.snow_frequency = settings.gust_frequency = frequency;
        settings.gusts = 1.0;
        const FlightModel model(settings);
        CHECK(model.look_step == 0x1p-5);
        CHECK(model.step * frequency <= 0x1p-5);
    }
    settings.snow = false;
    settings.rate = 1e-3;
    settings.lifetime = 1e6;
    CHECK(FlightModel(settings).look_step * 4096.0 >= settings.lifetime);
    CHECK(FlightModel(settings).look_step * 1024.0 < settings.lifetime);
}
