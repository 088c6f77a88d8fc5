// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "shadow/light_constants.h"
#include "techniques/per_triangle_volumes/depth_tree.h"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

// The twin of per_triangle_volumes on the CPU: volumes (volume_setup.glsl), tests (volume.glsl) and tree (tree.glsl, traverse.glsl) with
// the same roundings in the same order, for opaque triangles. Its files are compiled with -ffp-contract=off, as `precise` asks of shaders.
namespace gnomon::per_triangle_twin {

using shaders::Tree;

struct Volume {
    std::array<vec4, 4> planes; ///< three sides, the cap
    std::array<float, 4> limits; ///< least values inside
    uint32_t primitive;
};

struct Box {
    vec2 x, y, z;
};

enum class Verdict { reject, refine, accept };

class Twin {
public:
    Twin(const scene::Scene& s, const scene::View& view, const scene::Light& light)
        : light_(shadow::light_constants(light, s.bounds()))
        , eye_(view.eye)
        , world_from_ndc_(glm::translate(glm::dmat4(1), -glm::dvec3(view.eye)) * glm::inverse(glm::dmat4(view.clip_from_world)))
        , tree_(techniques::per_triangle_volumes::make_tree(view))
    {
        uint32_t primitive = 0;
        for (const scene::Instance& i : s.instances) {
            const scene::Mesh& m = s.meshes[size_t(i.mesh)];
            for (size_t t = 0; t < m.indices.size(); t += 3, ++primitive)
                add(corner(i.world_from_object, m.positions[m.indices[t]]), corner(i.world_from_object, m.positions[m.indices[t + 1]]),
                    corner(i.world_from_object, m.positions[m.indices[t + 2]]), primitive);
        }
    }
    size_t volume_count() const { return volumes_.size(); }

    /// Every sample against every volume: 1 where it is dark.
    std::vector<uint8_t> one_by_one(const std::vector<float>& depth, const std::vector<float>& primitive) const
    {
        std::vector<uint8_t> dark(depth.size(), 0);
        for (size_t i = 0; i < depth.size(); ++i)
            for (size_t v = 0; v < volumes_.size() && !dark[i]; ++v) dark[i] = darkens(volumes_[v], pixel(i), depth[i], primitive[i]);
        return dark;
    }

    /// The same down the tree.
    std::vector<uint8_t> by_tree(const std::vector<float>& depth, const std::vector<float>& primitive)
    {
        drawn_depth_ = &depth, drawn_primitive_ = &primitive;
        build(depth);
        tests_ = 0;
        for (const Volume& v : volumes_) visit(v, tree_.height, uvec2(0));
        std::vector<uint8_t> dark(depth.size(), 0);
        for (size_t i = 0; i < depth.size(); ++i) {
            uvec2 at = pixel(i);
            for (uint32_t height = 1; height <= tree_.height; ++height) {
                const uvec2 node = at >> shift_within(height);
                dark[i] = dark[i] || (words_[index(height, node)] >> bit(height, at) & 1) != 0;
                at = node;
            }
        }
        return dark;
    }
    uint64_t tests() const { return tests_; } ///< of tiles and samples, by the last by_tree

private:
    uvec2 pixel(size_t i) const { return {uint32_t(i) % tree_.samples.x, uint32_t(i) / tree_.samples.x}; }

    // ---- volumes -------------------------------------------------------------------------------------------------------------

    static float dot(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
    static vec3 cross(vec3 a, vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
    static bool before(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }
    static vec3 corner(const mat4& m, vec3 p)
    {
        const auto row = [&](int k) { return dot(vec3(m[0][k], m[1][k], m[2][k]), p) + m[3][k]; };
        return {row(0), row(1), row(2)};
    }
    vec3 to_light(vec3 p) const { return light_.kind == LIGHT_DIRECTIONAL ? -light_.direction : light_.position - p; }

    vec4 ndc_plane(vec3 n, vec3 through) const
    {
        const float k = dot(n, eye_ - through);
        const auto column = [&](int i) { return dot(n, vec3(world_from_ndc_[i])) + k * world_from_ndc_[i].w; };
        return {column(0), column(1), column(2), column(3)};
    }
    vec4 edge_plane(vec3 a, vec3 b) const { return ndc_plane(cross(to_light(a), b - a), a); }

    vec4 cap_bias(float height, vec3 to_light) const
    {
        const float slant = std::abs(height) / std::sqrt(dot(to_light, to_light));
        const vec3 z(world_from_ndc_[2]);
        return {0, 0, slant * tree_.nearer.z, slant * (tree_.nearer.y + tree_.nearer.x * std::sqrt(dot(z, z)))};
    }

    void add(vec3 a, vec3 b, vec3 d, uint32_t primitive)
    {
        if (before(b, a)) std::swap(a, b);
        if (before(d, b)) std::swap(b, d);
        if (before(b, a)) std::swap(a, b);
        const vec3 u = b - a, v = d - a, n = cross(u, v);
        const float height = dot(n, to_light(a));
        if (height == 0.0f || std::isnan(height)) return;
        const bool doubtful = std::abs(height) <= 1e-6f * glm::length(u) * glm::length(v) * glm::length(to_light(a));
        for (const float turn : {-1.0f, 1.0f}) {
            if (!doubtful && turn * height < 0.0f) continue;
            const float open = 1.17549435e-38f;
            const Volume volume{{turn * edge_plane(b, d), -turn * edge_plane(a, d), turn * edge_plane(a, b),
                                    (height > 0 ? -1.0f : 1.0f) * ndc_plane(n, a) - cap_bias(height, to_light(a))},
                {turn > 0 ? 0.0f : open, turn > 0 ? open : 0.0f, turn > 0 ? 0.0f : open, 0.0f}, primitive};
            bool finite = true;
            for (const vec4& p : volume.planes)
                for (int k = 0; k < 4; ++k) finite = finite && std::isfinite(p[k]);
            if (finite) volumes_.push_back(volume);
        }
    }

    // ---- tests ---------------------------------------------------------------------------------------------------------------

    vec2 ndc(uvec2 at) const
    {
        const vec2 odd(float(int(2 * at.x + 1) - int(tree_.samples.x)), float(int(2 * at.y + 1) - int(tree_.samples.y)));
        return {odd.x * tree_.step.x, odd.y * tree_.step.y};
    }
    float receiver_depth(float depth) const { return depth + ((depth * tree_.nearer.z + tree_.nearer.y) * depth + tree_.nearer.x); }

    bool darkens(const Volume& v, uvec2 at, float depth, float primitive) const
    {
        if (depth == 0.0f || primitive == float(v.primitive)) return false;
        const vec2 xy = ndc(at);
        const float z = receiver_depth(depth);
        for (size_t k = 0; k < 4; ++k) {
            const vec4& p = v.planes[k];
            if (!(((p.x * xy.x + p.y * xy.y) + p.z * z) + p.w >= v.limits[k])) return false;
        }
        return true;
    }

    static Verdict classify(const Volume& v, const Box& b)
    {
        bool inside = true;
        for (size_t k = 0; k < 4; ++k) {
            const vec4& p = v.planes[k];
            const float x0 = p.x * b.x.x, x1 = p.x * b.x.y, y0 = p.y * b.y.x, y1 = p.y * b.y.y, z0 = p.z * b.z.x, z1 = p.z * b.z.y;
            if (((std::max(x0, x1) + std::max(y0, y1)) + std::max(z0, z1)) + p.w < v.limits[k]) return Verdict::reject;
            inside = inside && ((std::min(x0, x1) + std::min(y0, y1)) + std::min(z0, z1)) + p.w >= v.limits[k];
        }
        return inside ? Verdict::accept : Verdict::refine;
    }

    // ---- tree ----------------------------------------------------------------------------------------------------------------

    static uint32_t row_shift(uint32_t height) { return 2 + (height & 1); }
    static uvec2 shift_within(uint32_t height) { return {row_shift(height), 5 - row_shift(height)}; }
    uint32_t index(uint32_t height, uvec2 node) const { return tree_.first[height] + node.y * tree_.width[height] + node.x; }
    static uint32_t bit(uint32_t height, uvec2 child)
    {
        const uvec2 s = shift_within(height);
        return (child.x & ((1u << s.x) - 1)) + ((child.y & ((1u << s.y) - 1)) << s.x);
    }
    static uvec2 child_of(uint32_t height, uvec2 node, uint32_t child)
    {
        const uvec2 s = shift_within(height);
        return (node << s) + uvec2(child & ((1u << s.x) - 1), child >> s.x);
    }
    uvec2 extent(uint32_t height) const { return ((tree_.samples - 1u) >> shaders::tree_shift(height)) + 1u; }

    void build(const std::vector<float>& depth)
    {
        words_.assign(tree_.nodes, 0);
        depths_.assign(tree_.nodes, vec2(1e30f, 0));
        for (uint32_t height = 1; height <= tree_.height; ++height)
            for (uint32_t y = 0; y < extent(height).y; ++y)
                for (uint32_t x = 0; x < extent(height).x; ++x)
                    for (uint32_t i = 0; i < 32; ++i) {
                        vec2& out = depths_[index(height, {x, y})];
                        const uvec2 child = child_of(height, {x, y}, i), end = height == 1 ? tree_.samples : extent(height - 1);
                        if (child.x >= end.x || child.y >= end.y) continue;
                        if (height > 1) {
                            const vec2 in = depths_[index(height - 1, child)];
                            out = {std::min(out.x, in.x), std::max(out.y, in.y)};
                        } else if (const float d = depth[child.y * tree_.samples.x + child.x]; d != 0.0f) {
                            out = {std::min(out.x, receiver_depth(d)), std::max(out.y, receiver_depth(d))};
                        }
                    }
    }

    void visit(const Volume& v, uint32_t height, uvec2 node)
    {
        for (uint32_t i = 0; i < 32; ++i) {
            const uvec2 child = child_of(height, node, i), end = height == 1 ? tree_.samples : extent(height - 1);
            if (child.x >= end.x || child.y >= end.y || (words_[index(height, node)] >> i & 1) != 0) continue;
            ++tests_;
            if (height == 1) {
                const size_t at = child.y * size_t(tree_.samples.x) + child.x;
                words_[index(height, node)] |= uint32_t(darkens(v, child, (*drawn_depth_)[at], (*drawn_primitive_)[at])) << i;
                continue;
            }
            const uvec2 shift = shaders::tree_shift(height - 1), last = glm::min((child + 1u) << shift, tree_.samples) - 1u;
            const vec2 least = ndc(child << shift), most = ndc(last);
            const Verdict verdict = classify(v, {{least.x, most.x}, {least.y, most.y}, depths_[index(height - 1, child)]});
            if (verdict == Verdict::accept) words_[index(height, node)] |= 1u << i;
            if (verdict == Verdict::refine) visit(v, height - 1, child);
        }
    }

    shaders::Light light_;
    vec3 eye_;
    mat4 world_from_ndc_;
    Tree tree_;
    std::vector<Volume> volumes_;
    std::vector<uint32_t> words_;
    std::vector<vec2> depths_;
    const std::vector<float>*drawn_depth_ = nullptr, *drawn_primitive_ = nullptr;
    uint64_t tests_ = 0;
};

} // namespace gnomon::per_triangle_twin
