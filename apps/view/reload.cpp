// SPDX-License-Identifier: Apache-2.0
#include "reload.h"

#include "base/error.h"
#include "base/file.h"
#include "gpu/program.h"
#include "lab/folder.h"
#include "text.h"

#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace gnomon::view {

namespace fs = std::filesystem;

namespace {

void collect(const fs::path& root, const fs::path& file, std::set<fs::path>& found)
{
    std::error_code none;
    if (!fs::exists(file, none) || !found.insert(file).second) return;
    const std::string text = base::read_text(file);
    constexpr std::string_view word = "#include \"";
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const size_t begin = at + word.size(), end = text.find('"', begin);
        const std::string name = text.substr(begin, end - begin);
        for (const fs::path& folder : {file.parent_path(), root}) collect(root, (folder / name).lexically_normal(), found);
    }
}

/// What the program printed, on both of its outputs; its exit code in `code`.
std::string run(const std::string& command, int& code)
{
    std::string out;
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (!pipe) base::fail("glslc cannot be started ({}); free some memory or processes", std::strerror(errno));
    char buffer[4096];
    for (size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
    code = ::pclose(pipe);
    return out;
}

std::vector<uint32_t> compile(const fs::path& root, const fs::path& file)
{
    const std::string stage = file.stem().extension().string().substr(1);
    const fs::path target = fs::temp_directory_path() / fmt::format("gnomon-{}.spv", ::getpid());
    int code = 0;
    // As cmake/shaders.cmake does.
    const std::string said = run(fmt::format("glslc -O -g --target-env=vulkan1.3 -fshader-stage={} -Werror -I {} -o {} {}", stage,
                                     shell_word(root.string()), shell_word(target.string()), shell_word(file.string())),
        code);
    if (code != 0) {
        const std::string first = said.substr(0, said.find('\n'));
        base::fail("{}; the shaders stay as they were", first.empty() ? "glslc failed" : first);
    }
    const std::vector<std::byte> bytes = base::read_file(target, 1 << 28);
    std::error_code none;
    fs::remove(target, none);
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

fs::file_time_type built()
{
    std::error_code none;
    const fs::file_time_type time = fs::last_write_time("/proc/self/exe", none);
    return none ? fs::file_time_type::clock::now() : time;
}

} // namespace

std::set<fs::path> included_files(const fs::path& root, const fs::path& file)
{
    std::set<fs::path> found;
    collect(root, file, found);
    return found;
}

ShaderSources::ShaderSources()
    : since_(built())
    , seen_(since_)
{
}

std::vector<CompiledShader> ShaderSources::compile_changed()
{
    const fs::path root = lab::project_root();
    int code = 0;
    run("glslc --version", code);
    if (code != 0) base::fail("shaders cannot be recompiled: glslc is not there (Debian: apt-get install glslc)");
    seen_ = fs::file_time_type::clock::now();
    std::vector<CompiledShader> out;
    for (const gpu::ShaderSource& shader : gpu::embedded_shaders()) {
        const std::string name(shader.name);
        if (name.starts_with("tests/")) continue;
        const fs::path file = root / (name + ".glsl");
        bool changed = false;
        for (const fs::path& part : included_files(root, file)) changed |= fs::last_write_time(part) > since_;
        if (changed) out.push_back({name, compile(root, file)});
    }
    return out;
}

} // namespace gnomon::view
