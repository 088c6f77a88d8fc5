// SPDX-License-Identifier: Apache-2.0
#include "shadow/technique.h"

#include "base/error.h"
#include "base/names.h"

namespace gnomon::shadow {

std::string_view output_name(Output output)
{
    constexpr std::string_view names[] = {"visibility", "transmittance", "ambient", "inscatter", "radiance"};
    return names[size_t(output)];
}

Output output(const TechniqueInfo& info, std::span<const std::byte> params)
{
    return info.output_of ? info.output_of(params) : info.output;
}

VkFormat output_format(const TechniqueInfo& info, std::span<const std::byte> params, const scene::Light& light)
{
    const bool grey = output(info, params) == Output::visibility && !(info.textured && light.textured());
    return grey ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
}

const TechniqueInfo& technique(std::string_view id)
{
    std::vector<std::string> ids;
    for (const TechniqueInfo* info : techniques()) {
        if (info->id == id) return *info;
        ids.emplace_back(info->id);
    }
    throw base::Error(base::unknown_name("technique", id, ids) + " (`gnomon list` shows all)");
}

std::string refusal(const TechniqueInfo& info, const gpu::Device& device, const scene::Light& light)
{
    if (info.unavailable) {
        const std::string reason = info.unavailable(device);
        if (!reason.empty()) return reason;
    }
    if (info.lights & light_bit(light.kind())) return {};
    std::string claimed;
    for (int k = 0; k < scene::light_kind_count; ++k)
        if (info.lights & (1u << k)) claimed += (claimed.empty() ? "" : ", ") + std::string(scene::kind_name(scene::LightKind(k)));
    return fmt::format("{} does not work with {} lights; it takes {}", info.id, scene::kind_name(light.kind()), claimed);
}

} // namespace gnomon::shadow
