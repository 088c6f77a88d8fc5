// SPDX-License-Identifier: Apache-2.0
// Planar projected shadows (Blinn 1988), cut at the light and at the plane (Heckbert, Herf 1997), each pixel darkened once (Kilgard 1999).
#include "techniques/planar/planar.shared.h"

#include "shadow/light_constants.h"
#include "shadow/technique.h"
#include "techniques/planar/planes.h"

#include <cmath>

namespace gnomon::techniques::planar {

namespace {

using namespace shadow;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

void describe(Params& p, Fields& fields)
{
    fields.integer("planes", p.planes, {1, PLANAR_MAX_PLANES}, "planes", "How many planes receive shadows, largest area first.");
    fields.real("smallest_plane", p.smallest, {0.0001, 1}, "", "Least area of such a plane, as a fraction of all surfaces of the scene.");
    fields.real("darkness", p.darkness, {0, 1}, "", "How much of the light a shadow takes; 1 is the truth.");
    fields.flag("once", p.once,
        "The stencil lets each pixel be darkened once. Off, pixels darken again with every layer of casters, unless `darkness` is 1.");
}

/// The light as a homogeneous point: direction towards it, or position and 1.
dvec4 light_point(const scene::Light& light)
{
    if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) return dvec4(-dvec3(sun->direction), 0.0);
    if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) return dvec4(dvec3(spot->position), 1.0);
    return dvec4(dvec3(std::get<scene::PointLight>(light.shape).position), 1.0);
}

/// One plane under one light.
struct Facing {
    dvec4 plane; ///< positive on the light's side
    double height; ///< dot(plane, light): metres above it, or the cosine for a parallel light
    bool edge_on; ///< the plane holds the light: nothing reaches it, and there is no projection
};

Facing facing(dvec4 plane, const dvec4& light, double thickness)
{
    double height = glm::dot(plane, light);
    if (height < 0.0) plane = -plane, height = -height;
    return {plane, height, height <= (light.w == 0.0 ? 1e-6 : thickness)};
}

CasterConstants caster_constants(const Facing& f, const dvec4& light, const scene::View& view, double thickness, float darkness)
{
    // M = (P . L) I - L P^T (Blinn 1988, for any homogeneous light): M p lies on the plane and on the line through p and the light. Its w,
    // (P . L) - L.w (P . p), is negative past a point light, where the line meets the plane on the other side: the anti-shadow.
    dmat4 project(f.height);
    for (int c = 0; c < 4; ++c) project[c] -= light * f.plane[c];
    CasterConstants out{};
    out.clip_from_caster = mat4(dmat4(view.clip_from_world) * project);
    out.above = vec4(f.plane - dvec4(0, 0, 0, thickness));
    // clipped a hair before w = 0, where the projection is at infinity
    out.before = vec4(dvec4(0, 0, 0, f.height * (1.0 - 1e-6)) - light.w * f.plane);
    out.kept = 1.0f - darkness;
    return out;
}

constexpr VkStencilOpState stencil_state(VkCompareOp compare, VkStencilOp pass)
{
    return {VK_STENCIL_OP_KEEP, pass, VK_STENCIL_OP_KEEP, compare, 0xff, 0xff, 1};
}

gpu::DepthTarget stencil_target(gpu::ImageId stencil, gpu::Load load, const VkStencilOpState& state)
{
    gpu::DepthTarget target{.image = stencil, .load = load, .write = false, .compare = VK_COMPARE_OP_ALWAYS};
    target.stencil = true, target.front = target.back = state;
    return target;
}

class Planar final : public TechniqueWith<Params> {
public:
    explicit Planar(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        if (content_ != frame.resources.content() || params.planes != found_with_.planes || params.smallest != found_with_.smallest) {
            known_ = find_planes(frame.scene, params.planes, double(params.smallest));
            found_with_ = params, content_ = frame.resources.content();
        }
        const dvec4 light = light_point(frame.light);
        const double thickness = plane_thickness(frame.scene);
        std::vector<Facing> planes;
        for (const Plane& p : known_) planes.push_back(facing(p.equation, light, thickness));

        const gpu::ImageId plane_image
            = passes.transient({VK_FORMAT_R8_UINT, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "planes"});
        find_receivers(passes, frame, planes, float(thickness), plane_image);
        const gpu::ImageId stencil
            = passes.transient({VK_FORMAT_D32_SFLOAT_S8_UINT, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "stencil"});
        for (uint32_t k = 0; k < planes.size(); ++k) {
            if (planes[k].edge_on) continue;
            tag(passes, plane_image, stencil, k);
            project(passes, frame, stencil, caster_constants(planes[k], light, frame.view, thickness, params.darkness), params.once != 0);
        }
    }

    void find_receivers(
        gpu::PassList& passes, const Frame& frame, const std::vector<Facing>& planes, float thickness, gpu::ImageId plane_image)
    {
        ReceiverConstants c{
            .view = view_constants(frame.view, frame.index), .light = light_constants(frame.light, frame.resources.bounds())};
        for (const Facing& f : planes) {
            c.edge_on |= uint32_t(f.edge_on) << c.plane_count;
            c.planes[c.plane_count++] = vec4(f.plane);
        }
        c.thickness = thickness;
        passes.fullscreen({.name = "receivers",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/planar/planar_receivers.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}},
            .constants = c,
            .colors = {{frame.output}, {plane_image}}});
    }

    /// Stencil 1 where the picture shows the lit side of plane `k`, 0 elsewhere.
    void tag(gpu::PassList& passes, gpu::ImageId plane_image, gpu::ImageId stencil, uint32_t k)
    {
        gpu::RasterPass pass;
        pass.name = "tag";
        pass.program = &device_.raster_program("shaders/fullscreen.vert", "techniques/planar/planar_tag.frag");
        pass.bindings = {{plane_image, gpu::Use::sample}};
        pass.constants = TagConstants{k};
        pass.depth = stencil_target(stencil, gpu::Load::clear, stencil_state(VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_REPLACE));
        pass.draw = [](gpu::Encoder& encoder) { encoder.draw(3); };
        passes.raster(std::move(pass));
    }

    void project(gpu::PassList& passes, const Frame& frame, gpu::ImageId stencil, const CasterConstants& constants, bool once)
    {
        SceneGpu& scene = frame.resources;
        const gpu::Program& opaque
            = device_.raster_program("techniques/planar/planar_casters.vert", "techniques/planar/planar_casters.frag");
        const gpu::Program& masked = device_.raster_program("techniques/planar/planar_masked.vert", "techniques/planar/planar_masked.frag");
        // what is there times what is kept
        VkPipelineColorBlendAttachmentState multiply{VK_TRUE, VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_SRC_COLOR, VK_BLEND_OP_ADD,
            VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_ONE, VK_BLEND_OP_ADD, VK_COLOR_COMPONENT_R_BIT};
        gpu::RasterPass pass;
        pass.name = "casters";
        pass.program = &opaque;
        pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load}};
        pass.constants = constants;
        pass.textures = &scene.textures();
        pass.colors = {{.image = frame.output, .load = gpu::Load::keep, .blend = multiply}};
        pass.depth = stencil_target(
            stencil, gpu::Load::keep, stencil_state(VK_COMPARE_OP_EQUAL, once ? VK_STENCIL_OP_INCREMENT_AND_CLAMP : VK_STENCIL_OP_KEEP));
        pass.streams = {SceneGpu::position_stream(), SceneGpu::attribute_stream()};
        // the planes that cut triangles leave out whole instances
        pass.draw = [&scene, &opaque, &masked, cull = Planes{constants.above, constants.before}](gpu::Encoder& encoder) {
            scene.draw(encoder, {.sets = draw_opaque, .cull = &cull, .second = SceneGpu::Second::attributes});
            if (!scene.has(draw_masked)) return;
            encoder.program(masked);
            scene.draw(encoder, {.sets = draw_masked, .cull = &cull, .second = SceneGpu::Second::attributes});
            encoder.program(opaque);
        };
        passes.raster(std::move(pass));
    }

    gpu::Device& device_;
    std::vector<Plane> known_; ///< of the casters in content_
    std::shared_ptr<const void> content_;
    Params found_with_;
};

} // namespace

} // namespace gnomon::techniques::planar

extern const gnomon::shadow::TechniqueInfo technique_planar;
const gnomon::shadow::TechniqueInfo technique_planar = {
    .id = "planar",
    .title = "Planar projected shadows",
    .family = "projection shadows",
    .cite = "Blinn 1988; Heckbert, Herf 1997; Kilgard 1999",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .partial = true,
    .reads_vertices = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::planar::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::planar::Planar>(device);
    },
};
