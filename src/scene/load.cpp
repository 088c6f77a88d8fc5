// SPDX-License-Identifier: Apache-2.0
#include "scene/load.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

// At the top of the range citadel has 18.6 million triangles and takes 580 MB.
constexpr double least_detail = 0.05, most_detail = 256.0;

std::string extension_of(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

} // namespace

Scene load(const std::string& name_or_file, const LoadOptions& options)
{
    if (!std::isfinite(options.time)) base::fail("the time to load '{}' at is not finite; give seconds", name_or_file);
    if (!(options.detail >= least_detail && options.detail <= most_detail))
        base::fail("detail is {}, outside its range {} to {}", options.detail, least_detail, most_detail);
    for (const Builtin& b : builtins())
        if (b.name == name_or_file) return b.make(options.detail);

    const std::string extension = extension_of(name_or_file);
    if (extension == ".glb" || extension == ".gltf") return load_gltf(name_or_file, options);
    if (extension == ".json") return load_scene_json(name_or_file, options);
    std::error_code ignored;
    if (std::filesystem::exists(name_or_file, ignored))
        base::fail("'{}' is no scene file; scenes are .glb, .gltf or Gnomon's own .json", name_or_file);
    std::vector<std::string> names;
    for (const Builtin& b : builtins()) names.emplace_back(b.name);
    throw base::Error(base::unknown_name("scene", name_or_file, names));
}

} // namespace gnomon::scene
