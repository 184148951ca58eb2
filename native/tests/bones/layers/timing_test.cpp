#include "motus/bones/layers/timing.hpp"

#include <catch2/catch.hpp>

using namespace motus::bones::layers;

namespace {

constexpr LayerTiming throw_at_20{20.0, 1.0, 25.0, 2.0, After::nothing, 4.0, 4.0};  // lasts 12 frames

}  // namespace

TEST_CASE("a layer plays from its start to its end", "[layers]") {
    CHECK(moment_of(throw_at_20, 20.0).frame == 1.0);
    CHECK(moment_of(throw_at_20, 23.25).frame == 7.5);
    CHECK(moment_of(throw_at_20, 32.0).frame == 25.0);
    CHECK(moment_of(throw_at_20, 19.999).weight == 0.0);
    CHECK(moment_of(throw_at_20, 20.0).weight == 0.0);
    CHECK(moment_of(throw_at_20, 22.0).weight == 0.5);
    CHECK(moment_of(throw_at_20, 26.0).weight == 1.0);
    CHECK(moment_of(throw_at_20, 30.0).weight == 0.5);
    CHECK(moment_of(throw_at_20, 32.0).weight == 0.0);
    CHECK(moment_of(throw_at_20, 33.0).weight == 0.0);
}

TEST_CASE("a layer without blending has its whole weight from its first to its last frame", "[layers]") {
    LayerTiming timing = throw_at_20;
    timing.blend_in = timing.blend_out = 0.0;
    CHECK(moment_of(timing, 20.0).weight == 1.0);
    CHECK(moment_of(timing, 32.0).weight == 1.0);
    CHECK(moment_of(timing, 32.001).weight == 0.0);
}

TEST_CASE("a layer may hold its last pose, or repeat", "[layers]") {
    LayerTiming timing = throw_at_20;
    timing.after = After::hold;
    CHECK(moment_of(timing, 1000.0).frame == 25.0);
    CHECK(moment_of(timing, 1000.0).weight == 1.0);
    timing.after = After::repeat;
    CHECK(moment_of(timing, 32.0).frame == 1.0);
    CHECK(moment_of(timing, 47.25).frame == 7.5);
    CHECK(moment_of(timing, 47.25).weight == 1.0);
    CHECK(moment_of(timing, 19.0).weight == 0.0);
}

TEST_CASE("a layer of negative speed plays backwards, one of speed 0 stands still", "[layers]") {
    LayerTiming timing = throw_at_20;
    timing.speed = -2.0;
    CHECK(moment_of(timing, 20.0).frame == 25.0);
    CHECK(moment_of(timing, 23.25).frame == 18.5);
    timing.speed = 0.0;
    CHECK(moment_of(timing, 500.0).frame == 1.0);
    CHECK(moment_of(timing, 500.0).weight == 1.0);
}

TEST_CASE("an action of one frame repeats itself", "[layers]") {
    const LayerTiming timing{1.0, 7.0, 7.0, 1.0, After::repeat, 0.0, 0.0};
    CHECK(moment_of(timing, 100.5).frame == 7.0);
    CHECK(moment_of(timing, 100.5).weight == 1.0);
}
