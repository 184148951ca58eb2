// Random chains, and properties that every solution must have; for the tests of both solvers of chains.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "random.hpp"

namespace motus::bones::chains::checks {

using Joints = std::vector<glm::dvec3>;

using test::Random;

inline double length_of(const Joints& joints) {
    double length = 0.0;
    for (std::size_t i = 1; i < joints.size(); ++i) length += glm::distance(joints[i - 1], joints[i]);
    return length;
}

/// Least distance of the chain's tip from its root.
inline double inner_reach(const Joints& joints) {
    double longest = 0.0;
    for (std::size_t i = 1; i < joints.size(); ++i)
        longest = std::max(longest, glm::distance(joints[i - 1], joints[i]));
    return std::max(0.0, 2.0 * longest - length_of(joints));
}

enum class Shape { straight, bent, crooked, knotted, folded };
inline constexpr Shape all_shapes[] = {Shape::straight, Shape::bent, Shape::crooked, Shape::knotted,
                                       Shape::folded};

/// `longest`: at most how many times as long as the others one bone is.
inline Joints random_joints(Random& random, Shape shape, std::size_t bones, double longest = 1.0) {
    Joints joints{5.0 * random.direction()};
    glm::dvec3 direction = random.direction();
    const glm::dvec3 first = direction;
    const glm::dquat turn = glm::angleAxis(3.0 / static_cast<double>(bones), random.direction());
    const auto odd = static_cast<std::size_t>(random.between(0.0, static_cast<double>(bones)));
    for (std::size_t i = 0; i < bones; ++i) {
        if (shape == Shape::bent) direction = turn * direction;
        if (shape == Shape::crooked) direction = glm::normalize(first + 0.7 * random.direction());
        if (shape == Shape::knotted) direction = random.direction();
        if (shape == Shape::folded) direction = -direction;
        const double length = random.between(0.2, 1.0) * (i == odd ? longest : 1.0);
        joints.push_back(joints.back() + length * direction);
    }
    return joints;
}

/// Largest distance between two joints of the same number.
inline double largest_move(const Joints& a, const Joints& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, glm::distance(a[i], b[i]));
    return largest;
}

/// How far joints move over the quickest of `count` steps from 0 to 1 when that is halved again and again:
/// what stays is a jump.
inline double largest_jump(const std::function<Joints(double)>& joints_at, int count = 500) {
    double low = 0.0;
    double high = 1.0;
    double quickest = -1.0;
    for (int i = 0; i < count; ++i) {
        const double from = static_cast<double>(i) / count;
        const double to = static_cast<double>(i + 1) / count;
        const double moved = largest_move(joints_at(from), joints_at(to));
        if (moved > quickest) {
            quickest = moved;
            low = from;
            high = to;
        }
    }
    for (int i = 0; i < 36; ++i) {
        const double middle = 0.5 * (low + high);
        const Joints joints = joints_at(middle);
        const bool is_first = largest_move(joints_at(low), joints) > largest_move(joints, joints_at(high));
        (is_first ? high : low) = middle;
    }
    return largest_move(joints_at(low), joints_at(high));
}

}  // namespace motus::bones::chains::checks
