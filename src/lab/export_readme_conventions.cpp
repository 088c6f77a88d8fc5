// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"
#include "lab/export_readme.h"

namespace gnomon::lab {

namespace {

const char* common = R"(## Conventions

- Metres, seconds, radians. World space is right-handed with +Y up; view space looks along -Z. Front faces are counter-clockwise seen from outside.
- Matrices are stored by column and multiply column vectors; `clip_from_world` takes world to clip space, so a product reads from right to left.
- **Depth is reversed**, of the view and of light maps: 1 at the near plane, 0 at infinity (perspective) or at the far plane (orthographic). Clear to 0 and test with GREATER. A renderer with the usual depth converts it (`1 - z` with its planes exchanged in the matrices) or draws a copy.
- Row 0 of an image is on top, pixel centres lie at +0.5, uv (0, 0) is the corner above and left of the first texel. In map space u is right, v is down.
- Visibility counts neither cosine nor distance nor the light's profile: only what stands between.
- Casters block from both sides, whatever their material's sidedness; masked materials where alpha >= cutoff; blended ones not at all.
)";

const char* glsl = R"(
### GLSL

- Vulkan's GLSL (`#version 460`): compile with `glslc --target-env=vulkan1.3 FILE`, or glslangValidator. Not for OpenGL: scalar block layouts, descriptor sets, arrays of textures without a size and base instances have no equal there.
- Set 0 holds a pass's bindings, set 1 binding 0 the constants block (a uniform buffer in **scalar layout**: enable `scalarBlockLayout`), set 2 binding 0 the scene's textures. Buffers of set 0 say their layout themselves.
- Specialisation constants are `layout(constant_id = N)`; their defaults are the values of the first pass that uses the shader. Give each pass its own, below.
- Clip space is Vulkan's: y down, z from 0 to 1.
)";

const char* hlsl = R"(
### HLSL

- Shader model 6.0 for `dxc -T vs_6_0`, `ps_6_0`, `cs_6_0`, entry point `main`; files that use `RayQuery` need 6.5.
- The register is the binding, the space is the set: binding 3 of set 0 is `t3, space0` and its sampler `s3, space0`; what is written is `u3, space0`.
- **The constants block is a `ByteAddressBuffer` at t0, space1**, and not a cbuffer, whose packing cannot say these layouts: bind the bytes of the struct in `layouts.h` as a raw buffer (a root SRV will do). Other buffers are raw too.
- Specialisation constants are macros: `-D SPIRV_CROSS_CONSTANT_ID_N=value`. Their defaults are the values of the first pass that uses the shader. Give each pass its own, below.
- The cbuffer `SPIRV_Cross_VertexInfo` (b0, space0) wants the base vertex and base instance of the draw, which HLSL's `SV_VertexID` and `SV_InstanceID` leave out: root constants, set for each draw, or by ExecuteIndirect's command signature.
- `SPIRV_Cross_NumWorkgroups` (b0, space3), where a compute shader has it, wants the numbers of groups of the dispatch.
- Vertex attribute location N has the semantic `TEXCOORDN`. Vertex shaders turn y: what Vulkan's clip space has down, they write up, so that the matrices stay as they are and pictures come out the same way up. `FrontCounterClockwise` is TRUE.
- A layer chosen in a vertex shader (`SV_RenderTargetArrayIndex`) needs `VPAndRTArrayIndexFromAnyShaderFeedingRasterizerSupportedWithoutGSEmulation`.
- Where a shader wants a wave's number in its group, HLSL knows none: `SV_GroupIndex / WaveGetLaneCount()` stands for it, right where waves fill a group in order, as they do in groups of one dimension on all hardware known.
)";

const char* msl = R"(
### Metal

- Metal Shading Language 2.4 (macOS 12, iOS 15), entry point `main0`.
- Set 0: the binding is the index, `[[texture(N)]]` with `[[sampler(N)]]`, `[[buffer(N)]]`. The constants block is `[[buffer(24)]]`. The scene's textures are an argument buffer at `[[buffer(25)]]` (tier 2): textures from id 0, samplers from id 128 on. It holds 128 of each: for a scene with more, change that number in `spvDescriptorSetBuffer2`. `[[buffer(26)]]`, where a file has it, holds the byte sizes of the buffers by their index.
- Vertex attributes come by a vertex descriptor (`[[attribute(location)]]`); put the streams at buffer indices from 30 down, out of the way.
- Specialisation constants are function constants, or `SPIRV_CROSS_CONSTANT_ID_N` macros where they give an array its size. Their defaults are the values of the first pass that uses the shader. Give each pass its own, below.
- A compute pass's `local size` is the threadgroup's size: Metal takes it at dispatch.
- Vertex shaders turn y: what Vulkan's clip space has down, they write up, so that the matrices stay as they are and pictures come out the same way up. The winding is `MTLWindingCounterClockwise`.
- No compiler of Metal was at hand where Gnomon is tested: these files are SPIRV-Cross's word.
)";

const char* spirv = R"(
### SPIR-V

- For Vulkan 1.3 (SPIR-V 1.6), entry point `main`; enable `scalarBlockLayout`, and `maintenance4`, since work groups that are specialised say so by LocalSizeId.
- Set 0 holds a pass's bindings, set 1 binding 0 the constants block (a uniform buffer in scalar layout), set 2 binding 0 the scene's textures.
- The specialisation constants' defaults are the values of the first pass that uses the shader. Give each pass its own, below.
- Clip space is Vulkan's: y down, z from 0 to 1. Front faces are counter-clockwise.
)";

bool any_scene_draw(const Json& recipe)
{
    for (const Json& pass : recipe["passes"])
        for (const Json& draw : pass.value("draws", Json::array()))
            for (const Json& buffer : draw.value("vertex_buffers", Json::array()))
                if (buffer == "positions") return true;
    return false;
}

const char* scene_draws = R"(
### Draws of the scene

Passes whose vertex buffer is `positions` draw the casters: one indexed draw for each run of instances of one mesh, with the mesh's place in `indices` and `positions` as first index and vertex offset. **The first instance carries two numbers**: the instance's place in the buffer `instances` in the low 24 bits, and in the top byte the layer of the target to draw into. A pass with several layers draws the scene once for each, culled against that layer. Programs that read materials draw the masked instances, the others the opaque ones. A host with buffers of its own keeps the shaders' view of `instances` (`Instance` in `layouts.h`) or edits the vertex shaders.
)";

} // namespace

std::string readme_conventions(const Json& recipe)
{
    const char* languages[] = {glsl, hlsl, msl, spirv};
    std::string out = common;
    out += languages[size_t(parse_language(recipe["language"]))];
    if (any_scene_draw(recipe)) out += scene_draws;
    return out + "\n";
}

} // namespace gnomon::lab
