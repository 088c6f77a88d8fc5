// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "truth/cache.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <thread>
#include <unistd.h>

using namespace gnomon;
using namespace truth_test;
namespace fs = std::filesystem;

namespace {

struct TruthCache : testing::Test {
    fs::path folder = fs::temp_directory_path() / fmt::format("gnomon_truth_{}", ::getpid());
    scene::Scene s = scene_of({level_quad(-4, 4, -4, 4, 0), level_quad(-1, 1, -1, 1, 1)});
    scene::View view = look(s, {1, 3, 3}, {0, 0, 0}, {24, 16});
    scene::Light light = light_of(scene::PointLight{vec3(0.2f, 5, 0), 0.5f});
    truth::Settings settings{16, 1, 0};

    void TearDown() override { fs::remove_all(folder); }
    truth::Reference get() const { return truth::reference(s, view, light, settings, truth::Quantity::visibility, folder); }
    std::vector<fs::path> entries() const
    {
        std::vector<fs::path> found;
        for (const auto& e : fs::directory_iterator(folder)) found.push_back(e.path());
        return found;
    }
};

void expect_same(const truth::Reference& a, const truth::Reference& b)
{
    EXPECT_EQ(a.primary.depth.values, b.primary.depth.values);
    EXPECT_EQ(a.primary.position.values, b.primary.position.values);
    EXPECT_EQ(a.primary.normal.values, b.primary.normal.values);
    EXPECT_EQ(a.primary.primitive, b.primary.primitive);
    EXPECT_EQ(a.visibility.mean.values, b.visibility.mean.values);
    EXPECT_EQ(a.visibility.variance.values, b.visibility.variance.values);
    EXPECT_EQ(a.visibility.samples, b.visibility.samples);
}

} // namespace

TEST_F(TruthCache, the_second_time_comes_from_the_disk)
{
    const truth::Reference first = get(), second = get();
    EXPECT_FALSE(first.from_cache);
    EXPECT_GT(first.trace_ms, 0.0);
    EXPECT_TRUE(second.from_cache);
    EXPECT_EQ(second.trace_ms, 0.0);
    expect_same(first, second);
    const auto colored = [&] { return truth::reference(s, view, light, settings, truth::Quantity::transmittance, folder); };
    EXPECT_FALSE(colored().from_cache);
    EXPECT_EQ(colored().visibility.mean.channels, 3);
    EXPECT_TRUE(colored().from_cache);
}

TEST_F(TruthCache, a_damaged_entry_is_traced_again_and_healed)
{
    const truth::Reference first = get();
    ASSERT_EQ(entries().size(), 1u);
    const fs::path path = entries()[0];
    const std::vector<std::byte> whole = base::read_file(path);
    for (const size_t at : {size_t(0), size_t(9), size_t(13), size_t(40), size_t(100), whole.size() - 1}) {
        std::vector<std::byte> bytes = whole;
        bytes[at] ^= std::byte(4);
        base::write_file(path, bytes);
        const truth::Reference again = get();
        EXPECT_FALSE(again.from_cache) << at;
        expect_same(first, again);
        EXPECT_TRUE(get().from_cache) << "not healed";
    }
    for (const size_t length : {size_t(0), size_t(10), size_t(60), whole.size() / 2}) {
        base::write_file(path, std::span(whole).first(length));
        EXPECT_FALSE(get().from_cache) << length;
    }
    fs::remove(path);
    fs::create_directory(path); // not even a file
    expect_same(first, get());
}

TEST_F(TruthCache, whatever_changes_the_result_changes_the_key)
{
    const auto key = [&] { return truth::cache_key(s, view, light, settings, truth::Quantity::visibility); };
    std::vector<std::string> keys{key()};
    const auto changed = [&](const char* what) {
        EXPECT_EQ(std::count(keys.begin(), keys.end(), key()), 0) << what;
        keys.push_back(key());
    };
    s.meshes[1].positions[0].x += 1e-6f;
    changed("a vertex");
    std::swap(s.meshes[1].indices[0], s.meshes[1].indices[1]);
    changed("an index");
    s.instances[1].world_from_object[3][1] += 0.1f;
    changed("a placement");
    s.materials[0].double_sided = false;
    changed("sidedness");
    s.materials[0].alpha = scene::AlphaMode::mask;
    changed("the alpha mode");
    s.materials[0].alpha_cutoff = 0.4f;
    changed("the cutoff");
    s.textures.push_back({"t", 1, 1, {255, 255, 255, 255}, true, true, scene::Wrap::repeat, scene::Wrap::repeat});
    s.materials[0].base_color_texture.texture = 0;
    changed("a texture");
    s.textures[0].rgba[3] = 7;
    changed("a texel");
    std::get<scene::PointLight>(light.shape).radius = 0.4f;
    changed("the light");
    light.shape = scene::DiskLight{};
    changed("its kind");
    settings.samples = 64;
    changed("samples");
    settings.seed = 2;
    changed("the seed");
    view = look(s, {1, 3, 3}, {0, 0.1f, 0}, {24, 16});
    changed("the view");
    view.size.width = 25;
    changed("the size");

    const std::string before = key();
    light.name = "other", light.color = vec3(0.5f), light.intensity = 3.0f, s.name = "other";
    settings.samples = 60; // also 8 x 8 strata
    settings.threads = 1;
    EXPECT_EQ(key(), before) << "names, colours and thread counts change nothing";
}

TEST_F(TruthCache, a_folder_that_cannot_be_written_costs_only_the_cache)
{
    folder = "/proc/gnomon_cache";
    EXPECT_FALSE(get().visibility.mean.empty());
}

TEST_F(TruthCache, the_longest_unused_entries_go_first)
{
    fs::create_directories(folder);
    const std::vector<std::byte> data(1000);
    for (const char* name : {"a.truth", "b.truth", "c.truth"}) {
        base::write_file(folder / name, data);
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
    base::write_text(folder / "other.txt", "not an entry");
    fs::last_write_time(folder / "a.truth", fs::file_time_type::clock::now()); // used again
    truth::prune(folder, 2500);
    EXPECT_TRUE(fs::exists(folder / "a.truth"));
    EXPECT_FALSE(fs::exists(folder / "b.truth"));
    EXPECT_TRUE(fs::exists(folder / "c.truth"));
    truth::prune(folder, 0);
    EXPECT_EQ(entries(), std::vector<fs::path>{folder / "other.txt"});
    truth::prune(folder / "none", 0);
}
