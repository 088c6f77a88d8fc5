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

} // namespace gnomon::shadow::parts
