// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "base/image_file.h"
#include "lab/figures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

TEST(Figures, EachPanelIsAPictureAndThePageShowsThemAll)
{
    const fs::path folder = fs::temp_directory_path() / ("gnomon_figures_" + std::to_string(getpid()));
    fs::create_directories(folder);
    base::write_text(folder / "figures.json", R"({"title": "T", "truth_samples": 4, "figures": [{"id": "a", "title": "A", "scene": "plane",
        "size": "40x30", "columns": 2, "panels": [{"technique": "truth"}, {"technique": "truth", "show": "visibility"},
        {"technique": "shadow_map"}, {"technique": "shadow_map", "show": "error", "gain": 2},
        {"technique": "shadow_map", "show": "filter_error", "reference": "shadow_map:pcf=5"},
        {"technique": "shadow_map", "show": "slice"}, {"technique": "truth", "show": "slice", "crop": [4, 5, 10, 8], "zoom": 3}]}]})");
    const char* name = std::getenv("GNOMON_DEVICE");
    const auto device = gpu::Device::open({name ? name : "", true});
    const std::vector<fs::path> files = lab::draw_figures(*device, lab::read_figures(folder / "figures.json"), folder);
    ASSERT_EQ(files.size(), 8u);
    const std::string page = base::read_text(files.back());
    for (size_t i = 0; i + 1 < files.size(); ++i) {
        const base::Picture p = base::read_png(files[i], base::Encoding::linear);
        EXPECT_EQ(p.size, i == 6 ? (base::Size{30, 24}) : (base::Size{40, 30})) << files[i];
        EXPECT_NE(page.find(files[i].filename().string()), std::string::npos);
    }
    EXPECT_TRUE(device->validation_errors().empty());
    fs::remove_all(folder);
}

} // namespace
} // namespace gnomon
