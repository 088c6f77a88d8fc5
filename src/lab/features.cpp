// SPDX-License-Identifier: Apache-2.0
#include "lab/features.h"

#include "scene/rebase.h"
#include "truth/truth.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace gnomon::lab {

namespace {

/// Equal for equal positions; +0 is -0.
struct PositionHash {
    size_t operator()(vec3 p) const
    {
        size_t h = 0;
        for (int i = 0; i < 3; ++i) {
            const float f = p[i] + 0.0f;
            uint32_t bits;
            memcpy(&bits, &f, 4);
            h = (h ^ bits) * 0x9e3779b97f4a7c15ull;
            h ^= h >> 29;
        }
        return h;
    }
};

/// Along one line of a picture: pixels in penumbrae, and edges between lit and dark, with a penumbra or without.
struct Crossings {
    size_t pixels = 0, edges = 0;

    struct Sample {
        float visibility;
        bool joined; ///< on one surface with the sample before
    };
    void line(const std::vector<Sample>& samples)
    {
        float last = -1; // the last one that was fully lit or dark; -1: none yet
        size_t between = 0;
        for (const auto& [v, joined] : samples) {
            if (!joined) last = -1, between = 0; // from one surface to another there is no penumbra to be seen whole
            if (v > 0.0f && v < 1.0f) {
                ++between;
                continue;
            }
            if (last >= 0 && (between > 0 || v != last)) {
                pixels += between;
                edges += v != last ? 1 : 2; // back to where it began: in and out
            }
            last = v, between = 0;
        }
    }
    double width() const { return edges ? double(pixels) / double(edges) : 0.0; }
};

/// Edges run in all directions: a row crosses upright ones at their width and level ones at a longer way, a column the other way round.
double penumbra_width(const base::Picture& visibility, const truth::Primary& seen)
{
    const base::Size size = visibility.size;
    const auto index = [&](int x, int y) { return size_t(y) * size_t(size.width) + size_t(x); };
    const auto normal
        = [&](size_t i) { return vec3(seen.normal.values[3 * i], seen.normal.values[3 * i + 1], seen.normal.values[3 * i + 2]); };
    const auto sample = [&](size_t at, size_t before) {
        const float d = seen.depth.values[at], from = seen.depth.values[before];
        const bool both = seen.primitive[at] != truth::no_primitive && seen.primitive[before] != truth::no_primitive;
        return Crossings::Sample{
            visibility.values[at], both && std::abs(d - from) < 0.1f * d && glm::dot(normal(at), normal(before)) > 0.85f};
    };
    Crossings rows, columns;
    std::vector<Crossings::Sample> line;
    for (int y = 0; y < size.height; ++y) {
        line.clear();
        for (int x = 0; x < size.width; ++x) line.push_back(sample(index(x, y), index(std::max(x - 1, 0), y)));
        rows.line(line);
    }
    for (int x = 0; x < size.width; ++x) {
        line.clear();
        for (int y = 0; y < size.height; ++y) line.push_back(sample(index(x, y), index(x, std::max(y - 1, 0))));
        columns.line(line);
    }
    if (!rows.edges || !columns.edges) return std::max(rows.width(), columns.width());
    return std::min(rows.width(), columns.width());
}

void add_picture(const Stage& stage, Features& out)
{
    constexpr int part = 4;
    const base::Size full = stage.view.size, size{std::max(full.width / part, 1), std::max(full.height / part, 1)};
    const scene::View view = scene::make_view(stage.camera, size, stage.bounds);
    const truth::Tracer tracer(stage.scene);
    const truth::Primary primary = tracer.primary(view);
    scene::Light light = stage.lights.front();
    light.image = {};
    const truth::Visibility seen = tracer.visibility(view, primary, light, {.samples = 16});
    size_t visible = 0;
    double dark = 0;
    for (size_t i = 0; i < primary.primitive.size(); ++i)
        if (primary.primitive[i] != truth::no_primitive) ++visible, dark += 1.0 - double(seen.mean.values[i]);
    out.shadowed = visible ? dark / double(visible) : 0.0;
    if (out.soft) out.penumbra_pixels = penumbra_width(seen.mean, primary) * double(full.height) / double(size.height);
}

bool same_form(const scene::Scene& a, const scene::Scene& b)
{
    if (a.instances.size() != b.instances.size() || a.meshes.size() != b.meshes.size()) return false;
    for (size_t i = 0; i < a.instances.size(); ++i)
        if (a.instances[i].world_from_object != b.instances[i].world_from_object) return false;
    for (size_t i = 0; i < a.meshes.size(); ++i)
        if (a.meshes[i].positions != b.meshes[i].positions) return false;
    return true;
}

bool moves(const Stage& stage, const StageOptions& options)
{
    for (const scene::Builtin& b : scene::builtins())
        if (b.name == options.scene) return false;
    scene::LoadOptions later = options.load;
    later.time += 0.37; // no whole part of a common length, at whose end all is as before
    scene::Scene moved = scene::load(options.scene, later);
    scene::rebase(moved, stage.origin);
    return !same_form(stage.scene, moved);
}

} // namespace

bool is_open(const scene::Mesh& mesh)
{
    std::unordered_map<vec3, uint32_t, PositionHash> corners;
    std::vector<uint32_t> welded;
    for (const vec3& p : mesh.positions) welded.push_back(corners.try_emplace(p, uint32_t(corners.size())).first->second);
    std::unordered_map<uint64_t, int> triangles; // by edge
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::array<uint32_t, 3> t = {welded[mesh.indices[i]], welded[mesh.indices[i + 1]], welded[mesh.indices[i + 2]]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue; // no area
        for (size_t e = 0; e < 3; ++e) {
            const auto [low, high] = std::minmax(t[e], t[(e + 1) % 3]);
            ++triangles[(uint64_t(low) << 32) | high];
        }
    }
    return std::any_of(triangles.begin(), triangles.end(), [](const auto& edge) { return edge.second == 1; });
}

Features find_features(const Stage& stage, const StageOptions& options)
{
    Features out;
    const scene::Scene& scene = stage.scene;
    for (const scene::Instance& instance : scene.instances) {
        const scene::Mesh& mesh = scene.meshes[size_t(instance.mesh)];
        const scene::Material& material = scene.materials[size_t(mesh.material)];
        out.triangles += mesh.triangle_count();
        if (material.alpha == scene::AlphaMode::mask) out.masked += mesh.triangle_count();
        if (material.alpha == scene::AlphaMode::blend || material.transmission > 0) out.see_through += mesh.triangle_count();
    }
    out.meshes = scene.meshes.size();
    out.open_meshes = size_t(std::count_if(scene.meshes.begin(), scene.meshes.end(), is_open));
    const scene::Light& light = stage.lights.front();
    out.light = light.kind(), out.soft = light.soft(), out.textured = light.textured();
    add_picture(stage, out);
    out.moves = moves(stage, options);
    return out;
}

std::vector<std::string> feature_sentences(const Features& f)
{
    const auto part = [&](size_t count) { return 100.0 * double(count) / double(std::max<size_t>(f.triangles, 1)); };
    std::vector<std::string> out = {fmt::format("{} triangles; {} of {} meshes are open", f.triangles, f.open_meshes, f.meshes)};
    if (f.masked)
        out.push_back(
            fmt::format("{:.2g} % of the triangles are masked by alpha: truth cuts their holes, and what takes them as solid errs there",
                part(f.masked)));
    if (f.see_through)
        out.push_back(fmt::format(
            "{:.2g} % of the triangles are semitransparent: truth is the light that comes through them, by colour", part(f.see_through)));
    out.push_back(fmt::format("the light is a {} one{}{}; {:.2g} % of what is seen is in {}", scene::kind_name(f.light),
        f.soft ? fmt::format(" with an area: penumbrae are about {:.0f} pixels wide", f.penumbra_pixels) : ", hard",
        f.textured ? ", with an image" : "", 100.0 * f.shadowed, f.see_through ? "the shadow of opaque casters" : "shadow"));
    if (f.moves) out.push_back("the model moves: measured is one moment of it");
    return out;
}

nlohmann::ordered_json features_json(const Features& f)
{
    return {{"triangles", f.triangles}, {"masked_triangles", f.masked}, {"semitransparent_triangles", f.see_through}, {"meshes", f.meshes},
        {"open_meshes", f.open_meshes}, {"light", scene::kind_name(f.light)}, {"soft", f.soft}, {"textured", f.textured},
        {"penumbra_pixels", f.penumbra_pixels}, {"shadowed", f.shadowed}, {"moves", f.moves}};
}

} // namespace gnomon::lab
