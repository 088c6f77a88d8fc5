// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_nodes.h"

#include <cmath>

namespace gnomon::scene::gltf {
namespace {

/// The node's place and axes, in world space and free of scale.
struct Frame {
    vec3 position, forward, up;
};

Frame frame_of(const dmat4& world, const Value& node)
{
    const dvec3 up(world[1]), forward(-world[2]), position(world[3]);
    const bool sound = glm::length(up) > 0 && glm::length(forward) > 0 && std::isfinite(glm::length(up) + glm::length(forward))
        && glm::length(position) < 1e15;
    if (!sound) node.bad("has a transform that is not finite or without directions");
    return {vec3(position), vec3(glm::normalize(forward)), vec3(glm::normalize(up))};
}

LightShape shape_of(const Value& light, const Frame& frame)
{
    const std::string& type = light.at("type").text();
    if (type == "directional") return DirectionalLight{frame.forward, 0.0f};
    if (type == "point") return PointLight{frame.position, 0.0f};
    if (type != "spot") light.bad("has the unknown type '{}'", printable(type));
    const Value spot = light.find("spot");
    const double inner = spot.number_or("innerConeAngle", 0.0), outer = spot.number_or("outerConeAngle", 0.25 * std::numbers::pi);
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= 0.5 * std::numbers::pi))
        light.bad("has cone angles of {} and {}; they must rise within 0 and pi / 2", inner, outer);
    return SpotLight{frame.position, frame.forward, float(inner), float(outer), 0.0f};
}

} // namespace

void add_light(Document& document, const Value& node, const dmat4& world, Scene& scene)
{
    const Value reference = node.extension("KHR_lights_punctual").find("light");
    if (!reference) return;
    document.recover("the light is left out", [&] {
        const Value list = document.root().extension("KHR_lights_punctual").find("lights");
        if (reference.integer() >= list.size()) reference.bad("refers to light {}, but the file has {}", reference.integer(), list.size());
        const Value light = list[reference.integer()];
        Light out;
        out.name = light.text_or("name", node.text_or("name", fmt::format("light {}", scene.lights.size())));
        double color[3] = {1, 1, 1};
        light.numbers_if("color", color);
        out.color = glm::max(vec3(color[0], color[1], color[2]), vec3(0));
        if (const Value intensity = light.find("intensity")) out.intensity = float(std::clamp(intensity.number(), 0.0, 1e30));
        out.shape = shape_of(light, frame_of(world, node));
        scene.lights.push_back(std::move(out));
    });
}

void add_camera(Document& document, const Value& node, const dmat4& world, Scene& scene)
{
    const Value reference = node.find("camera");
    if (!reference) return;
    document.recover("the camera is left out", [&] {
        const Value camera = document.element("cameras", reference);
        const Frame frame = frame_of(world, node);
        Camera out;
        out.name = camera.text_or("name", node.text_or("name", fmt::format("camera {}", scene.cameras.size())));
        out.eye = frame.position;
        out.target = frame.position + frame.forward;
        out.up = frame.up;
        const std::string& type = camera.at("type").text();
        if (type == "perspective") {
            const Value perspective = camera.at("perspective");
            const double fov = perspective.at("yfov").number();
            if (!(fov > 0 && fov < std::numbers::pi)) camera.bad("has a yfov of {}; it must lie between 0 and pi", fov);
            out.fov_y = float(fov);
            out.near = float(std::clamp(perspective.number_or("znear", 0.0), 0.0, 1e15));
        } else if (type == "orthographic") {
            const Value orthographic = camera.at("orthographic");
            const double half = std::abs(orthographic.at("ymag").number());
            if (!(half > 0 && half < 1e15)) camera.bad("has a ymag of {}", half);
            out.half_height = float(half);
            out.near = float(std::clamp(orthographic.number_or("znear", 0.0), 0.0, 1e15));
        } else {
            camera.bad("has the unknown type '{}'", printable(type));
        }
        scene.cameras.push_back(std::move(out));
    });
}

} // namespace gnomon::scene::gltf
