// SPDX-License-Identifier: Apache-2.0
#include "gpu/programs.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace gnomon::gpu {

bool VertexStream::operator==(const VertexStream& o) const
{
    const auto same = [](const VkVertexInputAttributeDescription& a, const VkVertexInputAttributeDescription& b) {
        return a.location == b.location && a.format == b.format && a.offset == b.offset;
    };
    return stride == o.stride && std::equal(attributes.begin(), attributes.end(), o.attributes.begin(), o.attributes.end(), same);
}

namespace {

/// The state as words: the key of the pipeline.
std::vector<uint32_t> words_of(const RasterState& s)
{
    std::vector<uint32_t> words;
    const auto add = [&](const auto&... values) { (words.push_back(uint32_t(values)), ...); };
    const auto add_struct = [&](const auto& value) {
        static_assert(sizeof(value) % 4 == 0);
        const size_t at = words.size();
        words.resize(at + sizeof(value) / 4);
        std::memcpy(&words[at], &value, sizeof(value));
    };
    add(s.colors.size());
    for (size_t i = 0; i < s.colors.size(); ++i) {
        add(s.colors[i], s.blends[i].has_value());
        if (s.blends[i]) add_struct(*s.blends[i]);
    }
    add(s.depth_format, s.depth_write, s.depth_clamp, s.depth_bias, s.stencil, s.compare, s.samples, s.view_mask, s.topology);
    add_struct(s.front);
    add_struct(s.back);
    for (const auto& stream : s.streams) {
        add(stream.stride, stream.attributes.size());
        for (const auto& a : stream.attributes) add(a.location, a.format, a.offset);
    }
    return words;
}

} // namespace

ProgramImpl::~ProgramImpl()
{
    const auto& vk = context.vk;
    for (const auto& [key, pipeline] : pipelines_) vk.vkDestroyPipeline(context.handle, pipeline, nullptr);
    for (const auto& stage : stages) vk.vkDestroyShaderModule(context.handle, stage.module, nullptr);
    vk.vkDestroyPipelineLayout(context.handle, layout, nullptr);
    vk.vkDestroyDescriptorSetLayout(context.handle, set0, nullptr);
}

const ReflectedBinding* ProgramImpl::find(uint32_t set, uint32_t binding) const
{
    for (const auto& b : bindings)
        if (b.set == set && b.binding == binding) return &b;
    return nullptr;
}

uint32_t ProgramImpl::set0_count() const
{
    uint32_t count = 0;
    for (const auto& b : bindings)
        if (b.set == 0) count = std::max(count, b.binding + 1);
    return count;
}

std::vector<VkPipelineShaderStageCreateInfo> ProgramImpl::stage_infos(
    VkSpecializationInfo& spec, std::vector<VkSpecializationMapEntry>& entries) const
{
    entries.clear();
    for (uint32_t i = 0; i < constants.size(); ++i)
        entries.push_back({constants[i].id, uint32_t(i * sizeof(SpecConstant) + offsetof(SpecConstant, value)), 4});
    spec = {uint32_t(entries.size()), entries.data(), constants.size() * sizeof(SpecConstant), constants.data()};
    std::vector<VkPipelineShaderStageCreateInfo> infos;
    for (const auto& s : stages)
        infos.push_back({VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, s.stage, s.module, "main", &spec});
    return infos;
}

VkPipeline ProgramImpl::compute_pipeline() const
{
    VkPipeline& pipeline = pipelines_[{}];
    if (pipeline) return pipeline;
    VkSpecializationInfo spec;
    std::vector<VkSpecializationMapEntry> entries;
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage_infos(spec, entries)[0];
    info.layout = layout;
    check(context.vk.vkCreateComputePipelines(context.handle, context.programs->cache(), 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines", name);
    context.programs->made_pipeline();
    context.name(VK_OBJECT_TYPE_PIPELINE, uint64_t(pipeline), name);
    return pipeline;
}

VkPipeline ProgramImpl::raster_pipeline(const RasterState& s) const
{
    VkPipeline& pipeline = pipelines_[words_of(s)];
    if (pipeline) return pipeline;
    VkSpecializationInfo spec;
    std::vector<VkSpecializationMapEntry> entries;
    const auto infos = stage_infos(spec, entries);

    std::vector<VkVertexInputBindingDescription> streams;
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const auto& stream : s.streams) {
        for (auto a : stream.attributes) {
            a.binding = uint32_t(streams.size());
            attributes.push_back(a);
        }
        streams.push_back({uint32_t(streams.size()), stream.stride, VK_VERTEX_INPUT_RATE_VERTEX});
    }
    const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO, nullptr, 0,
        uint32_t(streams.size()), streams.data(), uint32_t(attributes.size()), attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, nullptr, 0, s.topology, VK_FALSE};
    const VkPipelineViewportStateCreateInfo viewport{
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, nullptr, 0, 1, nullptr, 1, nullptr};
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.depthClampEnable = s.depth_clamp;
    raster.depthBiasEnable = s.depth_bias;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = s.samples;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = s.depth_format != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = s.depth_write;
    depth.depthCompareOp = s.compare;
    depth.stencilTestEnable = s.stencil;
    depth.front = s.front;
    depth.back = s.back;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (const auto& b : s.blends) {
        VkPipelineColorBlendAttachmentState plain{};
        plain.colorWriteMask = 0xf;
        blends.push_back(b.value_or(plain));
    }
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = uint32_t(blends.size());
    blend.pAttachments = blends.data();
    const VkDynamicState dynamic[]
        = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_DEPTH_BIAS};
    const VkPipelineDynamicStateCreateInfo dynamics{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, nullptr, 0, 4, dynamic};
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO, nullptr, s.view_mask,
        uint32_t(s.colors.size()), s.colors.data(), s.depth_format, has_stencil(s.depth_format) ? s.depth_format : VK_FORMAT_UNDEFINED};

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = uint32_t(infos.size());
    info.pStages = infos.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamics;
    info.layout = layout;
    check(context.vk.vkCreateGraphicsPipelines(context.handle, context.programs->cache(), 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines", name);
    context.programs->made_pipeline();
    context.name(VK_OBJECT_TYPE_PIPELINE, uint64_t(pipeline), name);
    return pipeline;
}

} // namespace gnomon::gpu
