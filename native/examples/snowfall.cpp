// A million flakes at a time of your choice, written straight into buffers: snowfall FILE.pgm
// The picture shows them from the side: a pixel is darker the more flakes are in front of it.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <motus/snow/snow.hpp>
#include <vector>

using namespace motus;

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    snow::SnowSettings settings;
    settings.rate = 100'000.0;
    settings.lifetime = 10.0;
    settings.start_speed = 1.2;
    settings.cone_radius = 10.0;  // the flakes are born all over a square of 20 m
    settings.emitter_times = {0.0};
    // The emitter's +Z, along which flakes leave, points down.
    settings.emitter_matrices = {glm::dmat4{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 10, 1}};
    settings.drag = 1.5;
    settings.wind = {1.0, 0.0, -1.0};
    settings.turbulence = 0.5;
    settings.seed = 7;
    const snow::Snow snow(settings);

    // An hour after the first flake: nothing that happened before is computed.
    const snow::Living living = snow.living(3600.0);
    std::vector<glm::vec3> positions(living.count());
    std::vector<float> ages(living.count());
    snow.evaluate(living, {.position = positions, .age = ages});

    constexpr int width = 640, height = 320;
    const float metres = 32.0F;  // across the picture
    std::vector<int> flakes(static_cast<std::size_t>(width * height));
    for (const glm::vec3& place : positions) {
        const int column = static_cast<int>((place.x + 0.35F * metres) / metres * width);
        const int row = height - 1 - static_cast<int>((place.z + 5.0F) / metres * width);
        if (column >= 0 && column < width && row >= 0 && row < height) {
            ++flakes[static_cast<std::size_t>(row * width + column)];
        }
    }

    std::ofstream file(argv[1], std::ios::binary);
    file << "P5 " << width << ' ' << height << " 255\n";
    for (const int count : flakes) file.put(static_cast<char>(255 - std::min(255, 12 * count)));
    return file.flush() ? 0 : 1;
}
