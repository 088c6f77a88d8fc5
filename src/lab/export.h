// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "lab/render.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// A technique's shaders in another language, and what a host has to do around them, for engines that want no library. What the host
// has to do is read from a pass list that the technique records for a scene and a light: there is no text for any one technique.
namespace gnomon::lab {

enum class Language { glsl, hlsl, msl, spirv };
Language parse_language(const std::string&); ///< throws base::Error with the names
std::string_view language_name(Language);

struct Exported {
    std::vector<std::pair<std::string, std::string>> files; ///< path inside of the folder, content
    std::vector<std::pair<std::string, std::string>> refused; ///< shaders that the language cannot say, and why
};

/// The stage's first light decides. Throws base::Error where the technique refuses device or light.
Exported export_technique(gpu::Device&, const Stage&, const Choice&, Language);

/// All files or none: they are written beside `folder` and renamed. It may be absent, empty or an earlier export, which is replaced;
/// throws base::Error where it holds anything else or cannot be written.
void write_export(const Exported&, const std::filesystem::path& folder);

} // namespace gnomon::lab
