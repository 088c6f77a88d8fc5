// SPDX-License-Identifier: Apache-2.0
#include "gpu/pass_list_impl.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

const char* type_name(VkDescriptorType type)
{
    switch (type) {
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
        return "a sampled image (Use::sample)";
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
        return "a sampled image without sampler (Use::sample)";
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
        return "a storage image (Use::load, store or update)";
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        return "a storage buffer (Use::load, store or update)";
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return "a uniform buffer (Use::uniform)";
    case VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR:
        return "an acceleration structure";
    default:
        return "nothing that a binding can be";
    }
}

VkDescriptorType type_of(const Binding& b)
{
    if (b.accel) return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    const bool storage = b.use == Use::load || b.use == Use::store || b.use == Use::update;
    if (b.image && b.use == Use::sample) return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (b.image && storage) return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    if (b.buffer && storage) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (b.buffer && b.use == Use::uniform) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

uint32_t layers_of(VkImageViewType view)
{
    if (view == VK_IMAGE_VIEW_TYPE_CUBE) return 6;
    return view == VK_IMAGE_VIEW_TYPE_2D ? 1 : 0;
}

} // namespace

ImagePart part_of(const Binding& b, const ImageDesc& desc, const ReflectedBinding* shader)
{
    ImagePart part{};
    part.range = {b.first_layer, b.layer_count, b.first_mip, b.mip_count};
    if (b.layer_count == VK_REMAINING_ARRAY_LAYERS) part.range.layers = desc.layers - std::min(b.first_layer, desc.layers);
    // A storage image's shader reaches one mip only.
    if (b.mip_count == VK_REMAINING_MIP_LEVELS) part.range.mips = b.use == Use::sample ? desc.mips - std::min(b.first_mip, desc.mips) : 1;
    part.view = b.view;
    if (part.view == VK_IMAGE_VIEW_TYPE_MAX_ENUM && shader) part.view = shader->view;
    if (part.view == VK_IMAGE_VIEW_TYPE_MAX_ENUM) part.view = part.range.layers == 1 ? VK_IMAGE_VIEW_TYPE_2D : VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    part.aspect = b.aspect ? b.aspect : main_aspect(desc.format);
    return part;
}

void check_bound(
    const Bound& bound, std::span<const Listed<Image, ImageDesc>> images, std::span<const Listed<Buffer, BufferDesc>> buffers, bool others)
{
    if (!bound.program) throw std::logic_error(fmt::format("pass '{}' has no program", bound.pass));
    const auto& program = static_cast<const ProgramImpl&>(*bound.program);
    const auto wrong = [&](const std::string& what) {
        throw std::logic_error(fmt::format("pass '{}', program '{}': {}", bound.pass, program.name, what));
    };
    const size_t count = bound.bindings.size();
    if (count > program.set0_count() && !others)
        wrong(fmt::format("the pass lists {} bindings, and the shader has none at binding {} (or does not use it)", count, count - 1));
    for (size_t i = 0; i < count; ++i) {
        const Binding& b = bound.bindings[i];
        if (!b.accel && (b.image ? b.image.index >= images.size() : b.buffer.index >= buffers.size()))
            wrong(fmt::format("binding {} names no image or buffer of this list; import it or make a transient", i));
    }
    for (const auto& declared : program.bindings) {
        if (declared.set != 0) continue;
        const std::string place = fmt::format("binding {} ('{}')", declared.binding, declared.name);
        if (declared.binding >= count)
            wrong(fmt::format("{} is {}, and the pass lists {} bindings only", place, type_name(declared.type), count));
        const Binding& b = bound.bindings[declared.binding];
        const VkDescriptorType given = type_of(b);
        const bool sampled = given == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER && declared.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        if (given != declared.type && !sampled)
            wrong(fmt::format("{} is {} in the shader, and the pass gives {}", place, type_name(declared.type), type_name(given)));
        if (!b.image) continue;
        const ImageDesc& desc = images[b.image.index].desc;
        const ImagePart part = part_of(b, desc, &declared);
        const Range& r = part.range;
        if (r.layers == 0 || r.mips == 0 || r.first_layer + r.layers > desc.layers || r.first_mip + r.mips > desc.mips)
            wrong(fmt::format("{}: image '{}' has {} layers and {} mips, fewer than asked for", place, desc.name, desc.layers, desc.mips));
        if (part.view != declared.view)
            wrong(fmt::format("{}: the shader declares another image dimension than the view asked for of '{}'", place, desc.name));
        const uint32_t layers = layers_of(part.view);
        if (layers && r.layers != layers)
            wrong(fmt::format("{}: the shader reads {} layers and '{}' gives {}; choose them with layers(first, count)", place, layers,
                desc.name, r.layers));
    }
    if (bound.constants.bytes.size() != program.constants_bytes)
        wrong(fmt::format("the constants have {} bytes and the shader's block has {} (0 also where the shader uses none of it)",
            bound.constants.bytes.size(), program.constants_bytes));
    for (const Constants::Patch& p : bound.constants.patches)
        if (p.source.index >= buffers.size() || uint64_t(p.source_offset) + p.bytes > buffers[p.source.index].desc.bytes
            || uint64_t(p.offset) + p.bytes > bound.constants.bytes.size() || (p.source_offset | p.offset | p.bytes) % 4 != 0)
            wrong("a patch of the constants lies outside of them, is no multiple of 4 or comes from no buffer of this list");
    if (program.textures && !bound.textures) wrong("the shader uses the texture table, and the pass gives none");
}

} // namespace gnomon::gpu
