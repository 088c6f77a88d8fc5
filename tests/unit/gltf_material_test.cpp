// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include "base/image_file.h"

namespace gnomon::scene {
namespace {

using json = nlohmann::json;

/// A 2 x 2 PNG: red, green above blue, white.
std::vector<std::byte> small_png()
{
    TemporaryFolder folder;
    base::Picture picture({2, 2}, 3);
    picture.values = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    base::write_png(folder / "small.png", picture, base::Encoding::linear);
    return base::read_file(folder / "small.png");
}

/// One triangle with texture coordinates and material 0.
GltfBuilder with_material(json material)
{
    GltfBuilder b;
    const int uv = b.vec2s({{0, 0}, {1, 0}, {0, 1}});
    b.triangle({{"material", 0}, {"attributes", {{"TEXCOORD_0", uv}}}});
    b.node({{"mesh", 0}});
    b.push("materials", std::move(material));
    const int image = b.push("images", {{"bufferView", b.view(small_png())}, {"mimeType", "image/png"}, {"name", "four"}});
    b.push("samplers", {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}});
    b.push("textures", {{"source", image}, {"sampler", 0}});
    return b;
}

TEST(gltf_material, factors)
{
    const Scene scene = with_material({{"name", "brass"}, {"doubleSided", true}, {"emissiveFactor", {0.5, 0.25, 0}},
                                          {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"roughnessFactor", 0.25}}},
                                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}})
                            .load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.name, "brass");
    EXPECT_EQ(m.base_color, vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 0.25f);
    expect_near(m.emissive, {4, 2, 0});
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.alpha, AlphaMode::opaque);
    EXPECT_TRUE(scene.textures.empty());
}

TEST(gltf_material, alpha_modes)
{
    EXPECT_EQ(with_material({{"alphaMode", "BLEND"}}).load().materials[0].alpha, AlphaMode::blend);
    const Material mask = with_material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}}).load().materials[0];
    EXPECT_EQ(mask.alpha, AlphaMode::mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.75f);
}

TEST(gltf_material, texture_with_sampler)
{
    const Scene scene
        = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
                            {"emissiveTexture", {{"index", 0}}}})
              .load();
    const Material& m = scene.materials.at(0);
    ASSERT_EQ(scene.textures.size(), 2u) << "once as colour, once as data";
    EXPECT_EQ(m.base_color_texture.texture, m.emissive_texture.texture);
    const Texture& color = scene.textures[size_t(m.base_color_texture.texture)];
    EXPECT_TRUE(color.srgb);
    EXPECT_FALSE(scene.textures[size_t(m.metallic_roughness_texture.texture)].srgb);
    EXPECT_FALSE(color.linear);
    EXPECT_EQ(color.wrap_u, Wrap::clamp);
    EXPECT_EQ(color.wrap_v, Wrap::mirror);
    EXPECT_EQ(color.name, "four");
    EXPECT_EQ(color.width, 2);
    EXPECT_EQ(color.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}));
    EXPECT_EQ(scene.meshes[0].uvs.size(), 3u);
}

TEST(gltf_material, texture_transform)
{
    // The example of the extension's text: the lower left quadrant of the picture, turned clockwise by 90 degrees.
    const Scene scene = with_material(
        {{"pbrMetallicRoughness",
            {{"baseColorTexture",
                {{"index", 0},
                    {"extensions",
                        {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}}}}}}}})
                            .load();
    const TextureUse& use = scene.materials[0].base_color_texture;
    const auto at = [&](float u, float v) { return vec3(glm::dot(use.u_row, vec3(u, v, 1)), glm::dot(use.v_row, vec3(u, v, 1)), 0); };
    expect_near(at(0, 0), {0, 1, 0});
    expect_near(at(1, 0), {0, 0.5f, 0});
    expect_near(at(0, 1), {0.5f, 1, 0});
}

TEST(gltf_material, one_set_of_texture_coordinates)
{
    GltfBuilder b = with_material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}, {"emissiveTexture", {{"index", 0}}}});
    b.doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = b.vec2s({{0.5, 0.5}, {1, 0}, {0, 1}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.meshes[0].uvs.at(0), vec2(0.5f));
    EXPECT_EQ(scene.materials[0].emissive_texture.texture, -1);
    EXPECT_TRUE(any_contains(scene.warnings, "materials[0].emissiveTexture uses TEXCOORD_0"));
}

TEST(gltf_material, glass)
{
    const Material m
        = with_material({{"extensions",
                            {{"KHR_materials_transmission", {{"transmissionFactor", 0.8}}},
                                {"KHR_materials_volume",
                                    {{"thicknessFactor", 0.02}, {"attenuationColor", {0.5, 1, 0.25}}, {"attenuationDistance", 0.01}}}}}})
              .load()
              .materials[0];
    EXPECT_FLOAT_EQ(m.transmission, 0.8f);
    EXPECT_FLOAT_EQ(m.thickness, 0.02f);
    EXPECT_FLOAT_EQ(m.attenuation_distance, 0.01f);
    expect_near(m.attenuation_color, {0.5f, 1, 0.25f});
    expect_near(transmittance(m, vec4(1)), {0.2f, 0.8f, 0.05f});
}

TEST(gltf_material, other_shading_models)
{
    const Material unlit = with_material({{"extensions", {{"KHR_materials_unlit", json::object()}}}}).load().materials[0];
    EXPECT_EQ(unlit.metallic, 0.0f);
    const Material glossy = with_material(
        {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"glossinessFactor", 0.75}}}}}})
                                .load()
                                .materials[0];
    EXPECT_EQ(glossy.base_color, vec4(0.5f, 0.5f, 0.5f, 1.0f));
    EXPECT_EQ(glossy.roughness, 0.25f);
    EXPECT_EQ(glossy.metallic, 0.0f);
}

TEST(gltf_material, missing_material_becomes_the_default)
{
    GltfBuilder b;
    b.triangle({{"material", 5}});
    b.triangle();
    b.node({{"mesh", 0}});
    b.node({{"mesh", 1}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_TRUE(any_contains(scene.warnings, "meshes[0].primitives[0].material refers to materials[5], but the file has 0"));
}

TEST(gltf_material, broken_images_are_left_out)
{
    const json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    const auto warning_with = [&](const json& image) {
        GltfBuilder b = with_material(material);
        b.doc["images"][0] = image;
        const Scene scene = b.load();
        EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
        EXPECT_EQ(scene.warnings.size(), 1u);
        return scene.warnings.empty() ? std::string() : scene.warnings.front();
    };
    EXPECT_NE(warning_with({{"uri", "none.png"}}).find("none.png"), std::string::npos);
    EXPECT_NE(warning_with({{"uri", "data:image/png;base64,AAAA"}}).find("images[0] is neither a PNG nor a JPEG"), std::string::npos);
    EXPECT_NE(warning_with({{"uri", "data:image/png;base64,iVBORw0KGgo="}}).find("images[0] is broken"), std::string::npos);
    for (const char* outside :
        {"../secret.png", "/etc/passwd", "a/../../b.png", "%2e%2e/b.png", "http://example.org/a.png", "file:///a.png"})
        EXPECT_NE(warning_with({{"uri", outside}}).find("must name a file beside"), std::string::npos) << outside;
}

TEST(gltf_material, files_beside_the_document)
{
    TemporaryFolder folder;
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.doc["images"][0] = {{"uri", "maps/red%20brick.png"}};
    b.doc["buffers"] = {{{"byteLength", b.data.size()}, {"uri", "data.bin"}}};
    base::write_file(folder / "maps/red brick.png", small_png());
    base::write_file(folder / "data.bin", b.data);
    base::write_text(folder / "made.gltf", b.doc.dump());
    const Scene scene = load_gltf(folder / "made.gltf");
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.name, "made");
}

TEST(gltf_material, required_extensions)
{
    GltfBuilder b = with_material(json::object());
    for (const char* name : {"KHR_draco_mesh_compression", "KHR_texture_basisu", "EXT_unheard_of"}) {
        b.doc["extensionsRequired"] = {name};
        EXPECT_NE(b.load_error().find(std::string("requires ") + name), std::string::npos);
    }
    b.doc["extensionsRequired"] = {"KHR_materials_clearcoat"};
    EXPECT_EQ(b.load_error(), "");
}

} // namespace
} // namespace gnomon::scene
