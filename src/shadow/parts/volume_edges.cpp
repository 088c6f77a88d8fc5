// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <numeric>

namespace gnomon::shadow::parts {

namespace {

/// For each vertex the first one at the same position.
std::vector<uint32_t> weld(std::span<const vec3> positions)
{
    const auto bits = [&](uint32_t v) { // -0 is 0
        const vec3 p = positions[v] + vec3(0.0f);
        return std::array{std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z), v};
    };
    std::vector<uint32_t> order(positions.size()), first(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return bits(a) < bits(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        const auto here = bits(order[i]);
        const bool same = i > 0 && std::equal(here.begin(), here.begin() + 3, bits(order[i - 1]).begin());
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

/// One side of one triangle.
struct Side {
    uint32_t low, high; ///< vertices
    uint32_t triangle; ///< as in VolumeEdge: backwards where it runs from high to low
    auto operator<=>(const Side&) const = default;
};

std::vector<Side> sides_of(std::span<const vec3> positions, std::span<const uint32_t> indices)
{
    const std::vector<uint32_t> first = weld(positions);
    std::vector<Side> sides;
    sides.reserve(indices.size());
    for (size_t t = 0; t + 2 < indices.size(); t += 3) {
        const std::array<uint32_t, 3> v{first[indices[t]], first[indices[t + 1]], first[indices[t + 2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = v[k], to = v[(k + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), uint32_t(t / 3 * 2) + uint32_t(from > to)});
        }
    }
    std::sort(sides.begin(), sides.end());
    return sides;
}

} // namespace

MeshEdges mesh_edges(std::span<const vec3> positions, std::span<const uint32_t> indices)
{
    const std::vector<Side> sides = sides_of(positions, indices);
    MeshEdges out;
    for (size_t begin = 0; begin < sides.size();) {
        size_t end = begin + 1;
        while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
        const size_t count = end - begin;
        shaders::VolumeEdge edge{sides[begin].low, sides[begin].high, sides[begin].triangle, VOLUME_ALONE};
        if (count == 2) edge.second = sides[begin + 1].triangle;
        if (count > 2) {
            edge.first = uint32_t(out.list.size()), edge.second = VOLUME_LIST + uint32_t(count);
            for (size_t i = begin; i < end; ++i) out.list.push_back(sides[i].triangle);
        }
        out.edges.push_back(edge);
        begin = end;
    }
    return out;
}

} // namespace gnomon::shadow::parts
