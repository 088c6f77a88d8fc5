// SPDX-License-Identifier: Apache-2.0
// Where a layered variance map puts its layers: the two compute passes against a twin in double, on depths made up here.
#include "device_fixture.h"

#include "techniques/lvsm/lvsm.shared.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

using Counts = std::vector<uint32_t>;

/// Depth layers whose stored value is 1 - d at a depth d between 0 and 1 of the range: orthographic, reversed.
shaders::LightMapLayer unit_layer()
{
    shaders::LightMapLayer layer{};
    layer.near = 0.0f, layer.far = 1.0f;
    return layer;
}

Counts count(const std::vector<base::Picture>& stored)
{
    Counts counts(LVSM_BINS);
    for (const base::Picture& p : stored)
        for (const float z : p.values)
            if (z != 0.0f) ++counts[size_t(std::clamp(int((1.0f - z) * LVSM_BINS), 0, LVSM_BINS - 1))];
    return counts;
}

/// Number and sum of the places of texels between two places (in bins), spread evenly within each bin.
std::pair<double, double> between(const Counts& counts, double begin, double end)
{
    double number = 0, total = 0;
    for (int i = int(begin); i < int(std::ceil(end)); ++i) {
        const double share = (std::min(end, i + 1.0) - std::max(begin, double(i))) * double(counts[size_t(i)]);
        number += share, total += share * (i + 0.5);
    }
    return {number, total};
}

/// Lloyd's relaxation as Lauritzen and McCool (2008) describe it: every boundary goes to the middle between the means beside it.
std::vector<double> lloyd(const Counts& counts, int layers)
{
    int first = 0, last = LVSM_BINS - 1;
    while (first < LVSM_BINS && counts[size_t(first)] == 0) ++first;
    while (last >= 0 && counts[size_t(last)] == 0) --last;
    if (last - first < 4 * layers) first = 0, last = LVSM_BINS - 1;
    std::vector<double> edge;
    for (int i = 0; i <= layers; ++i) edge.push_back(first + double(last + 1 - first) * i / layers);
    for (int round = 0; round < 32; ++round) {
        std::vector<double> means;
        for (int i = 0; i < layers; ++i) {
            const double begin = edge[size_t(i)];
            const auto [number, total] = between(counts, begin, edge[size_t(i) + 1]);
            means.push_back(number > 0.5 ? total / number : 0.5 * (begin + edge[size_t(i) + 1]));
            if (i > 0) edge[size_t(i)] = 0.5 * (means[size_t(i) - 1] + means[size_t(i)]);
        }
    }
    for (double& e : edge) e = 2 * e / LVSM_BINS - 1;
    edge.front() = -1, edge.back() = 1;
    return edge;
}

class LvsmLayers : public gpu::DeviceTest {
protected:
    struct Placed {
        Counts counts;
        std::vector<float> bounds;
    };

    /// As the technique does: histograms of all layers of the map in one, then one invocation.
    static Placed place(const std::vector<base::Picture>& stored, int layers, int split)
    {
        gpu::Image depth = image("depth", VK_FORMAT_R32_SFLOAT, stored[0].size, uint32_t(stored.size()));
        for (uint32_t i = 0; i < stored.size(); ++i) device().upload(depth, std::as_bytes(std::span(stored[i].values)), i);
        gpu::Buffer counts = storage<uint32_t>("counts", size_t(LVSM_BINS)), bounds = storage<float>("bounds", size_t(LVSM_MAX_LAYERS + 1));
        gpu::PassList list(device());
        const gpu::BufferId counts_id = list.import(counts);
        list.fill(counts_id, 0);
        const uint32_t groups = (uint32_t(stored[0].size.width) + 63) / 64;
        for (uint32_t i = 0; i < stored.size(); ++i)
            list.compute({.name = "histogram",
                .program = &device().compute_program("techniques/lvsm/lvsm_histogram.comp"),
                .bindings
                = {gpu::Binding(list.import(depth), gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {counts_id, gpu::Use::update}},
                .constants = techniques::lvsm::HistogramConstants{{unit_layer(), int(i)}},
                .threads = {16 * groups, 16 * groups, 1}});
        techniques::lvsm::Params params;
        params.layers = layers, params.split = split;
        list.compute({.name = "place layers",
            .program = &device().compute_program("techniques/lvsm/lvsm_place.comp"),
            .bindings = {{counts_id, gpu::Use::load}, {list.import(bounds), gpu::Use::store}},
            .constants = techniques::lvsm::PlaceConstants{params}});
        device().submit(std::move(list));
        Placed out = {values<uint32_t>(counts), values<float>(bounds)};
        out.bounds.resize(size_t(layers) + 1);
        return out;
    }

    /// Increasing, and none thinner than twice the default least deviation, which would make its Chebyshev bound useless.
    static void expect_valid(const std::vector<float>& bounds)
    {
        EXPECT_EQ(bounds.front(), -1.0f);
        EXPECT_EQ(bounds.back(), 1.0f);
        for (size_t i = 1; i < bounds.size(); ++i) EXPECT_GT(bounds[i], bounds[i - 1] + 0.002f) << i;
    }
};

/// Depths around a few places, as parts of the range, and empty texels between them.
std::vector<base::Picture> clusters(const std::vector<float>& centres, float deviation, int size, uint32_t layers)
{
    std::mt19937 random(1);
    std::normal_distribution<float> around(0.0f, deviation);
    std::vector<base::Picture> out(layers, base::Picture({size, size}, 1));
    for (base::Picture& p : out)
        for (float& z : p.values)
            if (random() % 4) z = 1.0f - std::clamp(centres[random() % centres.size()] + around(random), 0.001f, 0.999f);
    return out;
}

TEST_F(LvsmLayers, HistogramCountsAllTexelsThatHoldSomething)
{
    for (const int size : {16, 100, 256}) { // 100: groups of 64 reach over the rim
        const std::vector<base::Picture> stored = clusters({0.1f, 0.45f, 0.9f}, 0.03f, size, 6);
        const Counts expected = count(stored), got = place(stored, 3, 1).counts;
        for (size_t i = 0; i < got.size(); ++i) ASSERT_EQ(got[i], expected[i]) << "bin " << i << ", map of " << size;
    }
}

TEST_F(LvsmLayers, LloydsRelaxationIsThatOfTheTwin)
{
    const std::vector<base::Picture> stored = clusters({0.1f, 0.2f, 0.55f, 0.9f}, 0.04f, 128, 2);
    for (int layers = 1; layers <= LVSM_MAX_LAYERS; ++layers) {
        const Placed placed = place(stored, layers, 1);
        const std::vector<double> expected = lloyd(placed.counts, layers);
        expect_valid(placed.bounds);
        // Sums go up to 2^24 texels times bins, where a float's step is 2: layers of a thousand texels have means good to a few thousandths
        // of a bin, which is 2 / 1024 of the centred range.
        for (size_t i = 0; i < placed.bounds.size(); ++i) EXPECT_NEAR(double(placed.bounds[i]), expected[i], 2e-5) << i << " of " << layers;
    }
}

TEST_F(LvsmLayers, BoundariesFallBetweenClusters)
{
    const Placed placed = place(clusters({0.15f, 0.4f, 0.4f, 0.8f}, 0.01f, 128, 1), 3, 1);
    expect_valid(placed.bounds);
    // in the middle between two clusters' means, to their own deviation
    EXPECT_NEAR(placed.bounds[1], 2.0f * 0.275f - 1.0f, 0.01f);
    EXPECT_NEAR(placed.bounds[2], 2.0f * 0.6f - 1.0f, 0.01f);
}

TEST_F(LvsmLayers, FewDepthsAndNoneGiveValidBounds)
{
    const auto flat = [](float z) { return std::vector{base::Picture({64, 64}, 1, z)}; };
    for (int layers = 1; layers <= LVSM_MAX_LAYERS; ++layers)
        for (const float stored : {0.0f, 1.0f, 0.5f, 0.0009f}) { // nothing; on the near plane; in the middle; before the far plane
            SCOPED_TRACE(std::to_string(layers) + " layers, all stored depths " + std::to_string(stored));
            expect_valid(place(flat(stored), layers, 1).bounds);
        }
}

TEST_F(LvsmLayers, UniformLayersDoNotLookAtDepths)
{
    const std::vector<base::Picture> stored = clusters({0.2f}, 0.01f, 64, 1);
    for (int layers = 1; layers <= LVSM_MAX_LAYERS; ++layers) {
        const std::vector<float> bounds = place(stored, layers, 0).bounds;
        for (int i = 0; i <= layers; ++i) EXPECT_NEAR(bounds[size_t(i)], 2.0f * float(i) / float(layers) - 1.0f, 1e-6f);
    }
}

} // namespace
} // namespace gnomon
