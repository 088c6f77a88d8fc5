// SPDX-License-Identifier: Apache-2.0
#include "lab/export_names.h"

#include <span>

namespace gnomon::lab {

namespace {

template <class Enum> std::string_view from(std::span<const std::string_view> names, Enum value)
{
    return size_t(value) < names.size() ? names[size_t(value)] : "?";
}

} // namespace

std::string_view name_of(gpu::Use use)
{
    constexpr std::string_view names[] = {"sample", "load", "store", "update", "uniform", "copy_from", "copy_to", "color", "depth",
        "depth_test", "vertex", "index", "indirect", "trace"};
    return from(names, use);
}

std::string_view name_of(gpu::Sampler sampler)
{
    constexpr std::string_view names[] = {"nearest_clamp", "linear_clamp", "nearest_repeat", "linear_repeat", "nearest_mirror",
        "linear_mirror", "compare_nearest", "compare_linear"};
    return from(names, sampler);
}

std::string_view name_of(gpu::Load load)
{
    constexpr std::string_view names[] = {"clear", "keep", "discard"};
    return from(names, load);
}

std::string_view name_of(VkCompareOp op)
{
    constexpr std::string_view names[] = {"NEVER", "LESS", "EQUAL", "LESS_OR_EQUAL", "GREATER", "NOT_EQUAL", "GREATER_OR_EQUAL", "ALWAYS"};
    return from(names, op);
}

std::string_view name_of(VkStencilOp op)
{
    constexpr std::string_view names[]
        = {"KEEP", "ZERO", "REPLACE", "INCREMENT_AND_CLAMP", "DECREMENT_AND_CLAMP", "INVERT", "INCREMENT_AND_WRAP", "DECREMENT_AND_WRAP"};
    return from(names, op);
}

std::string_view name_of(VkBlendFactor factor)
{
    constexpr std::string_view names[] = {"ZERO", "ONE", "SRC_COLOR", "ONE_MINUS_SRC_COLOR", "DST_COLOR", "ONE_MINUS_DST_COLOR",
        "SRC_ALPHA", "ONE_MINUS_SRC_ALPHA", "DST_ALPHA", "ONE_MINUS_DST_ALPHA"};
    return from(names, factor);
}

std::string_view name_of(VkBlendOp op)
{
    constexpr std::string_view names[] = {"ADD", "SUBTRACT", "REVERSE_SUBTRACT", "MIN", "MAX"};
    return from(names, op);
}

std::string_view name_of(VkPrimitiveTopology topology)
{
    constexpr std::string_view names[] = {"POINT_LIST", "LINE_LIST", "LINE_STRIP", "TRIANGLE_LIST", "TRIANGLE_STRIP", "TRIANGLE_FAN"};
    return from(names, topology);
}

std::string_view name_of(VkImageViewType view)
{
    constexpr std::string_view names[] = {"1D", "2D", "3D", "CUBE", "1D_ARRAY", "2D_ARRAY", "CUBE_ARRAY"};
    return from(names, view);
}

std::string cull_name(VkCullModeFlags mode)
{
    constexpr std::string_view names[] = {"none", "front", "back", "front and back"};
    return std::string(names[mode & 3]);
}

} // namespace gnomon::lab
