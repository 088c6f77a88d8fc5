// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/context.h"
#include "gpu/pass_list.h"

#include <filesystem>
#include <map>

namespace gnomon::gpu {

struct ShaderStage {
    VkShaderStageFlagBits stage;
    VkShaderModule module;
    std::string shader; ///< its name among the embedded ones
};

/// Everything of a raster pass that a pipeline has fixed.
struct RasterState {
    std::vector<VkFormat> colors; ///< UNDEFINED: left out
    std::vector<std::optional<VkPipelineColorBlendAttachmentState>> blends;
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    bool depth_write = false, depth_clamp = false, depth_bias = false, stencil = false;
    VkCompareOp compare = VK_COMPARE_OP_ALWAYS;
    VkStencilOpState front{}, back{};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    uint32_t view_mask = 0;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::vector<VertexStream> streams;
};

class ProgramImpl : public Program {
public:
    explicit ProgramImpl(Context& c)
        : context(c)
    {
    }
    ~ProgramImpl() override;
    const ReflectedBinding* find(uint32_t set, uint32_t binding) const;
    uint32_t set0_count() const; ///< one past the highest binding of set 0
    VkPipeline compute_pipeline() const;
    VkPipeline raster_pipeline(const RasterState&) const;
    VkPipeline ray_pipeline() const;

    Context& context;
    VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_COMPUTE;
    std::vector<ShaderStage> stages;
    std::vector<SpecConstant> constants;
    VkDescriptorSetLayout set0 = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    bool textures = false;

    // Ray programs: groups by index into `stages`, and the table of their handles.
    std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups;
    uint32_t miss_count = 0, hit_count = 0;
    mutable Buffer table;
    mutable VkStridedDeviceAddressRegionKHR raygen_region{}, miss_region{}, hit_region{};

private:
    std::vector<VkPipelineShaderStageCreateInfo> stage_infos(VkSpecializationInfo&, std::vector<VkSpecializationMapEntry>&) const;
    void make_table(VkPipeline) const;
    mutable std::map<std::vector<uint32_t>, VkPipeline> pipelines_; ///< by the words of the state
};

/// All programs of a device, and the pipeline cache on disk.
class Programs {
public:
    explicit Programs(Context&);
    ~Programs();
    Programs(const Programs&) = delete;
    Programs& operator=(const Programs&) = delete;

    const Program& compute(std::string_view shader, std::span<const SpecConstant>);
    const Program& raster(std::string_view vertex, std::string_view fragment, std::span<const SpecConstant>);
    const Program& ray(
        std::string_view raygen, std::span<const std::string_view> miss, std::span<const HitShaders>, std::span<const SpecConstant>);
    void replace(std::string_view shader, std::vector<uint32_t> spirv);
    VkPipelineCache cache() const { return cache_; }
    void made_pipeline() { changed_ = true; }

private:
    ProgramImpl* known(const std::string& key);
    ProgramImpl& start(const std::string& key, std::span<const SpecConstant>, VkPipelineBindPoint);
    uint32_t add_stage(ProgramImpl&, std::string_view shader, VkShaderStageFlags allowed);
    void finish(ProgramImpl&);
    void load_cache();
    void save_cache() const;
    std::filesystem::path cache_file() const;

    Context& context_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    bool changed_ = false;
    std::map<std::string, std::unique_ptr<ProgramImpl>> programs_;
    std::map<std::string, std::vector<uint32_t>, std::less<>> replaced_; ///< by the shader's name
    std::vector<std::unique_ptr<ProgramImpl>> retired_; ///< of shaders that were replaced: their users keep references
};

} // namespace gnomon::gpu
