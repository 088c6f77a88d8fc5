// SPDX-License-Identifier: Apache-2.0
#include "techniques/alias_free/alias_free_blocks.h"

#include <algorithm>

namespace gnomon::techniques::alias_free {

namespace {

using namespace gpu;

/// Takes down what a draw of the scene would draw: which slots of its instances, and how many triangles of each.
class Lister final : public Encoder {
public:
    explicit Lister(std::vector<CasterBlock>& blocks)
        : blocks_(blocks)
    {
    }
    uint masked = 0;

    void draw_indexed(uint32_t indices, uint32_t instances, uint32_t, int32_t, uint32_t first_instance) override
    {
        for (uint32_t slot = first_instance; slot < first_instance + instances; ++slot)
            for (uint32_t first = 0; first < indices / 3; first += CASTER_BLOCK)
                blocks_.push_back({slot, first, std::min(uint32_t(CASTER_BLOCK), indices / 3 - first), masked});
    }
    void vertex_buffer(uint32_t, const Buffer&, uint64_t) override { }
    void index_buffer(const Buffer&, uint64_t) override { }
    void vertex_buffer(uint32_t, BufferId, uint64_t) override { }
    void index_buffer(BufferId, uint64_t) override { }
    void cull(VkCullModeFlags) override { }
    void depth_bias(float, float, float) override { }
    void scissor(int, int, uint32_t, uint32_t) override { }
    void viewport(float, float, float, float) override { }
    void draw(uint32_t, uint32_t, uint32_t, uint32_t) override { }
    void draw_indexed_indirect(BufferId, uint64_t, uint32_t, uint32_t) override { }
    void draw_indirect(BufferId, uint64_t, uint32_t, uint32_t) override { }
    void program(const Program&) override { }
    VkCommandBuffer handle() override { return VK_NULL_HANDLE; }

private:
    std::vector<CasterBlock>& blocks_;
};

} // namespace

std::vector<CasterBlock> caster_blocks(shadow::SceneGpu& scene)
{
    std::vector<CasterBlock> blocks;
    Lister lister(blocks);
    scene.draw(lister, {.sets = shadow::draw_opaque});
    lister.masked = 1;
    scene.draw(lister, {.sets = shadow::draw_masked});
    return blocks;
}

} // namespace gnomon::techniques::alias_free
