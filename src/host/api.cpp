// SPDX-License-Identifier: Apache-2.0
#include "gpu/features.h"
#include "host/result.h"
#include "host/shadow.h"

using namespace gnomon;
using host::guarded;

const char* gnomon_error_message(void) { return host::last_message(); }
uint32_t gnomon_version(void) { return GNOMON_VERSION; }

uint32_t gnomon_technique_count(void) { return uint32_t(shadow::techniques().size()); }

gnomon_result gnomon_technique_get(uint32_t index, gnomon_technique* out)
{
    return guarded([&] {
        const auto all = shadow::techniques();
        if (!out || index >= all.size())
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_technique_get: there are {} techniques, and no number {}", all.size(), index);
        const shadow::TechniqueInfo& t = *all[index];
        const shadow::ParamTable table = t.params();
        // the views are of literals, which end in a zero
        *out = {t.id.data(), t.title.data(), t.family.data(), t.cite.data(), t.lights, t.soft, t.output == shadow::Output::transmittance,
            t.reads_vertices, t.reads_ids && t.reads_ids(table.defaults)};
    });
}

gnomon_result gnomon_require(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical, const gnomon_features* features)
{
    return guarded([&] {
        if (!get || !instance || !physical || !features || !features->core || !features->v11 || !features->v12 || !features->v13)
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_require needs all of its handles and the four structures of gnomon_features");
        const std::string missing
            = gpu::require_features(get, instance, physical, {features->core, features->v11, features->v12, features->v13});
        if (!missing.empty()) host::refuse(GNOMON_ERROR_UNSUPPORTED, "{}", missing);
    });
}

gnomon_result gnomon_device_create(const gnomon_device_info* info, gnomon_device* out)
{
    return guarded([&] {
        if (!info || !out)
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_device_create needs a gnomon_device_info and a place for the device");
        *out = new gnomon_device_t{std::make_shared<host::Device>(*info)};
    });
}

void gnomon_device_destroy(gnomon_device device)
{
    guarded([&] { delete device; });
}

void gnomon_retire(gnomon_device device, uint64_t ticket)
{
    guarded([&] {
        if (device) device->device->retire(ticket);
    });
}

uint64_t gnomon_device_bytes(gnomon_device device) { return device ? device->device->gpu->allocated_bytes() : 0; }

gnomon_result gnomon_scene_create(gnomon_device device, const gnomon_scene_info* info, gnomon_scene* out)
{
    return guarded([&] {
        if (!device || !info || !out)
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_scene_create needs a device, a gnomon_scene_info and a place for the scene");
        *out = new gnomon_scene_t{std::make_shared<host::Casters>(device->device, *info)};
    });
}

void gnomon_scene_destroy(gnomon_scene scene)
{
    guarded([&] { delete scene; });
}

gnomon_result gnomon_scene_move(gnomon_scene scene, uint32_t first, uint32_t count, const VkTransformMatrixKHR* transforms)
{
    return guarded([&] {
        if (!scene || (count > 0 && !transforms)) host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_scene_move needs a scene and its transforms");
        scene->casters->move(first, {transforms, count});
    });
}

gnomon_result gnomon_scene_deform(gnomon_scene scene, uint32_t mesh, const float lower[3], const float upper[3])
{
    return guarded([&] {
        if (!scene || !lower || !upper) host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_scene_deform needs a scene and the mesh's bounds");
        scene->casters->deform(mesh, {lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]});
    });
}

gnomon_result gnomon_shadow_create(gnomon_scene scene, const char* technique, const char* settings, gnomon_shadow* out)
{
    return guarded([&] {
        if (!scene || !out) host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_shadow_create needs a scene and a place for the shadow");
        *out = new gnomon_shadow_t{host::Shadow(scene->casters, technique, settings)};
    });
}

void gnomon_shadow_destroy(gnomon_shadow shadow)
{
    guarded([&] { delete shadow; });
}

gnomon_result gnomon_shadow_set(gnomon_shadow shadow, const char* settings)
{
    return guarded([&] {
        if (!shadow) host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_shadow_set needs a shadow");
        shadow->shadow.set(settings);
    });
}

gnomon_result gnomon_choose(gnomon_device device, uint32_t level, const gnomon_light* light, gnomon_choice* out)
{
    return guarded([&] {
        if (!device || !light || !out)
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_choose needs a device, a light and a place for the choice");
        *out = host::choose(*device->device, level, *light);
    });
}

gnomon_result gnomon_record(gnomon_shadow shadow, const gnomon_frame* frame, uint64_t* ticket)
{
    return guarded([&] {
        if (!shadow || !frame || !ticket)
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_record needs a shadow, a gnomon_frame and a place for the ticket");
        *ticket = shadow->shadow.record(*frame);
    });
}
