// SPDX-License-Identifier: Apache-2.0
#include "pipelines.h"

#include <array>
#include <span>

namespace host {

namespace {

constexpr uint32_t scene_vert[] = {
#include "scene.vert.inc"
};
constexpr uint32_t normals_frag[] = {
#include "normals.frag.inc"
};
constexpr uint32_t lit_frag[] = {
#include "lit.frag.inc"
};

VkShaderModule make_module(VkDevice device, std::span<const uint32_t> words)
{
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
    return module;
}

struct PassInfo {
    std::span<const uint32_t> fragment; ///< empty: depth alone
    int encoding = 0; ///< the fragment shader's specialisation constant 0
    VkFormat color = VK_FORMAT_UNDEFINED;
    VkCompareOp compare;
    bool write_depth;
};

VkPipeline make_pipeline(const Gpu& gpu, const Scene& scene, const Convention& convention, VkPipelineLayout layout, const PassInfo& pass)
{
    const VkSpecializationMapEntry entry{0, 0, sizeof(int)};
    const VkSpecializationInfo constants{1, &entry, sizeof(int), &pass.encoding};
    std::vector<VkPipelineShaderStageCreateInfo> stages{{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0,
        VK_SHADER_STAGE_VERTEX_BIT, make_module(gpu.device, scene_vert), "main", nullptr}};
    if (!pass.fragment.empty())
        stages.push_back({VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_FRAGMENT_BIT,
            make_module(gpu.device, pass.fragment), "main", &constants});

    const VkVertexInputBindingDescription binding{0, scene.stride, VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array<VkVertexInputAttributeDescription, 3> attributes{
        {{0, 0, scene.position_format, 0}, {1, 0, scene.normal_format, scene.normal_offset}, {2, 0, scene.uv_format, scene.uv_offset}}};
    VkPipelineVertexInputStateCreateInfo vertex_input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    vertex_input.vertexBindingDescriptionCount = 1;
    vertex_input.pVertexBindingDescriptions = &binding;
    vertex_input.vertexAttributeDescriptionCount = uint32_t(attributes.size());
    vertex_input.pVertexAttributeDescriptions = attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.cullMode = VK_CULL_MODE_BACK_BIT;
    raster.frontFace = convention.clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = convention.samples;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = pass.write_depth;
    depth.depthCompareOp = pass.compare;
    VkPipelineColorBlendAttachmentState blend{};
    blend.colorWriteMask = 0xf;
    VkPipelineColorBlendStateCreateInfo blends{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blends.attachmentCount = pass.color != VK_FORMAT_UNDEFINED;
    blends.pAttachments = &blend;
    const std::array<VkDynamicState, 2> states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = uint32_t(states.size());
    dynamic.pDynamicStates = states.data();
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = blends.attachmentCount;
    rendering.pColorAttachmentFormats = &pass.color;
    rendering.depthAttachmentFormat = convention.depth_format;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = uint32_t(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blends;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(gpu.device, gpu.pipeline_cache, 1, &info, nullptr, &pipeline), "vkCreateGraphicsPipelines");
    for (const VkPipelineShaderStageCreateInfo& stage : stages) vkDestroyShaderModule(gpu.device, stage.module, nullptr);
    return pipeline;
}

} // namespace

VkFormat normals_format(Normals normals)
{
    switch (normals) {
    case Normals::floats:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Normals::bytes:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case Normals::octahedral:
        return VK_FORMAT_R16G16_SFLOAT;
    case Normals::none:
        break;
    }
    return VK_FORMAT_UNDEFINED;
}

Pipelines::Pipelines(const Gpu& gpu, const Scene& scene, const Convention& convention)
{
    VkSamplerCreateInfo nearest{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    check(vkCreateSampler(gpu.device, &nearest, nullptr, &sampler), "vkCreateSampler");
    const std::array<VkDescriptorSetLayoutBinding, 2> bindings{
        {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT, nullptr},
            {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = uint32_t(bindings.size());
    set.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(gpu.device, &set, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(PushConstants)};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(gpu.device, &info, nullptr, &layout), "vkCreatePipelineLayout");

    const VkFormat normals = normals_format(convention.normals);
    const int encoding = convention.normals == Normals::bytes ? 1 : convention.normals == Normals::octahedral ? 2 : 0;
    const VkCompareOp nearer = convention.reversed_depth ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    depth = make_pipeline(gpu, scene, convention, layout,
        {normals ? std::span<const uint32_t>(normals_frag) : std::span<const uint32_t>(), encoding, normals, nearer, true});
    lit = make_pipeline(gpu, scene, convention, layout, {lit_frag, 0, color_format, VK_COMPARE_OP_EQUAL, false});
}

void Pipelines::destroyers(const Gpu& gpu, std::vector<std::function<void()>>& out)
{
    const VkDevice device = gpu.device;
    out.push_back([device, this] { vkDestroyPipeline(device, depth, nullptr); });
    out.push_back([device, this] { vkDestroyPipeline(device, lit, nullptr); });
    out.push_back([device, this] { vkDestroyPipelineLayout(device, layout, nullptr); });
    out.push_back([device, this] { vkDestroyDescriptorSetLayout(device, set_layout, nullptr); });
    out.push_back([device, this] { vkDestroySampler(device, sampler, nullptr); });
}

} // namespace host
