// What GLM's types must look like wherever the library's headers are included. Its functions take them by
// reference and in arrays, so a program that configures GLM otherwise would link, and read wrong numbers.
#pragma once

#if defined(GLM_FORCE_QUAT_DATA_WXYZ)
#error "Motus needs GLM's quaternions in their usual order: compile without GLM_FORCE_QUAT_DATA_WXYZ"
#endif
#if defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)
#error "Motus needs GLM's packed vectors: compile without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES"
#endif
#if defined(GLM_FORCE_PRECISION_LOWP_FLOAT) || defined(GLM_FORCE_PRECISION_MEDIUMP_FLOAT) ||   \
    defined(GLM_FORCE_PRECISION_LOWP_DOUBLE) || defined(GLM_FORCE_PRECISION_MEDIUMP_DOUBLE) || \
    defined(GLM_FORCE_PRECISION_LOWP_INT) || defined(GLM_FORCE_PRECISION_MEDIUMP_INT)
#error "Motus needs GLM's types of full precision: compile without GLM_FORCE_PRECISION_LOWP_* and _MEDIUMP_*"
#endif

#include <cstddef>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

// The qualifier is part of the name that the linker looks for.
static_assert(std::is_same_v<glm::vec3, glm::vec<3, float, glm::packed_highp>>);
static_assert(std::is_same_v<glm::dvec3, glm::vec<3, double, glm::packed_highp>>);
static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && alignof(glm::vec3) == alignof(float));
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && alignof(glm::dvec3) == alignof(double));
static_assert(sizeof(glm::vec4) == 4 * sizeof(float) && alignof(glm::vec4) == alignof(float));
static_assert(sizeof(glm::mat4) == 16 * sizeof(float) && sizeof(glm::dmat4) == 16 * sizeof(double));
static_assert(offsetof(glm::quat, x) == 0 && offsetof(glm::quat, w) == 3 * sizeof(float));
static_assert(offsetof(glm::dquat, x) == 0 && offsetof(glm::dquat, w) == 3 * sizeof(double));
