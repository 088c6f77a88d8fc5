// SPDX-License-Identifier: Apache-2.0
#include "gpu/recorder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

/// Where a transient's memory stands: an older list's use of it has still to be waited for, its content is nothing.
ImageState emptied(const ImageState& before)
{
    ImageState state;
    state.layers = before.layers;
    state.mips = before.mips;
    for (const auto& part : before.parts) {
        state.parts[0].write_stages |= part.write_stages | part.read_stages;
        state.parts[0].write_access |= part.write_access;
    }
    return state;
}

const Constants* constants_of(const Pass& pass)
{
    if (const auto* compute = std::get_if<ComputePass>(&pass.work)) return &compute->constants;
    if (const auto* ray = std::get_if<RayPass>(&pass.work)) return &ray->constants;
    if (const auto* raster = std::get_if<RasterPass>(&pass.work)) return &raster->constants;
    return nullptr;
}

/// Shaders get whole buffers; on lavapipe they reach the first 128 MiB of one.
void check_range(const Context& c, const BufferDesc& desc)
{
    const uint64_t most = c.properties.limits.maxStorageBufferRange;
    if (desc.bytes > most)
        base::fail(
            "buffer '{}' has {:.1f} MiB, and shaders of device '{}' reach {:.1f} MiB of one (maxStorageBufferRange); choose a smaller "
            "scene or --size, or a technique that does not read it",
            desc.name, double(desc.bytes) / 1048576.0, c.info.name, double(most) / 1048576.0);
}

uint64_t aligned(uint64_t bytes, uint64_t alignment) { return (bytes + alignment - 1) / alignment * alignment; }

} // namespace

Recorder::Recorder(Context& c, ListData& list, Submission& submission, VkCommandBuffer commands)
    : c_(c)
    , list_(list)
    , submission_(submission)
    , commands_(commands)
{
    for (const auto& i : list.images) {
        image_slots_.push_back(submission.images.size());
        if (!i.imported) submission.images.push_back(c.transients.take(i.desc));
        image_states_.push_back(i.imported ? i.imported->state() : emptied(submission.images.back().state()));
    }
    for (const auto& b : list.buffers) {
        buffer_slots_.push_back(submission.buffers.size());
        if (!b.imported) submission.buffers.push_back(c.transients.take(b.desc));
        buffer_states_.push_back(b.imported ? b.imported->state() : submission.buffers.back().state());
        buffer_written_.push_back(b.imported != nullptr);
    }
    uint64_t bytes = 0;
    for (const auto& pass : list.passes)
        if (const Constants* k = constants_of(pass)) bytes += aligned(k->bytes.size(), c.properties.limits.minUniformBufferOffsetAlignment);
    if (bytes)
        submission.constants = c.transients.take({std::bit_ceil(std::max<uint64_t>(bytes, 4096)),
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Memory::upload, "constants"});
}

Image& Recorder::image(ImageId id) const
{
    const auto& listed = list_.images[id.index];
    return listed.imported ? *listed.imported : submission_.images[image_slots_[id.index]];
}

const Buffer& Recorder::buffer(BufferId id) const
{
    const auto& listed = list_.buffers[id.index];
    return listed.imported ? *listed.imported : submission_.buffers[buffer_slots_[id.index]];
}

void Recorder::commit()
{
    for (uint32_t i = 0; i < image_states_.size(); ++i) image({i}).state() = std::move(image_states_[i]);
    for (uint32_t i = 0; i < buffer_states_.size(); ++i) buffer({i}).state() = buffer_states_[i];
}

void Recorder::record(VkQueryPool timestamps)
{
    uint32_t stamp = 0;
    const auto write_stamp = [&] {
        if (timestamps) c_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps, stamp++);
    };
    write_stamp();
    for (const auto& pass : list_.passes) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = pass.name.c_str();
        if (c_.names) c_.vk.vkCmdBeginDebugUtilsLabelEXT(commands_, &label);
        std::visit([&](const auto& work) { run(pass, work); }, pass.work);
        if (c_.names) c_.vk.vkCmdEndDebugUtilsLabelEXT(commands_);
        write_stamp();
    }
}

void Recorder::use(ImageId id, const Range& range, Use how, PassKind kind, bool needs_content)
{
    const ImageDesc& desc = list_.images[id.index].desc;
    Access access = access_of(how, kind, is_depth(desc.format));
    access.needs_content |= needs_content;
    image_uses_.push_back({id.index, range, access, desc.name});
}

void Recorder::use(BufferId id, Use how, PassKind kind) { buffer_uses_.push_back({id.index, access_of(how, kind, false)}); }

bool Recorder::declared(BufferId id, Use how) const
{
    const Access access = access_of(how, PassKind::raster, false);
    return std::any_of(buffer_uses_.begin(), buffer_uses_.end(),
        [&](const BufferUse& u) { return u.buffer == id.index && (u.access.access & access.access) == access.access; });
}

void Recorder::begin_transfer()
{
    image_uses_.clear();
    buffer_uses_.clear();
    binding_use_.clear();
}

void Recorder::patch(const Constants& constants)
{
    if (constants.patches.empty()) return;
    begin_transfer();
    for (const Constants::Patch& p : constants.patches)
        if (!declared(p.source, Use::copy_from)) use(p.source, Use::copy_from, PassKind::transfer);
    end_uses("constants");
    for (const Constants::Patch& p : constants.patches) {
        const VkBufferCopy region{p.source_offset, constants_used_ + p.offset, p.bytes};
        c_.vk.vkCmdCopyBuffer(commands_, buffer(p.source).handle(), submission_.constants.handle(), 1, &region);
    }
    const VkBufferMemoryBarrier2 written{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_COPY_BIT,
        VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_UNIFORM_READ_BIT, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, submission_.constants.handle(), constants_used_, constants.bytes.size()};
    const VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO, nullptr, 0, 0, nullptr, 1, &written, 0, nullptr};
    c_.vk.vkCmdPipelineBarrier2(commands_, &dependency);
}

void Recorder::begin_pass(PassKind kind, const ProgramImpl& program, const std::vector<Binding>& bindings, const Constants& constants,
    const TextureTable* textures)
{
    patch(constants);
    begin_transfer();
    bindings_ = &bindings;
    textures_ = textures;
    constants_set_ = VK_NULL_HANDLE;
    for (uint32_t i = 0; i < bindings.size(); ++i) {
        const Binding& b = bindings[i];
        binding_use_.push_back(image_uses_.size());
        if (b.image) use(b.image, part_of(b, list_.images[b.image.index].desc, program.find(0, i)).range, b.use, kind, false);
        if (b.buffer) use(b.buffer, b.use, kind);
    }
    if (constants.bytes.empty()) return;
    std::memcpy(submission_.constants.mapped() + constants_used_, constants.bytes.data(), constants.bytes.size());
    constants_set_ = new_set(c_.constants_layout);
    const VkDescriptorBufferInfo info{submission_.constants.handle(), constants_used_, constants.bytes.size()};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, constants_set_, 0, 0, 1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
        nullptr, &info, nullptr};
    c_.vk.vkUpdateDescriptorSets(c_.handle, 1, &write, 0, nullptr);
    constants_used_ += aligned(constants.bytes.size(), c_.properties.limits.minUniformBufferOffsetAlignment);
}

void Recorder::note_written(const std::string& pass)
{
    for (const auto& u : buffer_uses_)
        if (u.access.needs_content && !buffer_written_[u.buffer])
            throw std::logic_error(fmt::format(
                "pass '{}' reads buffer '{}' before anything wrote it; write or fill it first", pass, list_.buffers[u.buffer].desc.name));
    for (const auto& u : buffer_uses_)
        if (u.access.writes) buffer_written_[u.buffer] = true;
}

void Recorder::end_uses(const std::string& pass)
{
    note_written(pass);
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;
    for (const auto& b : plan_images(pass, image_uses_, image_states_)) images.push_back(to_vulkan(b.barrier, b.range, image({b.image})));
    for (const auto& b : plan_buffers(buffer_uses_, buffer_states_)) buffers.push_back(to_vulkan(b.barrier, buffer({b.buffer})));
    const VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO, nullptr, 0, 0, nullptr, uint32_t(buffers.size()), buffers.data(),
        uint32_t(images.size()), images.data()};
    if (!images.empty() || !buffers.empty()) c_.vk.vkCmdPipelineBarrier2(commands_, &dependency);
}

VkDescriptorSet Recorder::new_set(VkDescriptorSetLayout layout)
{
    auto& pools = submission_.descriptor_pools;
    VkDescriptorSet set = VK_NULL_HANDLE;
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!pools.empty()) {
            const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pools.back(), 1, &layout};
            const VkResult result = c_.vk.vkAllocateDescriptorSets(c_.handle, &info, &set);
            if (result == VK_SUCCESS) return set;
            if (attempt > 0) check(result, "vkAllocateDescriptorSets");
        }
        if (c_.free_pools.empty()) c_.free_pools.push_back(c_.new_descriptor_pool());
        pools.push_back(c_.free_pools.back());
        c_.free_pools.pop_back();
    }
    base::fail("vkAllocateDescriptorSets: a pass has more bindings than a descriptor pool holds; split the pass");
}

void Recorder::write_set(const ProgramImpl& program, VkDescriptorSet set)
{
    std::vector<VkWriteDescriptorSet> writes;
    std::vector<VkDescriptorImageInfo> images(bindings_->size());
    std::vector<VkDescriptorBufferInfo> buffers(bindings_->size());
    std::vector<VkAccelerationStructureKHR> accels(bindings_->size());
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> accel_writes(bindings_->size());
    for (const auto& declared : program.bindings) {
        if (declared.set != 0) continue;
        const uint32_t i = declared.binding;
        const Binding& b = (*bindings_)[i];
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, set, i, 0, 1, declared.type};
        if (b.accel) {
            accels[i] = b.accel->handle();
            accel_writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR, nullptr, 1, &accels[i]};
            write.pNext = &accel_writes[i];
        } else if (b.image) {
            const Image& source = image(b.image);
            const ImagePart part = part_of(b, source.desc(), &declared);
            const Range& r = part.range;
            images[i] = {c_.sampler(b.sampler, source.desc().format),
                source.view(part.view, r.first_layer, r.layers, r.first_mip, r.mips, part.aspect),
                image_uses_[binding_use_[i]].access.layout};
            write.pImageInfo = &images[i];
        } else {
            const Buffer& source = buffer(b.buffer);
            if (declared.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) check_range(c_, source.desc());
            buffers[i] = {source.handle(), source.offset(), source.range()};
            write.pBufferInfo = &buffers[i];
        }
        writes.push_back(write);
    }
    if (!writes.empty()) c_.vk.vkUpdateDescriptorSets(c_.handle, uint32_t(writes.size()), writes.data(), 0, nullptr);
}

void Recorder::bind(const ProgramImpl& program, const std::string& pass)
{
    if (program.set0_count() > bindings_->size() || (program.constants_bytes && !constants_set_) || (program.textures && !textures_))
        throw std::logic_error(
            fmt::format("pass '{}': program '{}' needs more than the pass gives (bindings, constants or textures)", pass, program.name));
    const auto bind_set = [&](uint32_t index, VkDescriptorSet set) {
        c_.vk.vkCmdBindDescriptorSets(commands_, program.point, program.layout, index, 1, &set, 0, nullptr);
    };
    if (program.set0_count() > 0) {
        const VkDescriptorSet set = new_set(program.set0);
        write_set(program, set);
        bind_set(0, set);
    }
    if (program.constants_bytes) bind_set(1, constants_set_);
    if (program.textures) bind_set(2, textures_->set());
}

} // namespace gnomon::gpu
