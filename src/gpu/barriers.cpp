// SPDX-License-Identifier: Apache-2.0
#include "gpu/barriers.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace gnomon::gpu {

namespace {

constexpr VkAccessFlags2 write_bits = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT
    | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
constexpr VkPipelineStageFlags2 depth_stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

VkPipelineStageFlags2 shader_stages(PassKind kind)
{
    switch (kind) {
    case PassKind::compute:
        return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    case PassKind::raster:
        return VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    case PassKind::trace:
        return VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR;
    case PassKind::transfer:
        break;
    }
    return VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
}

void join(Access& a, const Access& b, std::string_view pass, std::string_view name)
{
    if (a.layout != b.layout) {
        if (a.writes || b.writes)
            throw std::logic_error(
                fmt::format("pass '{}' writes image '{}' and uses the same layer and mip in another way; read it through "
                            "the same binding (Use::update), or write another image",
                    pass, name));
        a.layout = VK_IMAGE_LAYOUT_GENERAL;
    }
    a.stages |= b.stages;
    a.access |= b.access;
    a.writes |= b.writes;
    a.needs_content |= b.needs_content;
}

void split(ImageState& state)
{
    if (state.parts.size() == 1) state.parts.resize(size_t(state.layers) * state.mips, SubresourceState(state.parts[0]));
}

void unite(ImageState& state)
{
    if (std::all_of(state.parts.begin(), state.parts.end(), [&](const auto& p) { return p == state.parts[0]; })) state.parts.resize(1);
}

/// Equal neighbours become one barrier: along the layers first, then along the mips. Comes in as single parts, mip by mip.
std::vector<ImageBarrier> merged(const std::vector<ImageBarrier>& single)
{
    std::vector<ImageBarrier> rows, out;
    for (const auto& b : single) {
        if (!rows.empty()) {
            auto& last = rows.back();
            if (last.image == b.image && last.barrier == b.barrier && last.range.first_mip == b.range.first_mip
                && last.range.first_layer + last.range.layers == b.range.first_layer) {
                ++last.range.layers;
                continue;
            }
        }
        rows.push_back(b);
    }
    for (const auto& row : rows) {
        const auto above = std::find_if(out.begin(), out.end(), [&](const ImageBarrier& o) {
            return o.image == row.image && o.barrier == row.barrier && o.range.first_layer == row.range.first_layer
                && o.range.layers == row.range.layers && o.range.first_mip + o.range.mips == row.range.first_mip;
        });
        if (above != out.end())
            ++above->range.mips;
        else
            out.push_back(row);
    }
    return out;
}

bool covers(const Range& r, uint32_t layer, uint32_t mip)
{
    return layer >= r.first_layer && layer < r.first_layer + r.layers && mip >= r.first_mip && mip < r.first_mip + r.mips;
}

void require_content(const SubresourceState& state, const Access& access, std::string_view pass, std::string_view name)
{
    if (access.needs_content && state.layout == VK_IMAGE_LAYOUT_UNDEFINED)
        throw std::logic_error(
            fmt::format("pass '{}' reads image '{}' before anything wrote it; write, clear or upload it first", pass, name));
}

/// The uses of one image in one pass, all of one range.
void plan_joined(std::string_view pass, std::span<ImageUse> uses, ImageState& state, std::vector<ImageBarrier>& out)
{
    Access access = uses[0].access;
    for (const auto& use : uses.subspan(1)) join(access, use.access, pass, use.name);
    for (auto& use : uses) use.access.layout = access.layout;
    const Range r = uses[0].range;
    for (uint32_t l = r.first_layer; l < r.first_layer + r.layers; ++l)
        for (uint32_t m = r.first_mip; m < r.first_mip + r.mips; ++m) {
            require_content(state.part(l, m), access, pass, uses[0].name);
            if (state.parts.size() == 1) l = r.first_layer + r.layers - 1, m = r.first_mip + r.mips - 1;
        }
    for (auto barrier : transition(state, r, access)) {
        barrier.image = uses[0].image;
        out.push_back(barrier);
    }
}

/// The uses of one image in one pass, of different ranges: part by part.
void plan_parts(std::string_view pass, std::span<ImageUse> uses, ImageState& state, std::vector<ImageBarrier>& out)
{
    split(state);
    std::vector<ImageBarrier> single;
    std::vector<bool> seen(uses.size(), false);
    for (uint32_t m = 0; m < state.mips; ++m)
        for (uint32_t l = 0; l < state.layers; ++l) {
            std::vector<size_t> here;
            for (size_t i = 0; i < uses.size(); ++i)
                if (covers(uses[i].range, l, m)) here.push_back(i);
            if (here.empty()) continue;
            Access access = uses[here[0]].access;
            for (const size_t i : here) join(access, uses[i].access, pass, uses[i].name);
            require_content(state.part(l, m), access, pass, uses[0].name);
            for (const size_t i : here) {
                if (seen[i] && uses[i].access.layout != access.layout)
                    throw std::logic_error(
                        fmt::format("pass '{}' binds overlapping ranges of image '{}' in different ways; bind them apart "
                                    "or in one range",
                            pass, uses[i].name));
                uses[i].access.layout = access.layout;
                seen[i] = true;
            }
            const Barrier b = transition(state.part(l, m), access);
            if (b.needed) single.push_back({uses[0].image, {l, 1, m, 1}, b});
        }
    unite(state);
    for (const auto& b : merged(single)) out.push_back(b);
}

} // namespace

Access access_of(Use use, PassKind kind, bool depth_format)
{
    const VkPipelineStageFlags2 shader = shader_stages(kind);
    const VkImageLayout read = depth_format ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout general = VK_IMAGE_LAYOUT_GENERAL;
    constexpr VkAccessFlags2 load = VK_ACCESS_2_SHADER_STORAGE_READ_BIT, store = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    constexpr VkAccessFlags2 depth_read = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                             depth_write = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    constexpr VkPipelineStageFlags2 color = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                    transfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkImageLayout none = VK_IMAGE_LAYOUT_UNDEFINED;
    switch (use) {
    case Use::sample:
        return {shader, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, read, false, true};
    case Use::load:
        return {shader, load, general, false, true};
    case Use::store:
        return {shader, store, general, true, false};
    case Use::update:
        return {shader, load | store, general, true, true};
    case Use::uniform:
        return {shader, VK_ACCESS_2_UNIFORM_READ_BIT, none, false, true};
    case Use::copy_from:
        return {transfer, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false, true};
    case Use::copy_to:
        return {transfer, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true, false};
    case Use::color:
        return {color, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true, false};
    case Use::depth:
        return {depth_stages, depth_read | depth_write, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true, false};
    case Use::depth_test:
        return {depth_stages, depth_read, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, false, true};
    case Use::vertex:
        return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, none, false, true};
    case Use::index:
        return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, none, false, true};
    case Use::indirect:
        return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, none, false, true};
    case Use::trace:
        return {VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, VK_ACCESS_2_SHADER_READ_BIT, none, false, true};
    }
    return {};
}

// A read's barrier covers all readers so far as well: then "these stages with these accesses see the write" is a full cross product and
// two masks are enough to know it.
static Barrier read_after(BufferState& s, const Access& a)
{
    const bool seen = (a.stages & ~s.read_stages) == 0 && (a.access & ~s.read_access) == 0;
    s.read_stages |= a.stages;
    s.read_access |= a.access;
    if (seen || s.write_stages == 0) return {};
    return {true, s.write_stages, s.read_stages, s.write_access, s.read_access};
}

Barrier transition(BufferState& s, const Access& a)
{
    if (!a.writes) return read_after(s, a);
    const Barrier b{(s.write_stages | s.read_stages) != 0, s.write_stages | s.read_stages, a.stages, s.write_access, a.access};
    s = {a.stages, 0, a.access & write_bits, 0};
    return b;
}

Barrier transition(SubresourceState& s, const Access& a)
{
    const bool change = s.layout != a.layout;
    Barrier b;
    if (!change) {
        b = transition(static_cast<BufferState&>(s), a);
    } else {
        b = {true, s.write_stages | s.read_stages, a.stages, s.write_access, a.access};
        // The transition itself is the last write; later readers chain behind the stages that waited for it.
        static_cast<BufferState&>(s) = {a.stages, a.writes ? 0 : a.stages, a.access & write_bits, a.writes ? 0 : a.access};
    }
    b.old_layout = s.layout;
    b.new_layout = s.layout = a.layout;
    return b;
}

Range whole(const ImageState& state) { return {0, state.layers, 0, state.mips}; }

std::vector<ImageBarrier> transition(ImageState& state, const Range& range, const Access& access)
{
    if (state.parts.size() == 1 && range == whole(state)) {
        const Barrier b = transition(state.parts[0], access);
        if (!b.needed) return {};
        return {{0, range, b}};
    }
    split(state);
    std::vector<ImageBarrier> single;
    for (uint32_t m = range.first_mip; m < range.first_mip + range.mips; ++m)
        for (uint32_t l = range.first_layer; l < range.first_layer + range.layers; ++l) {
            const Barrier b = transition(state.part(l, m), access);
            if (b.needed) single.push_back({0, {l, 1, m, 1}, b});
        }
    unite(state);
    return merged(single);
}

std::vector<ImageBarrier> plan_images(std::string_view pass, std::span<ImageUse> uses, std::span<ImageState> states)
{
    std::vector<ImageBarrier> out;
    std::vector<bool> done(uses.size(), false);
    for (size_t i = 0; i < uses.size(); ++i) {
        if (done[i]) continue;
        std::vector<ImageUse> group;
        std::vector<size_t> places;
        bool same = true;
        for (size_t k = i; k < uses.size(); ++k)
            if (uses[k].image == uses[i].image) {
                group.push_back(uses[k]);
                places.push_back(k);
                same &= uses[k].range == uses[i].range;
                done[k] = true;
            }
        (same ? plan_joined : plan_parts)(pass, group, states[uses[i].image], out);
        for (size_t k = 0; k < group.size(); ++k) uses[places[k]] = group[k];
    }
    return out;
}

std::vector<BufferBarrier> plan_buffers(std::span<const BufferUse> uses, std::span<BufferState> states)
{
    std::vector<BufferUse> joined;
    for (const auto& use : uses) {
        const auto same = std::find_if(joined.begin(), joined.end(), [&](const auto& j) { return j.buffer == use.buffer; });
        if (same == joined.end())
            joined.push_back(use);
        else
            join(same->access, use.access, {}, {});
    }
    std::vector<BufferBarrier> out;
    for (const auto& use : joined) {
        const Barrier b = transition(states[use.buffer], use.access);
        if (b.needed) out.push_back({use.buffer, b});
    }
    return out;
}

} // namespace gnomon::gpu
