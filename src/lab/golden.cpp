// SPDX-License-Identifier: Apache-2.0
#include "lab/folder.h"

#include "base/error.h"
#include "base/image_file.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace fs = std::filesystem;

base::Picture golden_image(gpu::Device& device, const shadow::TechniqueInfo& info, const std::string& kind, const fs::path& folder)
{
    const TechniqueScene own = read_technique_scene(folder);
    const Stage stage = technique_stage(own, kind, golden_size);
    shadow::SceneGpu scene(device, stage.scene);
    const base::Picture image = render(device, scene, stage, technique_choice(info, own), {.lit = false}).images.front();
    if (image.channels == 1) return image;
    base::Picture rgb(image.size, 3);
    for (size_t i = 0; i < image.size.area(); ++i) std::copy_n(&image.values[i * size_t(image.channels)], 3, &rgb.values[i * 3]);
    return rgb;
}

std::string golden_skip(const gpu::Device& device)
{
    const gpu::DeviceInfo& info = device.info();
    if (info.software && info.driver.find("Mesa 25.") != std::string::npos) return {};
    return fmt::format("goldens are made by lavapipe of Mesa 25; this is {} ({})", info.name, info.driver);
}

GoldenDifference compare_golden(const base::Picture& got, const base::Picture& golden, double pixels, double mean)
{
    GoldenDifference out;
    if (got.size != golden.size || got.channels != golden.channels) {
        out.same = false;
        out.text = fmt::format("the golden is {}x{} with {} channels, the picture {}x{} with {}", golden.size.width, golden.size.height,
            golden.channels, got.size.width, got.size.height, got.channels);
        return out;
    }
    size_t broken = 0;
    double sum = 0;
    for (int y = 0; y < got.size.height; ++y)
        for (int x = 0; x < got.size.width; ++x) {
            int worst = 0;
            for (int c = 0; c < got.channels; ++c) {
                const float v = got.at(x, y, c);
                broken += !std::isfinite(v);
                // as the file holds it
                const int difference = std::abs(int(std::lround(std::clamp(std::isfinite(v) ? v : 0.0f, 0.0f, 1.0f) * 255.0f))
                    - int(std::lround(golden.at(x, y, c) * 255.0f)));
                worst = std::max(worst, difference);
                sum += difference / 255.0;
            }
            out.off_pixels += worst > 4;
            if (worst > out.largest) out.largest = worst, out.worst_x = x, out.worst_y = y;
        }
    out.mean = sum / double(std::max<size_t>(got.values.size(), 1));
    out.same = broken == 0 && double(out.off_pixels) <= pixels * double(got.size.area()) && out.mean <= mean;
    out.text = fmt::format("pixels off by more than 4/255: {} of {} (allowed {:.0f})\nlargest difference: {}/255 at ({}, {})\nmean "
                           "difference: {:.6f} (allowed {:.6f})\nvalues that are not finite: {}",
        out.off_pixels, got.size.area(), pixels * double(got.size.area()), out.largest, out.worst_x, out.worst_y, out.mean, mean, broken);
    return out;
}

namespace {

std::string difference_to_file(const base::Picture& image, const fs::path& golden)
{
    if (!fs::exists(golden)) return "new";
    base::Picture old;
    try {
        old = base::read_png(golden, base::Encoding::linear);
    } catch (const base::Error& e) { // damaged: the new one heals it
        return fmt::format("new, since {}", e.what());
    }
    const GoldenDifference d = compare_golden(image, old);
    return fmt::format("{} pixels off, largest {}/255, mean {:.6f}", d.off_pixels, d.largest, d.mean);
}

} // namespace

std::string bless(gpu::Device& device, const shadow::TechniqueInfo& info, const fs::path& folder, const std::string& because)
{
    if (because.find_first_not_of(" \t") == std::string::npos)
        base::fail("a golden changes only for a reason; give it with --because \"...\"");
    const std::string skip = golden_skip(device);
    if (!skip.empty()) base::fail("{}; bless on that", skip);
    std::string out = fmt::format("{}: {}\n", info.id, because);
    for (const std::string& kind : claimed_kinds(info)) {
        const fs::path file = folder / ("golden." + kind + ".png");
        const base::Picture image = golden_image(device, info, kind, folder);
        out += fmt::format("  {}: {}\n", file.filename().string(), difference_to_file(image, file));
        base::write_png(file, image, base::Encoding::linear);
    }
    for (const Run& run : check_promises(device, info, folder).runs) {
        out += fmt::format("  against truth, {}:", run.light);
        for (const auto& [metric, value] : run.metrics) out += fmt::format(" {} {:.6g}", metric, value);
        out += "\n";
    }
    return out;
}

} // namespace gnomon::lab
