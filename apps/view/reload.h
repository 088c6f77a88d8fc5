// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace gnomon::view {

struct CompiledShader {
    std::string name; ///< as in the table of embedded shaders
    std::vector<uint32_t> spirv;
};

/// The GLSL of a source tree, for shaders that are edited while the window is open.
class ShaderSources {
public:
    ShaderSources();
    /// Compiles, by glslc, every entry point that was changed, or that includes what was, since the program was built or the last `taken`.
    /// Throws base::Error with the reason where there is no source tree or no glslc, or with the compiler's first complaint.
    std::vector<CompiledShader> compile_changed();
    void taken() { since_ = seen_; } ///< what was compiled last is in use

private:
    std::filesystem::file_time_type since_, seen_;
};

/// The files that `file` includes, directly or not, and itself: those with quotes, as glslc finds them in `root`.
std::set<std::filesystem::path> included_files(const std::filesystem::path& root, const std::filesystem::path& file);

} // namespace gnomon::view
