// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/figures.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

lab::Figures read(const std::string& text)
{
    const fs::path file = fs::temp_directory_path() / ("gnomon_figures_" + std::to_string(getpid()) + ".json");
    base::write_text(file, text);
    struct Remove {
        fs::path file;
        ~Remove() { fs::remove(file); }
    } remove{file};
    return lab::read_figures(file);
}

std::string refusal(const std::string& text)
{
    try {
        read(text);
    } catch (const base::Error& e) {
        return e.what();
    }
    return "nothing";
}

TEST(Figures, PanelsTakeWhatTheyDoNotSayFromTheirFigure)
{
    const lab::Figures f
        = read(R"({"title": "T", "truth_samples": 16, "figures": [{"id": "a", "title": "A", "scene": "balls", "size": "64x48",
        "show": "visibility", "crop": [1, 2, 3, 4], "panels": [{"technique": "truth"}, {"technique": "shadow_map:pcf=5", "label": "L",
        "show": "error", "gain": 4, "size": "32x24"}]}]})");
    ASSERT_EQ(f.figures.size(), 1u);
    ASSERT_EQ(f.figures[0].panels.size(), 2u);
    const lab::FigurePanel &first = f.figures[0].panels[0], &second = f.figures[0].panels[1];
    EXPECT_EQ(first.stage.scene, "balls");
    EXPECT_EQ(first.show, lab::Show::visibility);
    EXPECT_EQ(first.label, "truth");
    EXPECT_EQ(first.crop, (std::array<int, 4>{1, 2, 3, 4}));
    EXPECT_EQ(second.show, lab::Show::error);
    EXPECT_EQ(second.gain, 4.0f);
    EXPECT_EQ(second.stage.size, (base::Size{32, 24}));
    EXPECT_EQ(second.label, "L");
    EXPECT_EQ(f.truth_samples, 16);
}

TEST(Figures, WhatCannotBeReadIsASentenceThatNamesThePlace)
{
    const auto figure = [](const std::string& inside) { return R"({"figures": [{"id": "a", )" + inside + "}]}"; };
    EXPECT_NE(refusal("{").find("parse error"), std::string::npos);
    EXPECT_NE(refusal("{}").find("figures"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [])")).find("no list of panels"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "colour": 1}])")).find("colour"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"label": "x"}])")).find("names no technique"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "shadow_mop"}])")).find("shadow_map"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "show": "viability"}])")).find("visibility"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "size": "10"}])")).find("WIDTHxHEIGHT"), std::string::npos);
    EXPECT_NE(
        refusal(figure(R"("panels": [{"technique": "shadow_map", "show": "filter_error"}])")).find("no reference"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("columns": 1e300, "panels": [{"technique": "truth"}])")).find("columns"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "crop": [0, 0, 1e300, 1]}])")).find("crop"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "gain": -1}])")).find("gain"), std::string::npos);
    EXPECT_NE(refusal(figure(R"("panels": [{"technique": "truth", "slice_up": [0, 1e300, 0]}])")).find("slice_up"), std::string::npos);
    EXPECT_NE(refusal(R"({"figures": [{"id": "../a", "panels": [{"technique": "truth"}]}]})").find("cannot be the id"), std::string::npos);
}

} // namespace
} // namespace gnomon
