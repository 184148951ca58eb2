// Threads of a program that ends may be at work in the library: Blender's evaluate until the last moment.
#include <catch2/catch.hpp>

#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "curve/checks.hpp"
#include "motus/curve/arc_length.hpp"
#include "motus/path/frames.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;
using namespace motus::path;

namespace {

std::atomic<bool> is_ending{false};
std::atomic<long> looked_up{0};

void look_up_for_ever(unsigned seed) {
    RandomCurves random(seed);
    std::vector<Curve> curves;
    for (int i = 0; i < 150; ++i) curves.push_back(random.bezier(3));  // more than are kept
    for (std::size_t i = 0;; i = (i + 1) % curves.size()) {
        const std::shared_ptr<const ArcLength> path = shared_arc_length(curves[i]);
        (void)shared_frames(path, {}).at(0.5 * path->length(), 1.0);
        ++looked_up;
    }
}

/// Ends later than all that is made after the program's start: what threads need until then has to be there.
struct Last {
    Last() = default;
    ~Last() {
        if (!is_ending) return;
        const long before = looked_up;
        for (int i = 0; i < 2000 && looked_up < before + 500; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (looked_up < before + 500) _exit(3);
    }
    Last(const Last&) = delete;
    Last& operator=(const Last&) = delete;
    Last(Last&&) = delete;
    Last& operator=(Last&&) = delete;
} const last;

}  // namespace

TEST_CASE("threads look up tables while the program ends", "[cache]") {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        is_ending = true;
        for (const unsigned seed : {1u, 2u}) std::thread(look_up_for_ever, seed).detach();
        while (looked_up < 300) std::this_thread::yield();
        std::exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}
#endif
