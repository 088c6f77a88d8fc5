// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"

namespace gnomon::gpu {

namespace {

struct Point {
    float x, y, z;
};
struct Color {
    float r, g, b, a;
};
constexpr Color red{1, 0, 0, 1}, green{0, 1, 0, 1};

/// Counter-clockwise as seen with y up; the apex is on top.
std::vector<Point> triangle(float z) { return {{-1, -1, z}, {1, -1, z}, {0, 1, z}}; }

VertexStream points() { return {sizeof(Point), {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}}}; }

} // namespace

class GpuRaster : public DeviceTest {
protected:
    static RasterPass pass(const char* name, const Buffer& vertices, Color color)
    {
        RasterPass p;
        p.name = name;
        p.program = &device().raster_program("tests/gpu/mesh.vert", "tests/gpu/flat.frag");
        p.constants = color;
        p.streams = {points()};
        p.draw = [&vertices](Encoder& e) {
            e.vertex_buffer(0, vertices);
            e.draw(3);
        };
        return p;
    }
    static Buffer vertices(float z)
    {
        const std::vector<Point> list = triangle(z);
        Buffer b = device().buffer({list.size() * sizeof(Point), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Memory::device, "vertices"});
        device().upload(b, std::as_bytes(std::span(list)));
        return b;
    }
    static ColorTarget target(ImageId id, Load load = Load::clear)
    {
        ColorTarget t;
        t.image = id;
        t.load = load;
        return t;
    }
};

TEST_F(GpuRaster, CounterClockwiseIsFrontUnderAFlippedProjection)
{
    const Buffer corners = vertices(0.5f);
    for (const VkCullModeFlags cull : {VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_BIT}) {
        Image out = image("out", VK_FORMAT_R8G8B8A8_UNORM, {16, 16});
        PassList list(device());
        RasterPass p = pass("triangle", corners, red);
        p.colors = {target(list.import(out))};
        p.cull = cull;
        list.raster(std::move(p));
        device().submit(std::move(list));
        const base::Picture picture = device().read_back(out);
        EXPECT_EQ(picture.at(8, 8, 0), cull == VK_CULL_MODE_BACK_BIT ? 1.0f : 0.0f);
        EXPECT_EQ(picture.at(1, 1, 0), 0.0f); // row 0 is on top, beside the apex
        EXPECT_EQ(picture.at(1, 15, 0), cull == VK_CULL_MODE_BACK_BIT ? 1.0f : 0.0f);
    }
}

TEST_F(GpuRaster, NearerWinsWithReversedDepth)
{
    const Buffer near = vertices(0.9f), far = vertices(0.1f);
    Image out = image("out", VK_FORMAT_R8G8B8A8_UNORM, {8, 8}), depth = image("depth", VK_FORMAT_D32_SFLOAT, {8, 8});
    PassList list(device());
    const ImageId out_id = list.import(out), depth_id = list.import(depth);
    for (const bool first : {true, false}) {
        RasterPass p = pass(first ? "near" : "far", first ? near : far, first ? red : green);
        p.colors = {target(out_id, first ? Load::clear : Load::keep)};
        p.depth = DepthTarget{};
        p.depth->image = depth_id;
        p.depth->load = first ? Load::clear : Load::keep;
        list.raster(std::move(p));
    }
    device().submit(std::move(list));
    EXPECT_EQ(device().read_back(out).at(4, 4, 0), 1.0f);
    EXPECT_EQ(device().read_back(out).at(4, 4, 1), 0.0f);
    EXPECT_NEAR(device().read_back(depth).at(4, 4), 0.9f, 1e-6f);
    EXPECT_EQ(device().read_back(depth).at(0, 0), 0.0f);
}

TEST_F(GpuRaster, LayersFromTheVertexShader)
{
    const Buffer corners = vertices(0.25f);
    Image depth = image("maps", VK_FORMAT_D32_SFLOAT, {8, 8}, 4);
    PassList list(device());
    RasterPass p;
    p.name = "layers";
    p.program = &device().raster_program("tests/gpu/layer.vert", "");
    p.streams = {points()};
    p.layers = 3;
    p.depth = DepthTarget{};
    p.depth->image = list.import(depth);
    p.depth->layer = 1;
    p.draw = [&](Encoder& e) {
        e.vertex_buffer(0, corners);
        e.draw(3, 3);
    };
    list.raster(std::move(p));
    device().submit(std::move(list));
    for (uint32_t layer = 0; layer < 3; ++layer)
        EXPECT_NEAR(device().read_back(depth, layer + 1).at(4, 4), 0.25f * float(layer + 1), 1e-6f);
}

TEST_F(GpuRaster, MultiviewFillsItsLayers)
{
    if (!device().info().multiview) GTEST_SKIP() << "the device has no multiview";
    const Buffer corners = vertices(0.25f);
    Image depth = image("views", VK_FORMAT_D32_SFLOAT, {8, 8}, 3);
    PassList list(device());
    RasterPass p;
    p.name = "views";
    p.program = &device().raster_program("tests/gpu/view.vert", "");
    p.streams = {points()};
    p.view_mask = 0b111;
    p.depth = DepthTarget{};
    p.depth->image = list.import(depth);
    p.draw = [&](Encoder& e) {
        e.vertex_buffer(0, corners);
        e.draw(3);
    };
    list.raster(std::move(p));
    device().submit(std::move(list));
    for (uint32_t layer = 0; layer < 3; ++layer) EXPECT_NEAR(device().read_back(depth, layer).at(4, 4), 0.25f * float(layer + 1), 1e-6f);
}

TEST_F(GpuRaster, BlendAddsAndLeftOutTargetsAreDropped)
{
    const Buffer corners = vertices(0.5f);
    Image out = image("sum", VK_FORMAT_R16G16B16A16_SFLOAT, {8, 8});
    VkPipelineColorBlendAttachmentState add{};
    add.blendEnable = VK_TRUE;
    add.srcColorBlendFactor = add.dstColorBlendFactor = add.srcAlphaBlendFactor = add.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    add.colorWriteMask = 0xf;
    PassList list(device());
    const ImageId id = list.import(out);
    for (int i = 0; i < 3; ++i) {
        RasterPass p = pass("add", corners, {0.5f, 0.25f, 0, 1});
        p.colors = {target(id, i ? Load::keep : Load::clear)};
        p.colors[0].blend = add;
        list.raster(std::move(p));
    }
    RasterPass p = pass("left out", corners, red);
    p.colors = {ColorTarget{}};
    p.size = {8, 8};
    list.raster(std::move(p));
    device().submit(std::move(list));
    EXPECT_EQ(device().read_back(out).at(4, 4, 0), 1.5f);
    EXPECT_EQ(device().read_back(out).at(4, 4, 1), 0.75f);
}

TEST_F(GpuRaster, SamplesResolveToAnAverage)
{
    const Buffer corners = vertices(0.5f);
    ImageDesc desc{VK_FORMAT_R8G8B8A8_UNORM, {16, 16}, 1, 1, VK_SAMPLE_COUNT_4_BIT, false, "samples"};
    Image out = image("resolved", VK_FORMAT_R8G8B8A8_UNORM, {16, 16});
    PassList list(device());
    RasterPass p = pass("msaa", corners, red);
    p.colors = {target(list.transient(desc))};
    p.colors[0].resolve = list.import(out);
    list.raster(std::move(p));
    const Submitted done = device().submit(std::move(list));
    EXPECT_GE(done.transient_bytes, 16u * 16 * 4 * 4);
    const base::Picture picture = device().read_back(out);
    int partial = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) partial += picture.at(x, y, 0) > 0.0f && picture.at(x, y, 0) < 1.0f;
    EXPECT_GE(partial, 8);
    EXPECT_EQ(picture.at(8, 12, 0), 1.0f);
}

TEST_F(GpuRaster, StencilCountsAndTests)
{
    const Buffer corners = vertices(0.5f);
    Image out = image("out", VK_FORMAT_R8G8B8A8_UNORM, {8, 8}), depth = image("depth", VK_FORMAT_D32_SFLOAT_S8_UINT, {8, 8});
    PassList list(device());
    const ImageId out_id = list.import(out), depth_id = list.import(depth);
    RasterPass count = pass("count", corners, red);
    count.depth = DepthTarget{};
    count.depth->image = depth_id;
    count.depth->write = false;
    count.depth->stencil = true;
    count.depth->front = {VK_STENCIL_OP_KEEP, VK_STENCIL_OP_INCREMENT_AND_WRAP, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_ALWAYS, 0xff, 0xff, 0};
    count.depth->back = count.depth->front;
    count.colors = {target(out_id)};
    RasterPass fill = count;
    fill.name = "fill";
    fill.constants = Constants(green);
    fill.colors = {target(out_id, Load::keep)};
    fill.depth->load = Load::keep;
    fill.depth->front = {VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_EQUAL, 0xff, 0xff, 2};
    fill.depth->back = fill.depth->front;
    count.draw = [&](Encoder& e) {
        e.vertex_buffer(0, corners);
        e.draw(3, 2);
    };
    list.raster(std::move(count));
    list.raster(std::move(fill));
    device().submit(std::move(list));
    EXPECT_EQ(device().read_back(out).at(4, 4, 1), 1.0f);
    EXPECT_EQ(device().read_back(out).at(0, 0, 1), 0.0f);
}

TEST_F(GpuRaster, CompareSamplersAreReversed)
{
    const Buffer corners = vertices(0.5f);
    Image map = image("map", VK_FORMAT_D32_SFLOAT, {8, 8});
    Buffer lit = storage<float>("lit", 3);
    for (const Sampler sampler : {Sampler::compare_nearest, Sampler::compare_linear}) {
        PassList list(device());
        RasterPass p = pass("map", corners, red);
        p.program = &device().raster_program("tests/gpu/mesh.vert", "");
        p.constants = {};
        p.depth = DepthTarget{};
        p.depth->image = list.import(map);
        list.raster(std::move(p));
        list.compute({"compare", &device().compute_program("tests/gpu/compare.comp"),
            {{list.import(map), Use::sample, sampler}, {list.import(lit), Use::store}}});
        device().submit(std::move(list));
        EXPECT_EQ(values<float>(lit), (std::vector<float>{0, 1, 1}));
    }
}

} // namespace gnomon::gpu
