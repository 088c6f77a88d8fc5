// SPDX-License-Identifier: Apache-2.0
#include "gpu/resources_impl.h"

#include <stdexcept>

namespace gnomon::gpu {

TextureTable::Impl::~Impl()
{
    if (pool) context->release([c = context, p = pool] { c->vk.vkDestroyDescriptorPool(c->handle, p, nullptr); });
}

TextureTable::TextureTable() = default;
TextureTable::TextureTable(TextureTable&&) noexcept = default;
TextureTable& TextureTable::operator=(TextureTable&&) noexcept = default;
TextureTable::~TextureTable() = default;
VkDescriptorSet TextureTable::set() const { return impl_->set; }

TextureTable Device::texture_table(std::span<const VkDescriptorImageInfo> infos)
{
    Context& c = *impl_;
    const uint32_t count = uint32_t(infos.size());
    if (count > c.table_size)
        base::fail("the scene has {} textures and device '{}' can hold {} in one table; merge textures into atlases", count, c.info.name,
            c.table_size);
    TextureTable table;
    table.impl_ = std::make_unique<TextureTable::Impl>();
    TextureTable::Impl& t = *table.impl_;
    t.context = &c;
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, std::max(count, 1u)};
    const VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, 1, &size};
    check(c.vk.vkCreateDescriptorPool(c.handle, &pool, nullptr, &t.pool), "vkCreateDescriptorPool", "the texture table");
    const VkDescriptorSetVariableDescriptorCountAllocateInfo variable{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_VARIABLE_DESCRIPTOR_COUNT_ALLOCATE_INFO, nullptr, 1, &size.descriptorCount};
    const VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, &variable, t.pool, 1, &c.table_layout};
    check(c.vk.vkAllocateDescriptorSets(c.handle, &allocate, &t.set), "vkAllocateDescriptorSets", "the texture table");
    std::vector<VkWriteDescriptorSet> writes;
    for (uint32_t i = 0; i < count; ++i)
        if (infos[i].imageView)
            writes.push_back({VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, t.set, 0, i, 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                &infos[i], nullptr, nullptr});
    if (!writes.empty()) c.vk.vkUpdateDescriptorSets(c.handle, uint32_t(writes.size()), writes.data(), 0, nullptr);
    return table;
}

TextureTable Device::texture_table(std::span<const Image* const> images, std::span<const Sampler> samplers)
{
    if (images.size() != samplers.size()) throw std::logic_error("texture_table: one sampler an image");
    std::vector<VkDescriptorImageInfo> infos;
    for (size_t i = 0; i < images.size(); ++i) {
        const Image& image = *images[i];
        for (const auto& part : image.state().parts)
            if (part.layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)
                throw std::logic_error(
                    fmt::format("texture_table: upload image '{}' first, and every mip and layer of it", image.desc().name));
        infos.push_back({impl_->sampler(samplers[i], image.desc().format),
            image.view(VK_IMAGE_VIEW_TYPE_2D, 0, 1, 0, image.desc().mips, VK_IMAGE_ASPECT_COLOR_BIT),
            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    }
    return texture_table(infos);
}

} // namespace gnomon::gpu
