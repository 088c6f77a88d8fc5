// SPDX-License-Identifier: Apache-2.0
#include "scene/light_image.h"

#include "base/error.h"
#include "base/image_file.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

/// Mean over the part of the picture that texel (x, y) of a size of w x h covers.
vec3 covered_mean(int width, int height, const std::vector<vec3>& emitted, int x, int y, int w, int h)
{
    const double x0 = double(x) * width / w, x1 = double(x + 1) * width / w, y0 = double(y) * height / h, y1 = double(y + 1) * height / h;
    const auto overlap = [](int i, double lo, double hi) { return std::min(double(i) + 1.0, hi) - std::max(double(i), lo); };
    glm::dvec3 sum(0.0);
    for (int j = int(y0); j < std::min(height, int(std::ceil(y1))); ++j)
        for (int i = int(x0); i < std::min(width, int(std::ceil(x1))); ++i)
            sum += overlap(i, x0, x1) * overlap(j, y0, y1) * glm::dvec3(emitted[size_t(j) * size_t(width) + size_t(i)]);
    return vec3(sum / ((x1 - x0) * (y1 - y0)));
}

/// Red on the left, blue on the right.
LightImage halves() { return make_light_image(2, 1, {vec3(1, 0, 0), vec3(0, 0, 1)}, "halves"); }

/// A leaded window: four columns by three rows of panes in six colours between dark bars.
LightImage window()
{
    constexpr vec3 colors[]
        = {{1, 0.05f, 0.02f}, {1, 0.7f, 0.05f}, {0.05f, 0.8f, 0.1f}, {0.02f, 0.1f, 1}, {0.7f, 0.03f, 0.8f}, {1, 1, 0.9f}};
    constexpr int pane = 5, columns = 4, rows = 3, width = columns * pane + 1, height = rows * pane + 1;
    std::vector<vec3> out(size_t(width) * size_t(height), vec3(0));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (x % pane != 0 && y % pane != 0) out[size_t(y) * size_t(width) + size_t(x)] = colors[(x / pane + 5 * (y / pane)) % 6];
    return make_light_image(width, height, out, "window");
}

/// Embers: white hot at the foot, red at the top and the sides. No two texels of a half are alike.
LightImage glow()
{
    constexpr int side = 32;
    std::vector<vec3> out;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const vec2 p = (vec2(x, y) + 0.5f) / float(side);
            const float heat = p.y * std::exp(-8.0f * (p.x - 0.5f) * (p.x - 0.5f));
            out.emplace_back(0.02f + heat, heat * heat, heat * heat * heat * heat);
        }
    return make_light_image(side, side, out, "glow");
}

struct Builtin {
    const char* name;
    LightImage (*make)();
};
constexpr Builtin builtin_images[] = {{"halves", halves}, {"window", window}, {"glow", glow}, {"none", [] { return LightImage{}; }}};

base::Picture read_picture(const std::filesystem::path& file, const std::string& extension)
{
    if (extension != ".exr") return base::read_png(file, base::Encoding::srgb);
    std::vector<std::string> names;
    base::Picture picture = base::read_exr(file, &names);
    const bool rgb = names.size() >= 3 && names[0] == "R" && names[1] == "G" && names[2] == "B";
    if (!rgb && picture.channels != 1)
        base::fail("the light's image {} holds neither the channels R, G and B nor one channel alone; export it as such", file.string());
    return picture;
}

} // namespace

vec3 LightImage::at(vec2 u) const
{
    const int x = std::clamp(int(u.x * float(width)), 0, width - 1), y = std::clamp(int(u.y * float(height)), 0, height - 1);
    return texels[size_t(height - 1 - y) * size_t(width) + size_t(x)];
}

LightImage make_light_image(int width, int height, const std::vector<vec3>& emitted, const std::string& name)
{
    if (width < 1 || height < 1 || emitted.size() != size_t(width) * size_t(height))
        base::fail("the light's image {} has {} texels instead of {} x {}; give each row as many", name, emitted.size(), width, height);
    for (const vec3 e : emitted)
        for (int c = 0; c < 3; ++c)
            if (!(e[c] >= 0.0f && e[c] <= 1e12f))
                base::fail("the light's image {} holds the value {}; emission must be finite and not negative, at most 1e12", name, e[c]);
    LightImage out{.width = std::min(width, light_image_side), .height = std::min(height, light_image_side)};
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) out.texels.push_back(covered_mean(width, height, emitted, x, y, out.width, out.height));
    glm::dvec3 mean(0.0);
    for (const vec3 t : out.texels) mean += glm::dvec3(t) / double(out.texels.size());
    const double total = (mean.x + mean.y + mean.z) / 3.0;
    if (!(total > 1e-30)) base::fail("the light's image {} is black everywhere; give it some light, or leave it out", name);
    out.tint = vec3(mean / total);
    for (vec3& t : out.texels)
        for (int c = 0; c < 3; ++c) t[c] = mean[c] > 1e-30 ? float(double(t[c]) / mean[c]) : 1.0f;
    return out;
}

LightImage load_light_image(const std::string& name_or_file, const std::filesystem::path& folder)
{
    for (const Builtin& builtin : builtin_images)
        if (name_or_file == builtin.name) return builtin.make();
    const std::filesystem::path file = folder / name_or_file;
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (extension.empty()) {
        std::vector<std::string> names;
        for (const Builtin& builtin : builtin_images) names.emplace_back(builtin.name);
        throw base::Error(base::unknown_name("light image", name_or_file, names) + ", and files end in .png, .jpg or .exr");
    }
    if (extension != ".png" && extension != ".jpg" && extension != ".jpeg" && extension != ".exr")
        base::fail("the light's image '{}' is no .png, .jpg or .exr file; convert it to one", file.string());
    const base::Picture picture = read_picture(file, extension);
    std::vector<vec3> emitted;
    emitted.reserve(picture.size.area());
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const int green = picture.channels >= 3 ? 1 : 0;
            emitted.emplace_back(picture.at(x, y, 0), picture.at(x, y, green), picture.at(x, y, 2 * green));
        }
    return make_light_image(picture.size.width, picture.size.height, emitted, file.string());
}

} // namespace gnomon::scene
