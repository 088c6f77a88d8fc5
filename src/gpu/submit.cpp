// SPDX-License-Identifier: Apache-2.0
#include "gpu/recorder.h"

#include <optional>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

std::string names_of(const std::vector<Pass>& passes)
{
    std::string text = "the pass list";
    const char* separator = " ";
    for (const auto& pass : passes) {
        text += separator + pass.name;
        separator = ", ";
    }
    return text;
}

VkQueryPool timestamps_for(Context& c, uint32_t count)
{
    if (c.timestamp_count < count) {
        c.vk.vkDestroyQueryPool(c.handle, c.timestamps, nullptr);
        c.timestamps = VK_NULL_HANDLE;
        c.timestamp_count = 0;
        const VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, nullptr, 0, VK_QUERY_TYPE_TIMESTAMP, count * 2, 0};
        check(c.vk.vkCreateQueryPool(c.handle, &info, nullptr, &c.timestamps), "vkCreateQueryPool");
        c.timestamp_count = count * 2;
    }
    c.vk.vkResetQueryPool(c.handle, c.timestamps, 0, c.timestamp_count);
    return c.timestamps;
}

std::vector<PassTime> read_times(Context& c, const std::vector<Pass>& passes)
{
    std::vector<uint64_t> stamps(passes.size() + 1);
    check(c.vk.vkGetQueryPoolResults(c.handle, c.timestamps, 0, uint32_t(stamps.size()), stamps.size() * 8, stamps.data(), 8,
              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
    const uint64_t mask = c.timestamp_bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << c.timestamp_bits) - 1;
    std::vector<PassTime> times;
    for (size_t i = 0; i < passes.size(); ++i)
        times.push_back({passes[i].name, double((stamps[i + 1] - stamps[i]) & mask) * double(c.properties.limits.timestampPeriod) * 1e-6});
    return times;
}

/// Submission::images and buffers hold the list's transients in its order.
void count_bytes(const ListData& list, const Submission& s, Submitted& out)
{
    const auto add = [&](const std::string& group, uint64_t bytes) {
        out.transient_bytes += bytes;
        if (!group.empty()) out.group_bytes[group] += bytes;
    };
    size_t next = 0;
    for (const auto& listed : list.images)
        if (!listed.imported) add(listed.group, s.images[next++].bytes());
    next = 0;
    for (const auto& listed : list.buffers)
        if (!listed.imported) add(listed.group, s.buffers[next++].desc().bytes);
}

/// Gives the resources back however the recording ends.
struct Held {
    Context& context;
    Submission submission{};
    ~Held() { context.recycle(std::move(submission)); }
};

} // namespace

Submitted Device::submit(PassList&& list)
{
    Context& c = *impl_;
    PassList consumed(std::move(list));
    ListData& l = *consumed.impl_;
    Submitted result{};
    if (l.passes.empty()) return result;
    if (!c.queue) throw std::logic_error("submit: this device has no queue; record the list into a command buffer");
    c.transients.age();
    const VkQueryPool timestamps = timestamps_for(c, uint32_t(l.passes.size() + 1));
    Held held{c};
    std::optional<Recorder> recorder;
    c.run(names_of(l.passes), [&](VkCommandBuffer commands) {
        recorder.emplace(c, l, held.submission, commands);
        recorder->record(timestamps);
    });
    recorder->commit();
    result.times = read_times(c, l.passes);
    count_bytes(l, held.submission, result);
    return result;
}

uint64_t Device::record(PassList&& list, VkCommandBuffer commands, std::span<const ImageLayout> leave)
{
    Context& c = *impl_;
    PassList consumed(std::move(list));
    c.transients.age();
    Held held{c};
    // A list that fails half way must leave no trace in the caller's commands.
    const VkCommandBuffer own = c.begin_secondary("a pass list");
    held.submission.secondary.push_back(own);
    Recorder recorder(c, *consumed.impl_, held.submission, own);
    recorder.record(VK_NULL_HANDLE);
    recorder.commit();
    for (const auto& [image, layout] : leave) {
        const Access rest{
            VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, layout, true, true};
        c.barrier(own, *image, transition(image->state(), whole(image->state()), rest));
    }
    // Vertex and index buffers are not declared by the passes that draw from them, and the caller's own commands know nothing of these.
    const VkMemoryBarrier2 all{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &all;
    c.vk.vkCmdPipelineBarrier2(own, &dependency);
    check(c.vk.vkEndCommandBuffer(own), "vkEndCommandBuffer", "a pass list");
    c.execute(commands, held.submission);
    c.open.emplace(++c.last_ticket, std::move(held.submission));
    held.submission = {};
    return c.last_ticket;
}

void Device::retire(uint64_t ticket) { impl_->retire(ticket); }

} // namespace gnomon::gpu
