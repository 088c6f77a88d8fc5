// SPDX-License-Identifier: Apache-2.0
#include "gpu/programs.h"
#include "gpu/resources_impl.h"

#include <cstring>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

VkDeviceAddress aligned(VkDeviceAddress address, uint64_t alignment) { return (address + alignment - 1) / alignment * alignment; }

void require_ray_tracing(const DeviceInfo& info)
{
    if (!info.ray_query && !info.ray_tracing_pipeline)
        base::fail("device '{}' has no acceleration structures; choose another device or a technique without ray tracing", info.name);
}

} // namespace

AccelerationStructure::Impl::~Impl()
{
    if (handle) context->release([c = context, h = handle] { c->vk.vkDestroyAccelerationStructureKHR(c->handle, h, nullptr); });
}

AccelerationStructure::AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(AccelerationStructure&&) noexcept = default;
AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&&) noexcept = default;
AccelerationStructure::~AccelerationStructure() = default;
VkAccelerationStructureKHR AccelerationStructure::handle() const { return impl_->handle; }
VkDeviceAddress AccelerationStructure::address() const { return impl_->address; }
uint64_t AccelerationStructure::bytes() const { return impl_->memory.desc().bytes; }
AccelerationStructure::operator bool() const { return impl_ != nullptr; }

AccelerationStructure Device::build(
    VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry, uint32_t primitives, const std::string& name)
{
    Context& c = *impl_;
    VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    c.vk.vkGetAccelerationStructureBuildSizesKHR(c.handle, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &primitives, &sizes);

    AccelerationStructure structure;
    structure.impl_ = std::make_unique<AccelerationStructure::Impl>();
    AccelerationStructure::Impl& a = *structure.impl_;
    a.context = &c;
    a.memory = buffer({sizes.accelerationStructureSize, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR, Memory::device, name});
    VkAccelerationStructureCreateInfoKHR create{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
    create.buffer = a.memory.handle();
    create.size = sizes.accelerationStructureSize;
    create.type = type;
    check(c.vk.vkCreateAccelerationStructureKHR(c.handle, &create, nullptr, &a.handle), "vkCreateAccelerationStructureKHR", name);
    c.name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, uint64_t(a.handle), name);
    const VkAccelerationStructureDeviceAddressInfoKHR address{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR, nullptr, a.handle};
    a.address = c.vk.vkGetAccelerationStructureDeviceAddressKHR(c.handle, &address);

    const uint64_t alignment = std::max(c.accel.minAccelerationStructureScratchOffsetAlignment, 1u);
    const Buffer scratch = buffer({sizes.buildScratchSize + alignment, 0, Memory::device, "scratch of " + name});
    info.dstAccelerationStructure = a.handle;
    info.scratchData.deviceAddress = aligned(scratch.address(), alignment);
    const VkAccelerationStructureBuildRangeInfoKHR range{primitives, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    c.run("the build of '" + name + "'", [&](VkCommandBuffer commands) {
        // Inputs may come from earlier copies or passes, whichever they were.
        const VkMemoryBarrier2 before{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
            VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};
        const VkMemoryBarrier2 after{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
            VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &before;
        c.vk.vkCmdPipelineBarrier2(commands, &dependency);
        c.vk.vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &ranges);
        dependency.pMemoryBarriers = &after;
        c.vk.vkCmdPipelineBarrier2(commands, &dependency);
    });
    return structure;
}

AccelerationStructure Device::build_blas(const BlasDesc& desc)
{
    require_ray_tracing(impl_->info);
    if (desc.vertex_count == 0 || desc.triangle_count == 0)
        throw std::logic_error(fmt::format("build_blas: '{}' has no triangles", desc.name));
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = desc.opaque ? VkGeometryFlagsKHR(VK_GEOMETRY_OPAQUE_BIT_KHR) : 0;
    auto& triangles = geometry.geometry.triangles;
    triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = desc.positions;
    triangles.vertexStride = desc.vertex_stride;
    triangles.maxVertex = desc.vertex_count - 1;
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = desc.indices;
    return build(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometry, desc.triangle_count, desc.name);
}

AccelerationStructure Device::build_tlas(std::span<const TlasInstance> instances)
{
    require_ray_tracing(impl_->info);
    constexpr uint64_t stride = sizeof(VkAccelerationStructureInstanceKHR), alignment = 16;
    const Buffer list = buffer({(instances.size() + 1) * stride + alignment, 0, Memory::upload, "instances"});
    const VkDeviceAddress address = aligned(list.address(), alignment);
    std::byte* out = list.mapped() + (address - list.address());
    for (const auto& i : instances) {
        VkAccelerationStructureInstanceKHR v{};
        std::memcpy(&v.transform, i.transform, sizeof(i.transform));
        v.instanceCustomIndex = i.custom_index & 0xffffff;
        v.mask = i.mask;
        v.instanceShaderBindingTableRecordOffset = i.hit_group & 0xffffff;
        v.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
        v.accelerationStructureReference = i.blas->address();
        std::memcpy(out, &v, stride);
        out += stride;
    }
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    geometry.geometry.instances.data.deviceAddress = address;
    return build(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, geometry, uint32_t(instances.size()), "top level");
}

VkPipeline ProgramImpl::ray_pipeline() const
{
    VkPipeline& pipeline = pipelines_[{}];
    if (pipeline) return pipeline;
    VkSpecializationInfo spec;
    std::vector<VkSpecializationMapEntry> entries;
    const auto infos = stage_infos(spec, entries);
    VkRayTracingPipelineCreateInfoKHR info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
    info.stageCount = uint32_t(infos.size());
    info.pStages = infos.data();
    info.groupCount = uint32_t(groups.size());
    info.pGroups = groups.data();
    info.maxPipelineRayRecursionDepth = std::min(2u, context.ray.maxRayRecursionDepth); // a hit shader may trace a shadow ray
    info.layout = layout;
    check(
        context.vk.vkCreateRayTracingPipelinesKHR(context.handle, VK_NULL_HANDLE, context.programs->cache(), 1, &info, nullptr, &pipeline),
        "vkCreateRayTracingPipelinesKHR", name);
    context.programs->made_pipeline();
    context.name(VK_OBJECT_TYPE_PIPELINE, uint64_t(pipeline), name);
    make_table(pipeline);
    return pipeline;
}

// The shader binding table: one raygen record, then the misses, then the hit groups, each region at the base alignment.
void ProgramImpl::make_table(VkPipeline pipeline) const
{
    const auto& ray = context.ray;
    const uint64_t handle = ray.shaderGroupHandleSize, base = ray.shaderGroupBaseAlignment;
    const uint64_t stride = aligned(handle, ray.shaderGroupHandleAlignment);
    std::vector<std::byte> handles(handle * groups.size());
    check(context.vk.vkGetRayTracingShaderGroupHandlesKHR(
              context.handle, pipeline, 0, uint32_t(groups.size()), handles.size(), handles.data()),
        "vkGetRayTracingShaderGroupHandlesKHR", name);
    const uint64_t raygen_bytes = aligned(stride, base), miss_bytes = aligned(stride * miss_count, base),
                   hit_bytes = aligned(stride * hit_count, base);
    table = context.device.buffer(
        {raygen_bytes + miss_bytes + hit_bytes + base, VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR, Memory::upload, "table of " + name});
    const VkDeviceAddress start = aligned(table.address(), base);
    raygen_region = {start, stride, stride};
    miss_region = {miss_count ? start + raygen_bytes : 0, stride, stride * miss_count};
    hit_region = {hit_count ? start + raygen_bytes + miss_bytes : 0, stride, stride * hit_count};
    const auto put = [&](VkDeviceAddress address, uint32_t first, uint32_t count) {
        for (uint32_t i = 0; i < count; ++i)
            std::memcpy(table.mapped() + (address - table.address()) + i * stride, &handles[(first + i) * handle], handle);
    };
    put(start, 0, 1);
    put(miss_region.deviceAddress, 1, miss_count);
    put(hit_region.deviceAddress, 1 + miss_count, hit_count);
}

} // namespace gnomon::gpu
