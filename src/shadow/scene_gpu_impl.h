// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/scene_gpu.h"

// What SceneGpu holds; shared by its two source files only.
namespace gnomon::shadow {

/// C++ side of the structs in shaders/scene.glsl (scalar layout).
namespace gpu_layout {
struct Attributes {
    uint32_t normal;
    vec2 uv;
    uint32_t color;
};
struct Instance {
    vec4 rows[3];
    uint32_t first_primitive, material, first_index, first_vertex;
};
struct TextureUse {
    int32_t index;
    vec3 u_row, v_row;
};
struct Material {
    vec4 base_color;
    vec3 emissive;
    float metallic, roughness, alpha_cutoff;
    uint32_t flags;
    float transmission;
    vec3 volume_tint;
    TextureUse base_color_texture, metallic_roughness_texture, emissive_texture;
};
static_assert(sizeof(Instance) == 64 && sizeof(Material) == 60 + 3 * 28);
} // namespace gpu_layout

using MeshRange = SceneGpu::MeshRange;

/// An instance in drawing order.
struct Slot {
    uint32_t instance, mesh;
    DrawSet set;
    bool double_sided;
    Bounds bounds; ///< world
};

struct SceneGpu::Impl {
    gpu::Device* device = nullptr;
    const scene::Scene* scene = nullptr;
    Bounds bounds;
    unsigned sets = 0;
    bool emits = false;
    std::vector<MeshRange> ranges; ///< by mesh
    std::vector<Slot> slots;
    gpu::Buffer positions, attributes, indices, instances, materials, previous, previous_instances, casters;
    std::vector<gpu::Image> images;
    gpu::TextureTable textures;
    std::vector<gpu::AccelerationStructure> blas; ///< by mesh; empty entries for meshes that block no light
    gpu::AccelerationStructure tlas;
    std::shared_ptr<const void> content = std::make_shared<char>(), shapes = std::make_shared<char>();
    SceneGpu::Filter filter;
};

} // namespace gnomon::shadow
