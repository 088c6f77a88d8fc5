// SPDX-License-Identifier: Apache-2.0
#include "techniques/shadow_texture/caster_bits.h"

namespace gnomon::techniques::shadow_texture {

std::vector<uint32_t> caster_bits(const scene::Scene& s, float largest)
{
    std::vector<uint32_t> bits(s.triangle_count() / 32 + 1, 0);
    const float limit = largest * s.bounds().radius();
    uint32_t primitive = 0;
    for (const scene::Instance& instance : s.instances) {
        const scene::Mesh& mesh = s.meshes[size_t(instance.mesh)];
        const uint32_t end = primitive + uint32_t(mesh.triangle_count());
        const bool casts = transformed(mesh.bounds, instance.world_from_object).radius() <= limit;
        for (; primitive < end; ++primitive)
            if (casts) bits[primitive / 32] |= 1u << (primitive % 32);
    }
    return bits;
}

} // namespace gnomon::techniques::shadow_texture
