// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "lab/experiment.h"
#include "lab/render.h"
#include "scene/load.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

// The presets that are kept here, and the scenes that they come from.
namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<fs::path> files(const std::string& folder)
{
    std::vector<fs::path> out;
    for (const auto& entry : fs::directory_iterator(tests::source_root() / folder))
        if (entry.path().extension() == ".json") out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

std::set<std::string> models(const std::string& folder)
{
    std::set<std::string> out;
    for (const fs::path& file : files(folder)) out.insert(Json::parse(base::read_text(file)).at("model").get<std::string>());
    return out;
}

TEST(KeptPresets, NameParametersThatThereAreAndGainInValidation)
{
    ASSERT_FALSE(files("presets").empty());
    for (const fs::path& file : files("presets")) {
        SCOPED_TRACE(file.filename().string());
        const Choice choice = parse_choice("@" + file.string());
        const Json json = Json::parse(base::read_text(file));
        for (const Json& name : json.at("vary")) EXPECT_NE(choice.params.table().find(name.get<std::string>()), nullptr) << name;
        const Json& validation = json.at("validation");
        EXPECT_LT(validation.at("ratio").get<double>(), 1 - validation.at("standard_error").get<double>());
        for (const Json& term : validation.at("terms")) EXPECT_LE(term.get<double>(), 1.01);
        EXPECT_EQ(file.stem().string().rfind(choice.info->id, 0), 0u) << "the file's name begins with the technique's id";
    }
}

TEST(KeptPresets, AreEachInAPublishedTable)
{
    std::string tables;
    for (const fs::path& file : files("experiments/presets")) tables += base::read_text(file);
    for (const fs::path& file : files("presets"))
        EXPECT_NE(tables.find("@../../presets/" + file.filename().string() + "\""), std::string::npos) << file.filename();
}

TEST(KeptPresets, WereHeldAgainstModelsThatNeitherSearchNorValidationSaw)
{
    for (const auto& [folder, tuning, validation] :
        {std::tuple{"tuning", true, false}, {"validation", false, true}, {"held_out", false, false}})
        for (const fs::path& file : files(std::string("experiments/") + folder)) {
            const scene::Scene scene = scene::load(file.string());
            EXPECT_EQ(scene.tuning, tuning) << file;
            EXPECT_EQ(scene.validation, validation) << file;
        }
    for (const std::string& model : models("experiments/held_out")) {
        EXPECT_EQ(models("experiments/tuning").count(model), 0u) << model;
        EXPECT_EQ(models("experiments/validation").count(model), 0u) << model;
    }
}

} // namespace
} // namespace gnomon::lab
