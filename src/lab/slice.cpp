// SPDX-License-Identifier: Apache-2.0
#include "lab/slice.h"

#include "base/error.h"
#include "lab/compare.h"
#include "shadow/light_constants.h"
#include "src/lab/slice.shared.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

vec3 towards_light(const scene::Light& light, vec3 p)
{
    const vec4 point = scene::light_point(light, p, vec2(0.5f));
    return glm::normalize(point.w == 0.0f ? vec3(point) : vec3(point) - p);
}

void choose_axes(const Stage& stage, const SliceOptions& options, Slice& out)
{
    vec3 light = towards_light(stage.lights.front(), out.centre);
    // a light straight above is in every vertical plane
    vec3 level(light.x, 0, light.z);
    if (!(glm::length(level) > 1e-3f)) level = vec3(1, 0, 0);
    out.right = options.right.value_or(glm::normalize(level)), out.up = options.up.value_or(vec3(0, 1, 0));
    const vec3 normal = glm::cross(out.right, out.up);
    if (!(glm::length(normal) > 1e-3f * glm::length(out.right) * glm::length(out.up)))
        base::fail("the slice's axes {}/{}/{} and {}/{}/{} lie along one line; give two that span a plane", out.right.x, out.right.y,
            out.right.z, out.up.x, out.up.y, out.up.z);
    out.right = glm::normalize(out.right);
    out.up = glm::normalize(glm::cross(glm::normalize(normal), out.right));
}

vec3 point_at(const Slice& slice, int x, int y)
{
    const base::Size size = slice.view.size;
    const vec2 ndc = vec2((float(x) + 0.5f) / float(size.width), (float(y) + 0.5f) / float(size.height)) * 2.0f - 1.0f;
    const vec4 p = slice.view.world_from_clip * vec4(ndc, slice.depth, 1.0f);
    return vec3(p) / p.w;
}

shadow::GBuffer draw_receivers(gpu::PassList& passes, shadow::SceneGpu& scene, const Stage& stage, const Slice& slice)
{
    const auto image = [&](VkFormat format, const char* name) {
        return passes.transient({format, slice.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    };
    shadow::GBuffer g;
    g.depth = image(VK_FORMAT_D32_SFLOAT, "depth");
    g.normal = image(VK_FORMAT_R32G32_UINT, "normal");
    g.primitive = image(VK_FORMAT_R32_UINT, "primitive");
    gpu::RasterPass pass;
    pass.name = "slice";
    pass.program = &scene.device().raster_program("shaders/fullscreen.vert", "src/lab/slice.frag");
    pass.constants = shaders::SliceConstants{
        shadow::view_constants(slice.view, 0), shadow::light_constants(stage.lights.front(), scene.bounds()), slice.depth};
    pass.colors = {{g.normal}, {g.primitive}};
    pass.depth = gpu::DepthTarget{.image = g.depth, .compare = VK_COMPARE_OP_ALWAYS};
    pass.draw = [](gpu::Encoder& encoder) { encoder.draw(3); };
    passes.raster(std::move(pass));
    return g;
}

} // namespace

Slice make_slice(const Stage& stage, const SliceOptions& options)
{
    Slice out;
    out.centre = options.centre ? *options.centre - stage.origin : stage.bounds.centre();
    choose_axes(stage, options, out);
    const vec3 normal = glm::cross(out.right, out.up);
    vec2 extent(0);
    for (int i = 0; i < 8; ++i) {
        const vec3 corner(i & 1 ? stage.bounds.max.x : stage.bounds.min.x, i & 2 ? stage.bounds.max.y : stage.bounds.min.y,
            i & 4 ? stage.bounds.max.z : stage.bounds.min.z);
        const vec3 d = corner - out.centre;
        extent = glm::max(extent, glm::abs(vec2(glm::dot(d, out.right), glm::dot(d, out.up))));
    }
    const base::Size size = stage.view.size;
    const float aspect = float(size.width) / float(size.height);
    const float half = options.height > 0 ? 0.5f * options.height : 1.05f * std::max(extent.y, extent.x / aspect);
    if (!std::isfinite(half) || !(half > 0)) base::fail("the slice has no height; give --height in metres");
    scene::Camera camera;
    camera.name = "slice";
    // in front of everything, so that nothing of the scene is behind the eye
    camera.eye = out.centre + normal * (2.0f * stage.bounds.radius() + glm::length(out.centre - stage.bounds.centre()) + half);
    camera.target = out.centre, camera.up = out.up, camera.half_height = half;
    Bounds seen = stage.bounds;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f}) seen.add(out.centre + half * (x * aspect * out.right + y * out.up));
    out.view = scene::make_view(camera, size, seen);
    const vec4 clip = out.view.clip_from_world * vec4(out.centre, 1.0f);
    out.depth = clip.z / clip.w;
    return out;
}

base::Picture slice_image(gpu::Device& device, shadow::SceneGpu& scene, const Stage& stage, const Slice& slice, const Choice& choice)
{
    const scene::Light& light = stage.lights.front();
    const std::string reason = unmeasurable(choice, device, light);
    if (!reason.empty()) base::fail("{}", reason);
    gpu::Image image = device.image({shadow::output_format(*choice.info, choice.params.bytes(), light), slice.view.size, 1, 1,
        VK_SAMPLE_COUNT_1_BIT, false, "technique's image"});
    const std::unique_ptr<shadow::Technique> technique = choice.info->create(device);
    gpu::PassList passes(device);
    const shadow::GBuffer g = draw_receivers(passes, scene, stage, slice);
    passes.group(std::string(choice.info->id));
    technique->record(passes, shadow::Frame{stage.scene, slice.view, light, scene, g, passes.import(image), 0}, choice.params.bytes());
    passes.group("");
    device.submit(std::move(passes));
    return judged_channels(device.read_back(image), 1);
}

base::Picture slice_truth(const Stage& stage, const Slice& slice, truth::Quantity quantity, int samples)
{
    const scene::Light& light = stage.lights.front();
    const base::Size size = slice.view.size;
    // Any primitive will do: it gives the offset of rays from their surface, and here there is none.
    truth::Primary receivers{
        base::Picture(size, 1, 1.0f), base::Picture(size, 3), base::Picture(size, 3), std::vector<uint32_t>(size.area(), 0u)};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const vec3 p = point_at(slice, x, y), n = towards_light(light, p);
            for (int c = 0; c < 3; ++c) receivers.position.at(x, y, c) = p[c], receivers.normal.at(x, y, c) = n[c];
        }
    const truth::Tracer tracer(stage.scene);
    const truth::Settings settings{.samples = samples};
    return quantity == truth::Quantity::visibility ? tracer.visibility(slice.view, receivers, light, settings).mean
                                                   : tracer.transmittance(slice.view, receivers, light, settings).mean;
}

} // namespace gnomon::lab
