// SPDX-License-Identifier: Apache-2.0
#pragma once

// One place configures GLM for the whole project: depth in [0, 1], right-handed, explicit constructors.
#ifndef GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#endif
#ifndef GLM_FORCE_XYZW_ONLY
#define GLM_FORCE_XYZW_ONLY
#endif
#ifndef GLM_ENABLE_EXPERIMENTAL
#define GLM_ENABLE_EXPERIMENTAL
#endif
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <limits>
#include <numbers>

namespace gnomon {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float pi = std::numbers::pi_v<float>;

/// Axis-aligned bounds in metres; empty while min > max.
struct Bounds {
    vec3 min = vec3(std::numeric_limits<float>::infinity());
    vec3 max = vec3(-std::numeric_limits<float>::infinity());
    void add(vec3 p) { min = glm::min(min, p), max = glm::max(max, p); }
    void add(const Bounds& b) { min = glm::min(min, b.min), max = glm::max(max, b.max); }
    bool empty() const { return min.x > max.x; }
    vec3 centre() const { return 0.5f * (min + max); }
    float radius() const { return empty() ? 0.0f : 0.5f * glm::length(max - min); }
};

/// Bounds of the box `b` after `m` (all eight corners).
Bounds transformed(const Bounds& b, const mat4& m);

} // namespace gnomon
