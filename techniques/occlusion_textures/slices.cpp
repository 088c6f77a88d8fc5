// SPDX-License-Identifier: Apache-2.0
#include "techniques/occlusion_textures/slices.h"

#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::techniques::occlusion_textures {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Mass in bins of equal width, for sums over runs of them.
constexpr size_t bin_count = 128;
struct Masses {
    std::array<double, bin_count + 1> mass{}, moment{}; ///< of the bins before
    std::array<size_t, bin_count + 1> end{}; ///< behind the last of the bins before that holds anything
};

/// An instance's mass is 1, evenly over its depths.
Masses spread(const std::vector<Interval>& content, float near, float far)
{
    std::array<double, bin_count> bins{};
    const double scale = double(bin_count) / std::max(double(far) - double(near), 1e-30);
    for (const Interval& i : content) {
        // what is flat has mass too, also at the end of the last bin
        const double thin = 1e-6, lo = std::min((double(i.near) - double(near)) * scale, double(bin_count) - thin);
        const double hi = std::max((double(i.far) - double(near)) * scale, lo + thin);
        for (size_t b = size_t(std::max(lo, 0.0)); b < bin_count && double(b) < hi; ++b)
            bins[b] += std::max(0.0, std::min(hi, double(b + 1)) - std::max(lo, double(b))) / (hi - lo);
    }
    Masses m;
    for (size_t b = 0; b < bin_count; ++b) {
        m.mass[b + 1] = m.mass[b] + bins[b];
        m.moment[b + 1] = m.moment[b] + bins[b] * (double(b) + 0.5);
        m.end[b + 1] = bins[b] > 0.0 ? b + 1 : m.end[b];
    }
    return m;
}

/// Cuts for which the distances of all mass from the end of its slice add up to the least, by dynamic programming over the bins.
std::vector<float> fitted_cuts(const std::vector<Interval>& content, int count, float near, float far)
{
    const Masses m = spread(content, near, far);
    const auto cost
        = [&](size_t from, size_t to) { return double(m.end[to]) * (m.mass[to] - m.mass[from]) - (m.moment[to] - m.moment[from]); };
    std::vector<std::array<double, bin_count + 1>> best(size_t(count) + 1);
    std::vector<std::array<size_t, bin_count + 1>> from(size_t(count) + 1);
    for (size_t to = 0; to <= bin_count; ++to) best[1][to] = cost(0, to), from[1][to] = 0;
    for (size_t n = 2; n <= size_t(count); ++n)
        for (size_t to = 0; to <= bin_count; ++to) {
            best[n][to] = std::numeric_limits<double>::infinity();
            for (size_t at = 0; at <= to; ++at)
                if (const double c = best[n - 1][at] + cost(at, to); c < best[n][to]) best[n][to] = c, from[n][to] = at;
        }
    std::vector<float> cuts(size_t(count) + 1, far);
    size_t at = bin_count;
    for (size_t n = size_t(count); n > 0; --n) {
        at = from[n][at];
        cuts[n - 1] = near + (far - near) * float(at) / float(bin_count);
    }
    return cuts;
}

/// Between the light and a hundredth of the depth that is lit from it, one slice will do for logarithms.
float scaled(float depth, float far, bool logarithmic) { return logarithmic ? std::log(std::max(depth, 0.01f * far)) : depth; }

std::vector<float> make_cuts(const std::vector<Interval>& content, int count, int placement, bool logarithmic)
{
    Interval all{infinity, -infinity};
    for (const Interval& i : content) all.near = std::min(all.near, i.near), all.far = std::max(all.far, i.far);
    const float near = scaled(all.near, all.far, logarithmic), far = scaled(all.far, all.far, logarithmic);
    std::vector<float> cuts;
    if (placement == PLACE_FITTED) {
        std::vector<Interval> scaled_content;
        for (const Interval& i : content)
            scaled_content.push_back({scaled(i.near, all.far, logarithmic), scaled(i.far, all.far, logarithmic)});
        cuts = fitted_cuts(scaled_content, count, near, far);
    } else {
        for (int i = 0; i <= count; ++i) cuts.push_back(near + (far - near) * float(i) / float(count));
    }
    if (logarithmic)
        for (float& c : cuts) c = std::exp(c);
    // depths of what is drawn round otherwise than those of boxes
    const float slack = std::max(1e-4f * (all.far - all.near), 1e-5f * all.far);
    cuts.front() = all.near - slack, cuts.back() = all.far + slack;
    return cuts;
}

float stored_from_depth(const LightMapLayer& layer, float depth)
{
    if (layer.perspective == 0) return (layer.far - depth) / (layer.far - layer.near);
    return layer.near / (layer.far - layer.near) * (layer.far / std::max(depth, 1e-20f) - 1.0f);
}

} // namespace

std::vector<Bounds> caster_boxes(const scene::Scene& s)
{
    std::vector<Bounds> boxes;
    for (const scene::Instance& instance : s.instances) {
        const scene::Mesh& mesh = s.meshes[size_t(instance.mesh)];
        if (mesh.triangle_count() == 0 || s.materials[size_t(mesh.material)].alpha == scene::AlphaMode::blend) continue;
        Bounds box;
        for (const vec3 corner : shadow::parts::corners(mesh.bounds)) box.add(vec3(instance.world_from_object * vec4(corner, 1)));
        boxes.push_back(box);
    }
    return boxes;
}

shadow::Planes panel_plane(const scene::Light& light)
{
    if (const auto* rect = std::get_if<scene::RectLight>(&light.shape)) {
        const vec3 n = glm::normalize(glm::cross(rect->half_u, rect->half_v));
        return {vec4(n, -glm::dot(n, rect->centre))};
    }
    if (const auto* disk = std::get_if<scene::DiskLight>(&light.shape)) return {vec4(disk->normal, -glm::dot(disk->normal, disk->centre))};
    return {};
}

std::vector<Interval> depths_in_layer(const std::vector<Bounds>& boxes, const LightMapLayer& layer, const shadow::Planes& more)
{
    shadow::Planes planes = shadow::parts::caster_planes(layer);
    planes.insert(planes.end(), more.begin(), more.end());
    std::vector<Interval> out;
    for (const Bounds& box : boxes) {
        std::vector<vec3> points = shadow::parts::corners(box);
        bool missed = false, cut = false;
        for (const vec4& plane : planes) {
            const auto before
                = std::count_if(points.begin(), points.end(), [&](vec3 p) { return glm::dot(vec3(plane), p) + plane.w < 0.0f; });
            missed = missed || before == 8, cut = cut || before > 0;
        }
        if (missed) continue;
        if (cut) points = shadow::parts::vertices_within(planes, box);
        if (points.empty()) continue;
        Interval depths{infinity, -infinity};
        for (const vec3 p : points) {
            const float depth = glm::dot(layer.depth_plane, vec4(p, 1));
            depths.near = std::min(depths.near, depth), depths.far = std::max(depths.far, depth);
        }
        out.push_back({std::clamp(depths.near, layer.near, layer.far), std::clamp(depths.far, layer.near, layer.far)});
    }
    return out;
}

std::vector<Interval> cut(const std::vector<Interval>& content, int count, int placement, bool perspective)
{
    std::vector<Interval> slices(size_t(count), {infinity, -infinity});
    if (content.empty()) return slices;
    const std::vector<float> cuts = make_cuts(content, count, placement, perspective && placement != PLACE_UNIFORM);
    const float slack = std::max(1e-4f * (cuts.back() - cuts.front()), 1e-5f * cuts.back());
    for (size_t s = 0; s < size_t(count); ++s) {
        Interval& slice = slices[s];
        for (const Interval& i : content)
            if (i.far + slack >= cuts[s] && i.near - slack <= cuts[s + 1]) {
                slice.near = std::min(slice.near, std::max(i.near - slack, cuts[s]));
                slice.far = std::max(slice.far, std::min(i.far + slack, cuts[s + 1]));
            }
        if (!(slice.near < slice.far)) slice = {infinity, -infinity};
    }
    return slices;
}

Slices place_slices(const std::vector<Bounds>& boxes, const LightMap& map, const shadow::Planes& planes, int count, int placement)
{
    Slices out;
    for (vec4& v : out.near) v = vec4(-1);
    for (vec4& v : out.far) v = vec4(-2);
    for (uint32_t l = 0; l < map.layer_count; ++l) {
        const LightMapLayer& layer = map.layers[l];
        const std::vector<Interval> slices = cut(depths_in_layer(boxes, layer, planes), count, placement, layer.perspective != 0);
        for (int s = 0; s < count; ++s) {
            const Interval& slice = slices[size_t(s)];
            if (slice.near > slice.far) continue;
            const uint32_t group = l * SLICE_GROUPS + uint32_t(s / 4);
            out.near[group][s % 4] = stored_from_depth(layer, slice.near);
            out.far[group][s % 4] = stored_from_depth(layer, slice.far);
        }
    }
    return out;
}

} // namespace gnomon::techniques::occlusion_textures
