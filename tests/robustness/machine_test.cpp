// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon::tests {
namespace {

using Json = nlohmann::json;

TEST(Machine, WithoutVulkanThePictureIsRefusedAndTheTruthIsNot)
{
    const Scratch scratch;
    const RunOptions none{.environment = {{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}}};
    for (const std::vector<std::string>& command :
        {std::vector<std::string>{"render", "plane"}, {"compare", "plane", "--techniques", "shadow_map"}, {"bench"}})
        expect_sentence(run_gnomon(command, scratch.folder(), none), 1, {"Vulkan driver", "VK_ICD_FILENAMES"});
    EXPECT_EQ(run_gnomon({"truth", "plane", "--size", "16x16", "-o", "a.exr"}, scratch.folder(), none).code, 0);
    EXPECT_EQ(run_gnomon({"list", "--scenes"}, scratch.folder(), none).code, 0);
    const Finished list = run_gnomon({"list"}, scratch.folder(), none);
    EXPECT_EQ(list.code, 0) << list.err;
    EXPECT_NE(list.out.find("no device: "), std::string::npos) << list.out;
    EXPECT_NE(list.out.find("shadow_map"), std::string::npos) << list.out;
}

TEST(Machine, AnUnknownDeviceListsThoseThatAreThere)
{
    const Scratch scratch;
    const Finished list = run_gnomon({"list", "--json"}, scratch.folder());
    ASSERT_EQ(list.code, 0) << list.err;
    const std::string name = Json::parse(list.out)["devices"][0]["name"];
    expect_sentence(run_gnomon({"render", "plane", "--device", "nosuch"}, scratch.folder()), 1, {"'nosuch'", name});
}

TEST(Machine, TooLittleMemoryIsSaid)
{
    const Scratch scratch;
    // Pictures of 8192 x 8192 need several GiB.
    const RunOptions capped{.memory = uint64_t(1) << 30};
    expect_sentence(
        run_gnomon({"truth", "plane", "--size", "8192x8192", "-o", "a.exr"}, scratch.folder(), capped), 1, {"out of memory", "--size"});
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.exr"));
    EXPECT_EQ(run_gnomon({"truth", "plane", "--size", "64x64", "-o", "a.exr"}, scratch.folder(), capped).code, 0);
}

Json parsed(const std::vector<std::string>& arguments, const Scratch& scratch)
{
    const Finished f = run_gnomon(arguments, scratch.folder());
    EXPECT_EQ(f.code, 0) << f.err;
    return Json::parse(f.out); // throws: a failure
}

TEST(Machine, JsonOutputsParse)
{
    const Scratch scratch;
    const Json list = parsed({"list", "--json"}, scratch);
    EXPECT_FALSE(list.at("device").get<std::string>().empty());
    EXPECT_GE(list.at("techniques").size(), 2u);
    for (const Json& t : list.at("techniques"))
        for (const char* key : {"id", "title", "output", "lights", "unavailable", "parameters"}) EXPECT_TRUE(t.contains(key)) << key;

    const Json scenes = parsed({"list", "--scenes", "--json"}, scratch);
    EXPECT_GE(scenes.size(), 10u);
    EXPECT_TRUE(scenes[0].at("triangles").is_number());

    const Json render = parsed({"render", "plane", "--size", "16x12", "--aov", "visibility,depth", "-o", "p.exr", "--json"}, scratch);
    ASSERT_EQ(render.at("files").size(), 3u);
    for (const Json& file : render.at("files")) EXPECT_TRUE(std::filesystem::exists(scratch / file.get<std::string>())) << file;
    EXPECT_GT(render.at("passes").size(), 2u);

    const Json truth = parsed({"truth", "plane", "--size", "16x12", "-o", "t.exr", "--json"}, scratch);
    for (const Json& file : truth.at("files")) EXPECT_TRUE(std::filesystem::exists(scratch / file.get<std::string>())) << file;
    EXPECT_EQ(truth.at("lights").size(), 1u);

    const Json compare = parsed(
        {"compare", "plane", "--techniques", "shadow_map,shadow_map:pcf=5", "--size", "32x24", "--repeats", "1", "-o", "c", "--json"},
        scratch);
    EXPECT_EQ(compare, Json::parse(read_whole(scratch / "c/results.json"))) << "the file and the output say the same";
    EXPECT_EQ(compare.at("runs").size(), 2u);

    const Json bench = parsed({"bench", "plane", "--size", "16x12", "--repeats", "2", "--json"}, scratch);
    EXPECT_TRUE(bench.is_object());
    const Json& row = bench.at("rows").at(0);
    EXPECT_GT(row.at("reference_ratio").get<double>(), 0.0);
    EXPECT_LT(row.at("dynamic_ratio").get<double>(), row.at("ratio").get<double>()) << "the build of the tree counts as well";
}

} // namespace
} // namespace gnomon::tests
