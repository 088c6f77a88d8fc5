// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/json_reader.h"

#include <filesystem>

namespace gnomon::scene {

double animation_seconds(const std::string& name_or_file)
{
    const std::filesystem::path path(name_or_file);
    if (path.extension() == ".json") {
        const nlohmann::json json = read_json(path);
        const std::filesystem::path model = JsonReader(json, path.string()).at("model").text();
        return model.extension() == ".json"
            ? 0.0
            : animation_seconds(model.has_extension() ? (path.parent_path() / model).string() : model.string());
    }
    if (!path.has_extension()) return 0; // a built-in scene
    gltf::Document document(path);
    return gltf::animation_seconds(document);
}

} // namespace gnomon::scene
