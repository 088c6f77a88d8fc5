// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

struct LoadOptions {
    double time = 0.0; ///< seconds; animations and skins are sampled here; each animation repeats after its last key
    double detail = 1.0; ///< built-in scenes: multiplies their triangle count
    int gltf_scene = -1; ///< which scene of a glTF file; -1 = its default
};

/// A scene by name or file: a built-in's name ("citadel"), a .glb or .gltf, or one of Gnomon's own scene .json files.
/// Throws Error naming file, element and cause; what could be repaired is in Scene::warnings.
Scene load(const std::string& name_or_file, const LoadOptions& = {});

/// glTF 2.0. Accepts KHR_mesh_quantization, EXT_meshopt_compression, EXT_mesh_gpu_instancing, KHR_texture_transform,
/// KHR_materials_transmission, KHR_materials_volume, KHR_materials_emissive_strength, KHR_materials_unlit (as diffuse),
/// KHR_materials_pbrSpecularGlossiness (its diffuse part), KHR_lights_punctual. Positions of skinned meshes come out in world space.
Scene load_gltf(const std::filesystem::path&, const LoadOptions& = {});

/// Gnomon's scene file: docs/scene-files.md.
Scene load_scene_json(const std::filesystem::path&, const LoadOptions& = {});
/// The same form back: model, options that differ from their defaults, cameras, lights.
std::string scene_json_text(const Scene&, std::string_view model, const LoadOptions& = {});

/// A list of scenes with file, cameras and lights (an object with an array "scenes") as one scene file each: pairs of name and text.
/// `model_folder` is put before each model's file name, as seen from where the texts will be written. Throws Error.
std::vector<std::pair<std::string, std::string>> convert_scene_list(const std::filesystem::path&, const std::string& model_folder);

/// A built-in procedural scene.
struct Builtin {
    std::string_view name, help; ///< one sentence: what it tests
    bool analytic; ///< has a closed form (scene/analytic.h)
    bool opaque; ///< no mask and no blend materials
    Scene (*make)(double detail);
};
const std::vector<Builtin>& builtins();

} // namespace gnomon::scene
