// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/light_map.h"

#include <optional>
#include <vector>

// What light maps are fitted from, for techniques that place layers of their own.
namespace gnomon::shadow::parts {

/// World to a light's axes: x, y across, z along its direction (depth in metres).
mat4 light_axes(vec3 origin, vec3 direction, vec3 up);

std::vector<vec3> corners(const Bounds&);

/// How much wider a single layer is than its receivers: a rim, so that the outermost ones still have neighbours to filter.
float rim_factor(const LightMapSettings&);

/// A square of `extent` metres about `centre` in a light's axes; `receivers`, `casters`: least and greatest depth. Stored depth reaches
/// from the first caster to the last receiver.
shaders::LightMapLayer orthographic_layer(const mat4& axes, vec2 centre, float extent, vec2 receivers, vec2 casters, int size);

/// A parallel light's layer: orthographic, around `receivers`, from the first of `casters` (points that hold all of them) to the last
/// receiver.
shaders::LightMapLayer fit_parallel_layer(
    vec3 direction, const std::vector<vec3>& receivers, const std::vector<vec3>& casters, const LightMapSettings&);

/// Where each of `count` cascades ends between `near` and `far`, along the view: `split` = 0 gives them one length, 1 one ratio (the
/// optimum for a plane through the view's axis that the light grazes), and between is the mean so weighted (Zhang, Sun, Xu, Lun 2006,
/// "Parallel-split shadow maps", equation 4). One ratio counts from `nearest`, where that is further off than `near`: from there on there
/// is something to see, and cascades would lie before it (Lloyd 2007, section 5.1.8). The first still begins at `near`.
std::vector<float> cascade_ends(float near, float far, int count, float split, float nearest = 0.0f);

/// A layer for each cascade.
void fit_cascades(shaders::LightMap&, const Bounds&, const scene::View&, vec3 direction, const LightMapSettings&);

/// A layer of what is seen of a scene, warped as `settings.fitting.fit` says (psm, lispsm, tsm; cascades_warped is lispsm). `focused`: the
/// layer that is warped, of whose map all `receivers` are part. None where the warp has no meaning or would do harm: the light shines along
/// the view, the view is orthographic, no projection holds all receivers, or texels would differ ten thousandfold in width, or, of lispsm
/// with Lloyd's falloff, the storage factor would grow.
std::optional<shaders::LightMapLayer> warped_layer(
    const shaders::LightMapLayer& focused, const scene::View&, const std::vector<vec3>& receivers, const LightMapSettings&);

/// What one perspective layer, or the faces of a cube, see from a point of a light.
struct PointFit {
    std::vector<shaders::LightMapLayer> layers;
    std::vector<int>
        faces; ///< of each layer: its place in a cube of the world's axes (shaders/light_map.glsl), -1 where one layer holds all
};

/// The fewest layers from `position` in which the convex hull of `receivers` lies: one where no receiver is further than 63 degrees from
/// its axis, else those faces of a cube that the hull may touch.
PointFit fit_point_layers(vec3 position, const std::vector<vec3>& receivers, const Bounds& casters, const LightMapSettings&);

/// What the GPU has found out about a map's layers; invalid where the CPU has.
struct OnGpu {
    gpu::BufferId fitted{}; ///< as LightMap::fitted
    gpu::BufferId commands{}; ///< as cull_casters (parts/cull.h) writes
};

/// Draws opaque and masked casters into the layers of `map`, the first ones of `depth`: one pass, culled per layer. The format is
/// `depth`'s. With `before`, only what lies behind the depths of that image.
void draw_light_layers(gpu::PassList&, const Frame&, const shaders::LightMap& map, const LightMapSettings&, gpu::ImageId depth,
    gpu::ImageId before = {}, OnGpu = {});

/// The same of paraboloids: each triangle as the box around its image, each fragment its own ray against the triangle.
void draw_paraboloid_layers(gpu::PassList&, const Frame&, const shaders::LightMap& map, const LightMapSettings&, gpu::ImageId depth);

/// The same with fragment shaders of one's own, into the targets of `pass`, whose name, program (opaque casters), constants and targets are
/// given. Both programs have src/shadow/parts/light_casters.glsl's vertices: bindings 0 and 1 are the instances and materials, before those
/// of `pass`, and the constants begin with clip_from_world for each layer. `commands`: as OnGpu.
void draw_casters(gpu::PassList&, const Frame&, const shaders::LightMap& map, const LightMapSettings&, gpu::RasterPass pass,
    const gpu::Program& masked, gpu::BufferId commands = {});

/// What draws into a layer of the map: its clip coordinates.
mat4 clip_from_world(const shaders::LightMapLayer&);

/// What the shaders that draw casters take (shaders::LightDepthConstants). `fitted`: as LightMap::fitted.
gpu::Constants caster_constants(const shaders::LightMap&, float slope_bias, gpu::BufferId fitted);

/// The planes between which an instance casts into a layer. Without the near plane for orthographic layers: casters before it are clamped
/// onto it, not lost.
Planes caster_planes(const shaders::LightMapLayer&);

} // namespace gnomon::shadow::parts
