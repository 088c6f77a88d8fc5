// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/temporary_folder.h"
#include "lab/export_comments.h"
#include "lab/export_impl.h"

#include <gtest/gtest.h>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

TEST(ExportComments, AreFoundWhereTheSourcesHaveThem)
{
    const std::map<std::string, std::string> sources{{"a.glsl", R"(
/// A layer.
/// Two lines.
struct Layer {
    mat4 map_from_world; ///< world to map,
                         ///< homogeneous
    float near DEFAULT(0.1f), far[2]; // metres
    uint silent;
};
layout(set = 0, binding = 3) uniform sampler2D noise_image; // blue noise
layout(set = 0, binding = 4, scalar) readonly buffer Starts { uint count; uint first[]; }; // of instances
void f()
{
    float local; // not a member of anything
}
)"}};
    const Comments c(sources);
    EXPECT_EQ(c.of("Layer"), "A layer. Two lines.");
    EXPECT_EQ(c.of("Layer", "map_from_world"), "world to map, homogeneous");
    EXPECT_EQ(c.of("Layer", "near"), "metres");
    EXPECT_EQ(c.of("Layer", "far"), "metres");
    EXPECT_EQ(c.of("Layer", "silent"), "");
    EXPECT_EQ(c.of("Starts"), "of instances");
    EXPECT_EQ(c.of_resource("noise_image"), "blue noise");
    EXPECT_EQ(c.of_resource("local"), "");
}

TEST(ExportLayouts, BytesAreReadByMembers)
{
    const Json types = {{"Light",
        {{"bytes", 16},
            {"members", {{{"name", "p"}, {"type", "vec3"}, {"offset", 0}}, {{"name", "kind"}, {"type", "uint"}, {"offset", 12}}}}}}};
    const Json members = {{{"name", "n"}, {"type", "int"}, {"offset", 0}},
        {{"name", "lights"}, {"type", "Light"}, {"offset", 4}, {"array", {2}}, {"stride", 16}}};
    const struct {
        int n = -3;
        struct {
            float p[3];
            uint32_t kind;
        } lights[2] = {{{1, 2, 3}, 4}, {{5, 6, 7}, 8}};
    } block;
    const Json values = decode_block(std::as_bytes(std::span(&block, 1)), members, types);
    EXPECT_EQ(values["n"], -3);
    EXPECT_EQ(values["lights"][1]["p"], Json({5.0f, 6.0f, 7.0f}));
    EXPECT_EQ(values["lights"][1]["kind"], 8);
    EXPECT_NE(layout_header(types).find("static_assert(offsetof(Light, kind) == 12);"), std::string::npos);
}

TEST(ExportWrite, AFolderIsWrittenWholeOrNotAtAll)
{
    const base::TemporaryFolder scratch;
    const fs::path out = scratch.path() / "out";
    const Exported good{{{"passes.json", "{\"generator\": \"gnomon 0\"}"}, {"source/a.glsl", "a"}}, {}};
    write_export(good, out);
    EXPECT_EQ(base::read_text(out / "source" / "a.glsl"), "a");
    // a file that lies where another needs a folder fails in the middle: the earlier export stays as it was
    const Exported bad{{{"passes.json", "{\"generator\": \"gnomon 1\"}"}, {"x", "x"}, {"x/y", "y"}}, {}};
    EXPECT_THROW(write_export(bad, out), base::Error);
    EXPECT_EQ(base::read_text(out / "passes.json"), "{\"generator\": \"gnomon 0\"}");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 1) << "nothing is left beside it";
    base::write_text(scratch.path() / "mine" / "letter.txt", "dear");
    EXPECT_THROW(write_export(good, scratch.path() / "mine"), base::Error);
    EXPECT_FALSE(fs::exists(scratch.path() / "mine" / "passes.json"));
}

TEST(ExportLanguage, NamesAreReadAndMisspellingsRefused)
{
    for (const Language l : {Language::glsl, Language::hlsl, Language::msl, Language::spirv})
        EXPECT_EQ(parse_language(std::string(language_name(l))), l);
    EXPECT_THROW(parse_language("cg"), base::Error);
    const Json image = {{"set", 0}, {"binding", 3}, {"name", "i"}, {"type", "sampler2D"}};
    EXPECT_EQ(place_of(Language::hlsl, image), "t3, s3, space0");
    EXPECT_EQ(place_of(Language::msl, image), "texture(3), sampler(3)");
    EXPECT_EQ(place_of(Language::glsl, image), "set 0, binding 3");
}

} // namespace
} // namespace gnomon::lab
