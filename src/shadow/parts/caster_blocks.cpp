// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/caster_blocks.h"

#include <algorithm>

namespace gnomon::shadow::parts {

std::vector<shaders::CasterBlock> caster_blocks(const SceneGpu& scene)
{
    std::vector<shaders::CasterBlock> blocks;
    const std::vector<SceneGpu::Drawable> drawables = scene.drawables();
    for (const DrawSet set : {draw_opaque, draw_masked})
        for (const SceneGpu::Drawable& d : drawables) {
            const uint32_t triangles = d.set == set ? d.index_count / 3 : 0;
            for (uint32_t first = 0; first < triangles; first += CASTER_BLOCK)
                blocks.push_back({d.slot, first, std::min(uint32_t(CASTER_BLOCK), triangles - first), uint32_t(set == draw_masked)});
        }
    return blocks;
}

std::vector<shaders::CasterBox> caster_boxes(const SceneGpu& resources, std::span<const shaders::CasterBlock> blocks)
{
    const scene::Scene& scene = resources.scene();
    const std::vector<SceneGpu::Drawable> drawables = resources.drawables(); // by slot
    std::vector<std::vector<Bounds>> meshes(scene.meshes.size());
    std::vector<shaders::CasterBox> boxes;
    for (const shaders::CasterBlock& block : blocks) {
        const SceneGpu::Drawable& d = drawables[block.slot];
        const scene::Mesh& mesh = scene.meshes[d.mesh];
        std::vector<Bounds>& own = meshes[d.mesh];
        if (own.empty()) {
            own.resize((mesh.triangle_count() + CASTER_BLOCK - 1) / CASTER_BLOCK);
            for (size_t i = 0; i < mesh.indices.size(); ++i) own[i / (3 * CASTER_BLOCK)].add(mesh.positions[mesh.indices[i]]);
        }
        const Bounds b = transformed(own[block.first / CASTER_BLOCK], scene.instances[d.instance].world_from_object);
        const vec3 furthest = glm::max(glm::abs(b.min), glm::abs(b.max));
        boxes.push_back({b.centre(), 0.5f * (b.max - b.min) + 1e-6f * furthest});
    }
    return boxes;
}

} // namespace gnomon::shadow::parts
