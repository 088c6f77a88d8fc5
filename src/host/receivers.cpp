// SPDX-License-Identifier: Apache-2.0
#include "host/receivers.h"

#include "host/result.h"
#include "shadow/light_constants.h"
#include "src/host/receive.shared.h"

namespace gnomon::host {

gpu::ImageId HostImages::import(gpu::PassList& passes, const gnomon_image& image, const char* name, bool content)
{
    if (!image.image) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::{} has no image", name);
    if (content && image.layout == VK_IMAGE_LAYOUT_UNDEFINED)
        refuse(GNOMON_ERROR_ARGUMENT,
            "gnomon_frame::{} is in the layout UNDEFINED, in which it has no content; state the one that it is in", name);
    const VkSampleCountFlagBits samples = image.samples ? image.samples : VK_SAMPLE_COUNT_1_BIT;
    const gpu::ImageDesc desc{image.format, {int(image.extent.width), int(image.extent.height)}, 1, 1, samples, false, name};
    images_.push_back(std::make_unique<gpu::Image>(device_.adopt_image(image.image, desc, image.layout)));
    layouts_.push_back(
        {images_.back().get(), image.layout != VK_IMAGE_LAYOUT_UNDEFINED ? image.layout : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    return passes.import(*images_.back());
}

namespace {

shaders::ReceiveConstants constants_of(const gnomon_frame& frame, const HostView& view, const dmat4& world_from_host)
{
    shaders::ReceiveConstants c{};
    c.view = shadow::view_constants(view.view, frame.index);
    c.depth_row = vec4(view.depth_row), c.w_row = vec4(view.w_row);
    const mat4 rows = mat4(glm::transpose(world_from_host));
    c.normal_x = rows[0], c.normal_y = rows[1], c.normal_z = rows[2];
    c.background = frame.background;
    c.normals = frame.normals.image ? frame.normal_encoding : NORMALS_NONE;
    return c;
}

void check_size(const gnomon_image& image, base::Size size, const char* name)
{
    if (int(image.extent.width) != size.width || int(image.extent.height) != size.height)
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::{} has {} x {} pixels and the output {} x {}; all images of a frame have one size",
            name, image.extent.width, image.extent.height, size.width, size.height);
}

void check_attribute(const gnomon_image& image, base::Size size, const char* name)
{
    if (image.samples > VK_SAMPLE_COUNT_1_BIT)
        refuse(GNOMON_ERROR_UNSUPPORTED, "gnomon_frame::{} is multisampled; resolve it into an image of one sample", name);
    check_size(image, size, name);
}

} // namespace

shadow::GBuffer receive(
    gpu::PassList& passes, Casters& casters, HostImages& images, const gnomon_frame& frame, const HostView& host, bool ids)
{
    if (ids || !frame.depth.image) return shadow::draw_gbuffer(passes, casters.resources(), host.view, {.material = false, .flat = true});
    gpu::Device& gpu = *casters.device().gpu;
    const base::Size size = host.view.size;
    check_size(frame.depth, size, "depth");
    if (frame.normals.image) check_attribute(frame.normals, size, "normals");
    if (frame.motion.image) check_attribute(frame.motion, size, "motion");
    if (frame.normal_encoding > (GNOMON_NORMAL_OCTAHEDRAL_UNSIGNED | GNOMON_NORMAL_GEOMETRIC))
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::normal_encoding is {}; the encodings are 0 to 3, or 4 to 7 of geometric normals",
            frame.normal_encoding);
    const auto image = [&](VkFormat format, const char* name) {
        return passes.transient(gpu::ImageDesc{format, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    };
    shadow::GBuffer out;
    out.depth = image(VK_FORMAT_D32_SFLOAT, "depth");
    out.normal = image(VK_FORMAT_R32G32_UINT, "normal");
    out.primitive = image(VK_FORMAT_R32_UINT, "primitive");
    if (frame.motion.image) out.motion = image(VK_FORMAT_R32G32_SFLOAT, "motion");
    gpu::ImageId normals;
    if (frame.normals.image) {
        normals = images.import(passes, frame.normals, "normals", true);
    } else {
        normals = passes.transient(gpu::ImageDesc{VK_FORMAT_R32_SFLOAT, {1, 1}, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "no image"});
        passes.clear(normals, {}, "no image");
    }
    const bool samples = frame.depth.samples > VK_SAMPLE_COUNT_1_BIT, moves = frame.motion.image != VK_NULL_HANDLE;
    const char* const programs[2][2] = {{"src/host/receive.frag", "src/host/receive_moving.frag"},
        {"src/host/receive_samples.frag", "src/host/receive_samples_moving.frag"}};
    gpu::RasterPass pass;
    pass.name = "receive";
    pass.program = &gpu.raster_program("shaders/fullscreen.vert", programs[samples][moves]);
    pass.bindings = {{images.import(passes, frame.depth, "depth", true), gpu::Use::sample}, {normals, gpu::Use::sample}};
    pass.colors = {{out.normal, gpu::Load::discard}, {out.primitive, gpu::Load::discard}};
    if (moves) {
        pass.bindings.push_back({images.import(passes, frame.motion, "motion", true), gpu::Use::sample});
        pass.colors.push_back({out.motion, gpu::Load::discard});
    }
    pass.constants = constants_of(frame, host, casters.world_from_host());
    pass.depth = gpu::DepthTarget{.image = out.depth, .load = gpu::Load::discard, .compare = VK_COMPARE_OP_ALWAYS};
    pass.draw = [](gpu::Encoder& encoder) { encoder.draw(3); };
    passes.raster(std::move(pass));
    return out;
}

} // namespace gnomon::host
