// SPDX-License-Identifier: Apache-2.0
#include "host/shadow.h"

#include "host/receivers.h"
#include "host/result.h"
#include "shadow/quality.h"

#include <sstream>
#include <stdexcept>

namespace gnomon::host {

namespace {

const shadow::TechniqueInfo& technique_named(const char* id)
{
    if (!id) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_shadow_create was given no technique; gnomon_technique_get lists them");
    try {
        return shadow::technique(id);
    } catch (const base::Error& e) {
        throw Refusal(GNOMON_ERROR_ARGUMENT, e.what());
    }
}

/// A view's planes are Gnomon's; the host's are these seen through its own space.
std::vector<vec4> planes_of(const shadow::Planes& planes, const dmat4& world_from_host)
{
    std::vector<vec4> out;
    for (const vec4& p : planes) {
        const dvec4 plane = glm::transpose(world_from_host) * dvec4(p);
        out.push_back(vec4(plane / glm::length(dvec3(plane))));
    }
    return out;
}

} // namespace

gnomon_choice choose(const Device& device, uint32_t level, const gnomon_light& light)
{
    if (level >= uint32_t(shadow::level_count))
        refuse(GNOMON_ERROR_ARGUMENT, "level {} was asked for; the levels are 0 (low) to {} (exact)", level, shadow::level_count - 1);
    const shadow::Quality& quality = shadow::choose_quality(shadow::Level(level), *device.gpu, light_of(light, dmat4(1.0)));
    const shadow::ParamValues defaults(quality.technique->params());
    std::string settings;
    for (const shadow::ParamInfo& field : quality.params.table().fields)
        if (quality.params.text(field) != defaults.text(field))
            settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", field.name, quality.params.text(field));
    gnomon_choice out{};
    if (quality.technique->id.size() >= sizeof(out.technique) || settings.size() >= sizeof(out.settings))
        throw std::logic_error("a quality level's words are longer than gnomon_choice");
    quality.technique->id.copy(out.technique, sizeof(out.technique));
    settings.copy(out.settings, sizeof(out.settings));
    out.time = quality.price ? quality.price->time : -1.0, out.error = quality.price ? quality.price->mae : -1.0;
    out.mebibytes = quality.price ? quality.price->mib : -1.0;
    return out;
}

Shadow::Shadow(std::shared_ptr<Casters> casters, const char* technique, const char* settings)
    : casters_(std::move(casters))
    , info_(technique_named(technique))
    , params_(info_.params())
{
    gpu::Device& gpu = *casters_->device().gpu;
    if (info_.unavailable) {
        const std::string reason = info_.unavailable(gpu);
        if (!reason.empty()) refuse(GNOMON_ERROR_UNSUPPORTED, "{}", reason);
    }
    if (info_.reads_vertices && !casters_->has_vertices())
        refuse(GNOMON_ERROR_ARGUMENT,
            "{} prepares casters on the CPU, and some meshes of the scene have no positions there; give gnomon_mesh::positions", info_.id);
    set(settings);
    technique_ = info_.create(gpu);
}

void Shadow::set(const char* settings)
{
    shadow::ParamValues changed = params_;
    std::istringstream words(settings ? settings : "");
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos)
            refuse(GNOMON_ERROR_ARGUMENT, "'{}' is no setting of {}; settings are name=value, parted by blanks", word, info_.id);
        try {
            changed.set(word.substr(0, equals), std::string_view(word).substr(equals + 1));
        } catch (const base::Error& e) {
            throw Refusal(GNOMON_ERROR_ARGUMENT, e.what());
        }
    }
    params_ = std::move(changed);
}

void Shadow::check_inputs(const scene::Light& light) const
{
    const std::string reason = shadow::refusal(info_, *casters_->device().gpu, light);
    if (!reason.empty()) refuse(GNOMON_ERROR_UNSUPPORTED, "{}", reason);
    if (kind_ >= 0 && kind_ != int(light.kind()))
        refuse(GNOMON_ERROR_ARGUMENT, "this shadow was recorded with a {} light and now with a {} one; make one gnomon_shadow for each",
            scene::kind_name(scene::LightKind(kind_)), scene::kind_name(light.kind()));
}

void Shadow::set_filter(const gnomon_frame& frame)
{
    if (!frame.cull) {
        casters_->resources().set_filter(nullptr);
        return;
    }
    casters_->resources().set_filter(
        [cull = frame.cull, user = frame.cull_user, &m = casters_->world_from_host()](uint32_t instance, const shadow::Planes& planes) {
            const std::vector<vec4> own = planes_of(planes, m);
            return cull(user, instance, reinterpret_cast<const float(*)[4]>(own.data()), uint32_t(own.size())) != VK_FALSE;
        });
}

void Shadow::deliver(gpu::PassList& passes, gpu::ImageId from, gpu::ImageId to) const
{
    const gpu::SpecConstant grey[] = {{0, passes.desc(from).format == VK_FORMAT_R32_SFLOAT ? 1u : 0u}};
    passes.fullscreen({.name = "deliver",
        .program = &casters_->device().gpu->raster_program("shaders/fullscreen.vert", "src/host/deliver.frag", grey),
        .bindings = {{from, gpu::Use::sample}},
        .colors = {{to, gpu::Load::discard}}});
}

uint64_t Shadow::record(const gnomon_frame& frame)
{
    Device& device = casters_->device();
    gpu::Device& gpu = *device.gpu;
    if (!frame.commands) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::commands is missing; give a command buffer that is being recorded");
    const gnomon_image& target = frame.output;
    const base::Size size{int(target.extent.width), int(target.extent.height)};
    if (size.width < 1 || size.height < 1) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::output has no pixels");
    if (target.samples > VK_SAMPLE_COUNT_1_BIT)
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::output is multisampled; give an image of one sample");
    if (!(gpu.format_features(target.format) & VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BIT))
        refuse(GNOMON_ERROR_UNSUPPORTED, "gnomon_frame::output has the format {}, which this device cannot draw into", int(target.format));
    const scene::Light light = light_of(frame.light, casters_->world_from_host());
    check_inputs(light);
    const bool ids = info_.reads_ids && info_.reads_ids(params_.bytes());
    gnomon_frame seen = frame;
    if (ids || !frame.depth.image) seen.depth = {}; // receivers are drawn here, at the centres of pixels, not at the host's samples
    const HostView view = view_of(seen, casters_->world_from_host(), size, casters_->resources().bounds());

    if (casters_->has_unread()) { // a list of its own: acceleration structures are built between it and the next
        gpu::PassList reads(gpu);
        casters_->add_reads(reads);
        device.recorded = gpu.record(std::move(reads), frame.commands);
        casters_->read();
    }
    gpu::PassList passes(gpu);
    HostImages images(gpu);
    const gpu::ImageId output = images.import(passes, target, "output", false);
    passes.group("common");
    const shadow::GBuffer gbuffer = receive(passes, *casters_, images, seen, view, ids);
    passes.group("");
    const gpu::ImageId image = passes.transient(
        gpu::ImageDesc{shadow::output_format(info_, params_.bytes(), light), size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "shadow"});
    set_filter(frame);
    const shadow::Frame work{casters_->scene(), view.view, light, casters_->resources(), gbuffer, image, frame.index};
    technique_->record(passes, work, params_.bytes());
    deliver(passes, image, output);
    device.recorded = gpu.record(std::move(passes), frame.commands, images.layouts());
    casters_->resources().set_filter(nullptr);
    kind_ = int(light.kind());
    return device.recorded;
}

} // namespace gnomon::host
