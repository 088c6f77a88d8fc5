// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"

#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::gpu {

using Vec4 = std::array<float, 4>;

/// Runs a compute shader once per case and returns its results, so that a GLSL function can be compared with its C++ twin. The shader:
///   layout(local_size_x = 64) in;
///   layout(set = 0, binding = 0, scalar) readonly buffer In { Case cases[]; };
///   layout(set = 0, binding = 1, scalar) writeonly buffer Out { Result results[]; };
///   layout(set = 0, binding = 2, scalar) readonly buffer Extra { ... };     where `extra` is given
///   layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };
/// and returns at once where gl_GlobalInvocationID.x >= count.
template <class Result, class Case>
std::vector<Result> run_glsl_cases(Device& device, std::string_view shader, const std::vector<Case>& cases, Buffer* extra = nullptr)
{
    static_assert(std::is_trivially_copyable_v<Case> && std::is_trivially_copyable_v<Result>);
    Buffer in = device.buffer({cases.size() * sizeof(Case), 0, Memory::device, "cases"});
    Buffer out = device.buffer({cases.size() * sizeof(Result), 0, Memory::device, "results"});
    device.upload(in, std::as_bytes(std::span(cases)));
    PassList list(device);
    ComputePass pass;
    pass.name = "function";
    pass.program = &device.compute_program(shader);
    pass.bindings = {{list.import(in), Use::load}, {list.import(out), Use::store}};
    if (extra) pass.bindings.push_back({list.import(*extra), Use::load});
    pass.constants = uint32_t(cases.size());
    pass.threads = {uint32_t(cases.size()), 1, 1};
    list.compute(std::move(pass));
    device.submit(std::move(list));
    const std::vector<std::byte> bytes = device.read_back(out);
    std::vector<Result> results(cases.size());
    std::memcpy(results.data(), bytes.data(), bytes.size());
    return results;
}

/// The same for functions of and to vec4 (std430).
inline std::vector<Vec4> run_glsl_function(Device& device, std::string_view shader, const std::vector<Vec4>& inputs)
{
    return run_glsl_cases<Vec4>(device, shader, inputs);
}

} // namespace gnomon::gpu
