// A small mesh, as bytes have it.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "bytes.hpp"

namespace motus::fuzzers {

/// Of 15 vertices and 20 triangles at most, on a grid as a rule, so that some coincide and some lie on one
/// line; some triangles name a vertex that there is not.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    std::vector<glm::ivec2> wires;

    explicit Mesh(Bytes& bytes) {
        positions.resize(bytes.count(15));
        for (glm::vec3& position : positions) position = corner(bytes);
        triangles.resize(bytes.count(20));
        for (glm::ivec3& triangle : triangles)
            for (int i = 0; i < 3; ++i) triangle[i] = index(bytes);
        wires.resize(bytes.count(2));
        for (glm::ivec2& wire : wires)
            for (int i = 0; i < 2; ++i) wire[i] = index(bytes);
    }

  private:
    static glm::vec3 corner(Bytes& bytes) {
        const std::uint8_t where = bytes.byte();
        if (where >= 192) return bytes.single_place();
        return {static_cast<float>(where % 4) - 1.5F, static_cast<float>(where / 4 % 4) - 1.5F,
                0.5F * static_cast<float>(where / 16 % 4)};
    }
    [[nodiscard]] int index(Bytes& bytes) const {
        const std::uint8_t which = bytes.byte();
        if (positions.empty() || which >= 250) return which - 251;
        return static_cast<int>(which % positions.size());
    }
};

}  // namespace motus::fuzzers
