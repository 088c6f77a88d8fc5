// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"

#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::gpu {

using Vec4 = std::array<float, 4>;

/// Runs a compute shader once per input and returns its outputs, so that a GLSL function can be compared with its C++ twin. The shader:
///   layout(local_size_x = 64) in;
///   layout(set = 0, binding = 0, std430) readonly buffer In { vec4 inputs[]; };
///   layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 outputs[]; };
///   layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };
/// and returns at once where gl_GlobalInvocationID.x >= count.
inline std::vector<Vec4> run_glsl_function(Device& device, std::string_view shader, std::span<const Vec4> inputs)
{
    Buffer in = device.buffer({inputs.size_bytes(), 0, Memory::device, "inputs"});
    Buffer out = device.buffer({inputs.size_bytes(), 0, Memory::device, "outputs"});
    device.upload(in, std::as_bytes(inputs));
    PassList list(device);
    ComputePass pass;
    pass.name = "function";
    pass.program = &device.compute_program(shader);
    pass.bindings = {{list.import(in), Use::load}, {list.import(out), Use::store}};
    pass.constants = uint32_t(inputs.size());
    pass.threads = {uint32_t(inputs.size()), 1, 1};
    list.compute(std::move(pass));
    device.submit(std::move(list));
    const std::vector<std::byte> bytes = device.read_back(out);
    std::vector<Vec4> outputs(inputs.size());
    std::memcpy(outputs.data(), bytes.data(), bytes.size());
    return outputs;
}

} // namespace gnomon::gpu
