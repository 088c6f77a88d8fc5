// SPDX-License-Identifier: Apache-2.0
// Broken input ends in an Error or a warning: never in a crash, a hang or memory without bound.
#include "fuzz/sound.h"
#include "gltf_builder.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>

namespace gnomon::scene {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

fs::path shared_scenes()
{
    const char* given = std::getenv("GNOMON_SHARED");
    return (given ? fs::path(given) : fs::path(GNOMON_SOURCE) / "../shared") / "scenes";
}

std::vector<fs::path> gltf_files(const fs::path& folder)
{
    std::vector<fs::path> out;
    if (!fs::is_directory(folder)) return out;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") out.push_back(entry.path());
    std::ranges::sort(out);
    return out;
}

void expect_sound(const Scene& scene, const std::string& what) { EXPECT_EQ(unsound(scene), "") << what; }

/// Loads; an Error must name the file in one line. Whether there is a scene.
bool loads_or_explains(const fs::path& file, const LoadOptions& options = {})
{
    try {
        expect_sound(load_gltf(file, options), file.string());
        return true;
    } catch (const base::Error& e) {
        const std::string text = e.what();
        EXPECT_NE(text.find(file.filename().string()), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return false;
    }
}

TEST(gltf_robustness, malformed_files)
{
    const std::vector<fs::path> files = gltf_files(shared_scenes() / "malformed");
    if (files.empty()) GTEST_SKIP() << "no shared test scenes at " << shared_scenes();
    EXPECT_EQ(files.size(), 48u);
    size_t loaded = 0;
    for (const fs::path& file : files) loaded += loads_or_explains(file);
    EXPECT_LE(loaded, 2u) << "only the two assimp files that place sound triangles beside their faults";
}

TEST(gltf_robustness, malformed_files_with_everything_in_use)
{
    // Most of those files hold an element that nothing refers to. A node for each mesh, and materials for their primitives, make
    // the loader look at them.
    const fs::path folder = shared_scenes() / "malformed";
    if (gltf_files(folder).empty()) GTEST_SKIP() << "no shared test scenes at " << shared_scenes();
    TemporaryFolder copy;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) base::write_file(copy / entry.path().filename().string(), base::read_file(entry.path()));
    size_t changed = 0;
    for (const fs::path& file : gltf_files(copy / "")) {
        json doc = json::parse(base::read_text(file), nullptr, false);
        if (!doc.is_object()) continue;
        for (const char* unused : {"scene", "scenes"}) doc.erase(unused);
        if (doc.contains("materials") && !doc.contains("meshes"))
            doc["meshes"] = {{{"primitives", {{{"material", 0}, {"attributes", {{"POSITION", 0}}}}}}}};
        if (!doc.contains("nodes") && doc.contains("accessors") && !doc.contains("meshes"))
            doc["meshes"] = {{{"primitives", {{{"indices", 0}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}};
        for (size_t i = 0; doc.contains("meshes") && i < doc["meshes"].size(); ++i) doc["nodes"].push_back({{"mesh", i}});
        base::write_text(file, doc.dump());
        loads_or_explains(file);
        ++changed;
    }
    EXPECT_GT(changed, 30u);
}

TEST(gltf_robustness, odd_but_valid_files)
{
    const std::vector<fs::path> files = gltf_files(shared_scenes() / "malformed/valid");
    if (files.empty()) GTEST_SKIP() << "no shared test scenes at " << shared_scenes();
    for (const fs::path& file : files) {
        try {
            expect_sound(load_gltf(file, {.time = 0.5}), file.string());
        } catch (const base::Error& e) {
            EXPECT_NE(std::string(e.what()).find("holds no triangles to draw"), std::string::npos) << e.what();
        }
    }
}

TEST(gltf_robustness, shared_scenes_have_their_triangles)
{
    const fs::path folder = shared_scenes();
    if (!fs::exists(folder / "scenes.json")) GTEST_SKIP() << "no shared test scenes at " << folder;
    const json list = json::parse(base::read_text(folder / "scenes.json"));
    ASSERT_EQ(list["scenes"].size(), 10u);
    for (const json& entry : list["scenes"]) {
        const fs::path file = folder / entry["file"].get<std::string>();
        const Scene scene = load_gltf(file);
        expect_sound(scene, file.string());
        EXPECT_EQ(scene.triangle_count(), entry["triangles"].get<size_t>()) << file;
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
        size_t masks = 0, blends = 0;
        for (const Material& m : scene.materials) masks += m.alpha == AlphaMode::mask, blends += m.alpha == AlphaMode::blend;
        EXPECT_EQ(masks, entry["mask_materials"].size()) << file;
        EXPECT_EQ(blends, entry["blend_materials"].size()) << file;
        // The stated box is the tight one at rest; Scene::bounds may be wider by turned boxes, and a walker moves.
        if (entry["skinned"].get<bool>()) continue;
        const auto corner = [&](size_t k) {
            return vec3(entry["bounds"][k][0].get<float>(), entry["bounds"][k][1].get<float>(), entry["bounds"][k][2].get<float>());
        };
        const Bounds box = scene.bounds();
        const float tolerance = 1e-3f * box.radius();
        EXPECT_TRUE(
            glm::all(glm::lessThanEqual(box.min, corner(0) + tolerance)) && glm::all(glm::greaterThanEqual(box.max, corner(1) - tolerance)))
            << file;
        EXPECT_LT(box.radius(), glm::length(corner(1) - corner(0)) * 0.55f) << file;
    }
}

TEST(gltf_robustness, a_walk_moves_and_stays_whole)
{
    const fs::path file = shared_scenes() / "cesium_man.glb";
    if (!fs::exists(file)) GTEST_SKIP() << "no shared test scenes at " << shared_scenes();
    std::vector<vec3> feet;
    for (const double time : {0.0, 0.5, 1.0, 2.0}) {
        const Scene scene = load_gltf(file, {.time = time});
        expect_sound(scene, "cesium_man");
        const Mesh& man = scene.meshes[0].triangle_count() > scene.meshes[1].triangle_count() ? scene.meshes[0] : scene.meshes[1];
        EXPECT_NEAR(man.bounds.max.y, 1.5f, 0.1f) << "stands upright";
        EXPECT_NEAR(man.bounds.min.y, 0.0f, 0.1f) << "on the ground";
        feet.push_back(man.positions[0]);
    }
    EXPECT_GT(glm::length(feet[0] - feet[1]), 1e-3f);
    expect_near(feet[0], feet[3], 1e-5f); // the animation lasts 2 s and repeats
}

/// Without the care for power cuts that base::write_text takes, thousands of times.
void write_quickly(const fs::path& file, std::string_view text)
{
    fs::remove(file); // some file systems flush a file that is cut and written anew
    std::ofstream(file, std::ios::binary) << text;
}

/// A small document that uses most of what the loader knows.
GltfBuilder rich()
{
    GltfBuilder b;
    const int position = b.vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), normal = b.vec3s(std::vector<vec3>(4, vec3(0, 0, 1)));
    const int uv = b.vec2s({{0, 0}, {1, 0}, {0, 1}, {1, 1}}), target = b.vec3s(std::vector<vec3>(4, vec3(0, 0, 0.5f)));
    const int color = b.accessor(b.view(std::vector<uint32_t>(4, 0xff8040ffu)), "VEC4", 5121, 4, true);
    const int joint = b.accessor(b.view(std::vector<uint8_t>(16, 0)), "VEC4", 5121, 4),
              weight = b.vec4s(std::vector<vec4>(4, vec4(1, 0, 0, 0)));
    const int index = b.accessor(b.view(std::vector<uint16_t>{0, 1, 2, 3}), "SCALAR", 5123, 4);
    b.mesh({{"mode", 5}, {"indices", index}, {"material", 0}, {"targets", {{{"POSITION", target}}}},
        {"attributes",
            {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}, {"COLOR_0", color}, {"JOINTS_0", joint},
                {"WEIGHTS_0", weight}}}});
    b.push("materials", {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.push("images",
        {{"uri",
            "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg=="}});
    b.push("textures", {{"source", 0}});
    b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.4}}}}};
    b.node({{"mesh", 0}, {"children", {1, 2}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.push("nodes", {{"mesh", 0}, {"skin", 0}});
    const int places = b.vec3s({{1, 0, 0}, {0, 0, 2}});
    b.push("nodes",
        {{"mesh", 0}, {"scale", {-1, 1, 1}}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    b.push("skins", {{"joints", {0}}});
    const int input = b.scalars({0, 1}), output = b.vec3s({{0, 0, 0}, {0, 1, 0}});
    b.push("animations",
        {{"samplers", {{{"input", input}, {"output", output}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    return b;
}

TEST(gltf_robustness, both_containers_agree)
{
    TemporaryFolder folder;
    write_quickly(folder / "a.gltf", rich().gltf_text());
    write_quickly(folder / "a.glb", rich().glb_text() + "bytes after the declared length");
    const Scene text = load_gltf(folder / "a.gltf", {.time = 0.5}), binary = load_gltf(folder / "a.glb", {.time = 0.5});
    EXPECT_EQ(text.triangle_count(), 8u);
    EXPECT_TRUE(text.warnings.empty()) << text.warnings.front();
    EXPECT_EQ(binary.triangle_count(), 8u);
    EXPECT_EQ(binary.bounds().min, text.bounds().min);
    EXPECT_EQ(binary.bounds().max, text.bounds().max);
}

TEST(gltf_robustness, truncated_files)
{
    TemporaryFolder folder;
    for (const bool binary : {true, false}) {
        const std::string whole = binary ? rich().glb_text() : rich().gltf_text();
        const fs::path file = folder / (binary ? "cut.glb" : "cut.gltf");
        for (size_t i = 0; i < 64; ++i) {
            write_quickly(file, std::string_view(whole).substr(0, whole.size() * i / 64));
            EXPECT_FALSE(loads_or_explains(file)) << i;
        }
    }
}

TEST(gltf_robustness, changed_bytes)
{
    TemporaryFolder folder;
    std::mt19937 random(20260101);
    const auto begin = std::chrono::steady_clock::now();
    size_t loaded = 0;
    for (const bool binary : {true, false}) {
        const std::string whole = binary ? rich().glb_text() : rich().gltf_text();
        const fs::path file = folder / (binary ? "changed.glb" : "changed.gltf");
        for (int i = 0; i < 1000; ++i) {
            std::string text = whole;
            for (uint32_t n = random() % 3 + 1; n > 0; --n) {
                char& c = text[random() % text.size()];
                // Digits for digits change indices, counts and offsets and leave the JSON whole; so do bytes of the binary chunk.
                c = c >= '0' && c <= '9' ? char('0' + random() % 10) : char(random() % 256);
            }
            write_quickly(file, text);
            loaded += loads_or_explains(file, {.time = 0.5});
        }
    }
    EXPECT_GT(loaded, 100u) << "changes that reach the data must be among them";
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(120));
}

TEST(gltf_robustness, changed_numbers)
{
    TemporaryFolder folder;
    const fs::path file = folder / "numbers.gltf";
    const std::vector<json> strange{
        -1, 0.5, 3, 255, 65536, 4294967295.0, 9007199254740992.0, -1e300, "text", nullptr, json::array(), json::object(), true};
    const json whole = json::parse(rich().gltf_text());
    const json flat = whole.flatten();
    size_t number = 0;
    for (const auto& [pointer, old] : flat.items()) {
        json changed = whole;
        for (size_t k = 0; k < 3; ++k) { // each value meets a few of them, all of them meet many values
            changed[json::json_pointer(pointer)] = strange[(number * 3 + k) % strange.size()];
            write_quickly(file, changed.dump());
            loads_or_explains(file, {.time = 0.5});
        }
        ++number;
    }
    EXPECT_GT(number, 100u);
}

TEST(gltf_robustness, places_for_nothing_cost_nothing)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const int broken = b.mesh({{"attributes", {{"POSITION", 99}}}});
    const json places = {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", b.vec3s(std::vector<vec3>(200000))}}}}}};
    for (int i = 0; i < 2000; ++i) b.node({{"mesh", broken}, {"extensions", places}});
    EXPECT_EQ(b.load().instances.size(), 1u) << "and not after four hundred million matrices";
}

TEST(gltf_robustness, elements_without_data_are_counted_together)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const size_t most = size_t(1) << 24;
    json& accessor = b.doc["accessors"][size_t(
        b.push("accessors", {{"type", "VEC3"}, {"componentType", 5126}, {"count", most / 8}, {"sparse", json()}}))];
    accessor["sparse"] = {{"count", 1}, {"indices", {{"bufferView", b.view<uint32_t>({0})}, {"componentType", 5125}}},
        {"values", {{"bufferView", b.view<float>({1, 2, 3})}}}};
    const json primitive = {{"attributes", {{"POSITION", 1}}}};
    b.node({{"mesh", b.push("meshes", {{"primitives", json(1000, primitive)}})}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.meshes.size(), 1u + 2u) << "three eighths of the most are read twice, not a thousand times";
    EXPECT_TRUE(any_contains(scene.warnings, "without a buffer view"));
}

} // namespace
} // namespace gnomon::scene
