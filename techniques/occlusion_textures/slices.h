// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "shadow/scene_gpu.h"
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

#include <vector>

// Where a light's depth is cut.
namespace gnomon::techniques::occlusion_textures {

struct Interval {
    float near, far; ///< metres along a layer's axis
};

/// World-space boxes of the instances that cast.
std::vector<Bounds> caster_boxes(const scene::Scene&);

/// The plane (n, d) of a rectangle or disk, inside before it; none of other lights.
shadow::Planes panel_plane(const scene::Light&);

/// The depths between which each box lies in what a layer sees of the inside of `planes`.
std::vector<Interval> depths_in_layer(const std::vector<Bounds>& boxes, const LightMapLayer&, const shadow::Planes& planes);

/// `count` slices of the depths that `content` covers, near ones first. Each ends where what it may hold ends; those that hold nothing are
/// empty (near > far). No depth lies in two slices.
std::vector<Interval> cut(const std::vector<Interval>& content, int count, int placement, bool perspective);

/// The slices of all layers.
Slices place_slices(const std::vector<Bounds>& boxes, const LightMap&, const shadow::Planes& planes, int count, int placement);

} // namespace gnomon::techniques::occlusion_textures
