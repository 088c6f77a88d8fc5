// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"

#include "base/error.h"

namespace gnomon::gpu {

namespace {
struct Point {
    float x, y, z;
};
}

/// Two instances of one triangle (apex up, as wide as the picture): one at z = 0 scaled to half, one behind it at z = -1, not opaque.
class GpuRay : public DeviceTest {
protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        const DeviceInfo& info = device().info();
        if (!info.ray_query && !info.ray_tracing_pipeline) GTEST_SKIP() << "the device has no acceleration structures";
        const std::vector<Point> points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
        const std::vector<uint32_t> indices = {0, 1, 2};
        positions_ = storage<Point>("positions", points);
        indices_ = storage<uint32_t>("indices", indices);
        BlasDesc desc{positions_.address(), 12, 3, indices_.address(), 1, true, "opaque"};
        opaque_ = device().build_blas(desc);
        desc.opaque = false;
        desc.name = "masked";
        masked_ = device().build_blas(desc);
        const std::vector<TlasInstance> instances
            = {{&opaque_, {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, 0}, 4}, {&masked_, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1}, 5, 0xff, 1}};
        top_ = device().build_tlas(instances);
        EXPECT_GT(top_.bytes(), 0u);
    }
    Buffer positions_, indices_;
    AccelerationStructure opaque_, masked_, top_;
};

TEST_F(GpuRay, QueriesInCompute)
{
    if (!device().info().ray_query) GTEST_SKIP() << "the device has no ray queries";
    Image out = image("hits", VK_FORMAT_R32_SFLOAT, {16, 16});
    PassList list(device());
    list.compute({"query", &device().compute_program("tests/gpu/query.comp"), {top_, {list.import(out), Use::store}}, {}, {16, 16, 1}});
    device().submit(std::move(list));
    const base::Picture hits = device().read_back(out);
    EXPECT_EQ(hits.at(8, 8), 5.0f); // the small one, opaque: custom index 4
    EXPECT_EQ(hits.at(1, 15), 2.0f); // the large one's triangle is a candidate only
    EXPECT_EQ(hits.at(0, 0), 0.0f);
}

TEST_F(GpuRay, PipelinesTrace)
{
    if (!device().info().ray_tracing_pipeline) GTEST_SKIP() << "the device has no ray-tracing pipelines";
    const std::string_view miss[] = {"tests/gpu/trace.rmiss"};
    const HitShaders hits[] = {{"tests/gpu/trace.rchit", ""}, {"tests/gpu/trace.rchit", "tests/gpu/holes.rahit"}};
    const Program& program = device().ray_program("tests/gpu/trace.rgen", miss, hits);
    EXPECT_EQ(&program, &device().ray_program("tests/gpu/trace.rgen", miss, hits));
    Image out = image("hits", VK_FORMAT_R32_SFLOAT, {16, 16});
    PassList list(device());
    list.trace({"trace", &program, {top_, {list.import(out), Use::store}}, 2.0f, {16, 16, 1}});
    const Submitted done = device().submit(std::move(list));
    EXPECT_EQ(done.times.size(), 1u);
    const base::Picture picture = device().read_back(out);
    EXPECT_EQ(picture.at(8, 8), 10.0f); // 2 x (1 + 4)
    EXPECT_EQ(picture.at(14, 15), 12.0f); // the large one's right half: 2 x (1 + 5)
    EXPECT_EQ(picture.at(1, 15), 0.0f); // its left half has a hole
    EXPECT_EQ(picture.at(0, 0), 0.0f);
}

} // namespace gnomon::gpu
