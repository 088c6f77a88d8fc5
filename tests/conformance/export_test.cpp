// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/temporary_folder.h"
#include "gpu/reflect.h"
#include "lab/export.h"
#include "tests/gpu/device_fixture.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <set>
#include <sys/wait.h>

// The registry, exported to every language: each file compiles where a compiler of the language is at hand, says what the README says,
// and draws the same bits where it can be put back.
namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr Language languages[] = {Language::glsl, Language::hlsl, Language::msl, Language::spirv};

bool has_program(const char* name) { return std::system(fmt::format("command -v {} >/dev/null 2>&1", name).c_str()) == 0; }

/// Runs a shell command; its output where it fails, else "".
std::string run(const std::string& command, const fs::path& folder)
{
    const fs::path log = folder / "log.txt";
    const int status = std::system(fmt::format("({}) >'{}' 2>&1", command, log.string()).c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    const std::string text = base::read_text(log);
    return text.empty() ? "failed without a word" : text;
}

class Export : public gpu::DeviceTest {
protected:
    static Stage stage_for(const shadow::TechniqueInfo& info, base::Size size, const char* scene = "fence")
    {
        int kind = 0;
        while (!(info.lights & (1u << kind))) ++kind;
        return open_stage({.scene = scene, .lights = {std::string(scene::kind_name(scene::LightKind(kind)))}, .size = size});
    }
    static Exported exported(const shadow::TechniqueInfo& info, Language language)
    {
        return export_technique(device(), stage_for(info, {320, 180}), default_choice(info), language);
    }
    static bool available(const shadow::TechniqueInfo& info) { return !info.unavailable || info.unavailable(device()).empty(); }
};

const std::string& content(const Exported& e, const std::string& file)
{
    for (const auto& [name, text] : e.files)
        if (name == file) return text;
    static const std::string none;
    ADD_FAILURE() << "the export has no " << file;
    return none;
}

/// "t3, space0" and the like, as the language writes it.
std::string declaration(Language language, const Json& r)
{
    const std::string place = r["place"];
    if (language == Language::glsl) return fmt::format("set = {}, binding = {}", r["set"].get<int>(), r["binding"].get<int>());
    if (language == Language::hlsl) return fmt::format("register({}, space{})", place.substr(0, place.find(',')), r["set"].get<int>());
    return "[[" + place.substr(0, place.find(')') + 1) + "]]";
}

void check_resources(Language language, const Exported& e, const Json& recipe)
{
    for (const auto& [stem, shader] : recipe["shaders"].items()) {
        if (!shader.contains("file") || language == Language::spirv) continue;
        const std::string& text = content(e, shader["file"]);
        for (const Json& r : shader["resources"])
            EXPECT_NE(text.find(declaration(language, r)), std::string::npos)
                << shader["file"] << " does not declare " << r["name"] << " as " << declaration(language, r);
    }
}

/// What the passes bind is what their shaders declare, both ways.
void check_bindings(const Json& recipe)
{
    for (const Json& pass : recipe["passes"]) {
        std::set<int> bound, declared;
        for (const Json& b : pass.value("bindings", Json::array()))
            if (!b.contains("unused")) bound.insert(b["binding"].get<int>());
        for (const Json& program : pass.value("programs", Json::array()))
            for (const Json& stem : program["shaders"])
                for (const Json& r : recipe["shaders"].at(stem.get<std::string>())["resources"]) {
                    if (r["set"] == 0) declared.insert(r["binding"].get<int>());
                    EXPECT_TRUE(r["set"] != 1 || pass["constants"]["bytes"] == r["bytes"]) << pass["name"];
                    EXPECT_TRUE(r["set"] != 2 || pass.contains("textures")) << pass["name"];
                }
        EXPECT_EQ(bound, declared) << pass["name"];
        EXPECT_TRUE(!pass.contains("constants") || pass["constants"].contains("values")) << pass["name"];
    }
}

void check_refused(Language language, const Exported& e)
{
    const auto ray_stage
        = [](const std::string& stem) { return stem.ends_with(".rgen") || stem.ends_with(".rmiss") || stem.ends_with("hit"); };
    for (const auto& [stem, why] : e.refused) {
        EXPECT_TRUE(ray_stage(stem) && (language == Language::hlsl || language == Language::msl)) << stem << ": " << why;
        EXPECT_NE(content(e, "README.md").find(why), std::string::npos) << "the README does not say why " << stem << " is missing";
    }
}

void check_readme(const Exported& e, const Json& recipe)
{
    const std::string& text = content(e, "README.md");
    for (const auto& [name, image] : recipe["images"].items()) EXPECT_NE(text.find(name), std::string::npos) << name;
    for (const auto& [name, buffer] : recipe["buffers"].items()) EXPECT_NE(text.find(name), std::string::npos) << name;
    for (const Json& pass : recipe["passes"])
        EXPECT_NE(text.find(fmt::format("### {}. {}", pass["number"].get<int>(), pass["name"].get<std::string>())), std::string::npos);
}

/// Compiles one file, in a shell script over many: prints a line only where it fails. glslang's HLSL knows neither ray queries, which
/// are left out, nor NonUniformResourceIndex, which is nothing but a hint.
const char* const compile_script = R"(
stage=$(echo "$1" | sed -E 's/.*\.(vert|frag|comp|rgen|rmiss|rchit|rahit)\..*/\1/')
case $1 in
*.glsl) out=$(glslc --target-env=vulkan1.3 -fshader-stage=$stage -Werror -o "$1.out" "$1" 2>&1) ;;
*.hlsl) grep -q 'RayQuery<' "$1" && exit
    out=$(glslangValidator -D -S $stage -V --target-env vulkan1.1 -e main --define-macro 'NonUniformResourceIndex(x)=(x)' -o "$1.out" "$1" 2>&1) ;;
*.spv) out=$(spirv-val --target-env vulkan1.3 --scalar-block-layout "$1" 2>&1) ;;
esac || printf '%s\n%s\n' "$1" "$out" | head -n 8
)";

/// Files of all exports in one folder, each content once: techniques share shaders.
class Collection {
public:
    void add(const std::string& id, Language language, const Exported& e, const Json& recipe)
    {
        for (const auto& [stem, shader] : recipe["shaders"].items()) {
            if (!shader.contains("file") || !contents_.insert(content(e, shader["file"])).second) continue;
            const fs::path file = folder_.path() / id / shader["file"].get<std::string>();
            base::write_text(file, content(e, shader["file"]));
            if (language != Language::msl) list_ += file.string() + "\n"; // no compiler of Metal's is packaged
            ++of_language_[size_t(language)];
        }
        if (language != Language::glsl) return;
        base::write_text(folder_.path() / id / "layouts.h", content(e, "layouts.h"));
        headers_ += fmt::format("namespace {0} {{\n#include \"{0}/layouts.h\"\n}}\n", id);
    }
    void compile()
    {
        for (const size_t count : of_language_) EXPECT_GT(count, 50u);
        base::write_text(folder_.path() / "compile.sh", compile_script);
        base::write_text(folder_.path() / "list.txt", list_);
        base::write_text(folder_.path() / "headers.cpp", headers_);
        const std::string at = "cd '" + folder_.path().string() + "' && ";
        EXPECT_EQ(run(at + "xargs -P 4 -n 1 sh compile.sh <list.txt >errors.txt 2>&1", folder_.path()), "");
        EXPECT_EQ(base::read_text(folder_.path() / "errors.txt"), "");
        if (has_program("c++")) {
            EXPECT_EQ(run(at + "c++ -std=c++17 -Wall -fsyntax-only headers.cpp", folder_.path()), "");
        }
    }

private:
    const base::TemporaryFolder folder_;
    std::set<std::string> contents_;
    std::string headers_ = "#include <cstddef>\n#include <cstdint>\n", list_;
    size_t of_language_[4] = {};
};

TEST_F(Export, EveryTechniqueSaysWhatItsShadersSayAndCompiles)
{
    Collection all;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        for (const Language language : languages) {
            if (!available(*info)) continue;
            SCOPED_TRACE(std::string(info->id) + " " + std::string(language_name(language)));
            const Exported e = exported(*info, language);
            const Json recipe = Json::parse(content(e, "passes.json"));
            ASSERT_FALSE(recipe["passes"].empty());
            EXPECT_EQ(recipe["images"][recipe["technique"]["output"].get<std::string>()]["origin"], "output");
            check_resources(language, e, recipe);
            check_bindings(recipe);
            check_refused(language, e);
            check_readme(e, recipe);
            all.add(std::string(info->id), language, e, recipe);
        }
    for (const char* program : {"glslc", "glslangValidator", "spirv-val", "xargs"})
        if (!has_program(program)) GTEST_SKIP() << program << " is not installed; what the exports say was checked";
    all.compile();
}

std::string stage_of(const std::string& stem) { return stem.substr(stem.rfind('.') + 1); }

TEST_F(Export, GlslAndSpirvDrawTheSameBits)
{
    if (!has_program("glslc")) GTEST_SKIP() << "glslc is not installed";
    const base::TemporaryFolder folder;
    for (const char* id : {"shadow_map", "pcf", "pcss", "vsm", "shadow_volumes", "virtual_shadow_map"}) {
        const shadow::TechniqueInfo& info = shadow::technique(id);
        const Stage stage = stage_for(info, {160, 90}, "contact");
        const Choice choice = default_choice(info);
        const auto draw = [&] {
            shadow::SceneGpu scene(device(), stage.scene);
            return render(device(), scene, stage, choice, {.lit = false}).images.front().values;
        };
        const std::vector<float> original = draw();
        std::vector<std::string> replaced;
        for (const Language language : {Language::glsl, Language::spirv}) {
            const Exported e = export_technique(device(), stage, choice, language);
            const Json recipe = Json::parse(content(e, "passes.json"));
            for (const auto& [stem, shader] : recipe["shaders"].items()) {
                const fs::path file = folder.path() / shader["file"].get<std::string>(), words = file.string() + ".words";
                base::write_text(file, content(e, shader["file"]));
                if (language == Language::glsl) {
                    ASSERT_EQ(run(fmt::format("glslc -O --target-env=vulkan1.3 -fshader-stage={} -o '{}' '{}'", stage_of(stem),
                                      words.string(), file.string()),
                                  folder.path()),
                        "");
                }
                const std::vector<std::byte> bytes = base::read_file(language == Language::glsl ? words : file);
                std::vector<uint32_t> spirv(bytes.size() / 4);
                std::memcpy(spirv.data(), bytes.data(), bytes.size());
                device().replace_shader(shader["shader"].get<std::string>(), spirv);
                replaced.push_back(shader["shader"]);
            }
            EXPECT_TRUE(draw() == original) << id << " by its exported " << language_name(language);
            for (const std::string& name : replaced) {
                const auto own = gpu::find_shader(name).spirv;
                device().replace_shader(name, {own.begin(), own.end()});
            }
        }
    }
}

TEST_F(Export, ParametersAndLightsChangeWhatIsSaid)
{
    const shadow::TechniqueInfo& info = shadow::technique("shadow_map");
    const auto recipe = [&](const char* light, const char* choice) {
        const Stage stage = open_stage({.scene = "contact", .lights = {light}, .size = {320, 180}});
        return Json::parse(content(export_technique(device(), stage, parse_choice(choice), Language::glsl), "passes.json"));
    };
    const Json sun = recipe("directional", "shadow_map:map_size=512"), point = recipe("point", "shadow_map:map_size=256:pcf=5");
    EXPECT_EQ(sun["images"]["light map"]["size"], Json({512, 512}));
    EXPECT_EQ(sun["images"]["light map"]["layers"], 1);
    EXPECT_EQ(point["images"]["light map"]["layers"], 6);
    EXPECT_EQ(point["light"], "point");
    for (const Json& c : point["shaders"]["shadow_map_resolve.frag"]["specialization"]) EXPECT_TRUE(c["name"] != "pcf" || c["bits"] == 5);
    EXPECT_EQ(point["passes"].back()["constants"]["values"]["c"]["params"]["map_size"], 256);
    const Stage disk = open_stage({.scene = "contact", .lights = {"disk"}, .size = {320, 180}});
    EXPECT_THROW(export_technique(device(), disk, default_choice(info), Language::glsl), base::Error);
}

TEST_F(Export, WhatTheLanguageCannotSayIsNamed)
{
    const auto without = gpu::Device::open({"", true, {"VK_KHR_ray_query"}});
    const shadow::TechniqueInfo& info = shadow::technique("ray_traced");
    if (info.unavailable && !info.unavailable(*without).empty()) GTEST_SKIP() << info.unavailable(*without);
    for (const Language language : languages) {
        const Exported e = export_technique(*without, stage_for(info, {320, 180}), default_choice(info), language);
        const bool refuses = language == Language::hlsl || language == Language::msl;
        EXPECT_EQ(!e.refused.empty(), refuses) << language_name(language);
        check_refused(language, e);
        const Json recipe = Json::parse(content(e, "passes.json"));
        EXPECT_EQ(recipe["passes"].front()["kind"], "rays");
    }
}

TEST_F(Export, ContentThatBelongsToTheTechniqueIsExported)
{
    const Exported e = exported(shadow::technique("back_projection"), Language::glsl);
    const Json recipe = Json::parse(content(e, "passes.json"));
    size_t files = 0;
    for (const auto& [name, buffer] : recipe["buffers"].items())
        if (buffer.contains("data")) {
            EXPECT_EQ(content(e, buffer["data"]).size(), buffer["bytes"].get<size_t>()) << name;
            ++files;
        }
    EXPECT_GT(files, 0u) << "its light samples are the same in every scene";
}

} // namespace
} // namespace gnomon::lab
