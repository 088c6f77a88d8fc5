// SPDX-License-Identifier: Apache-2.0
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

// Runs examples/host_engine, which knows Gnomon as installed and nothing else, under validation with synchronisation validation; a message
// of the layer fails the run.
namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

struct Pixels {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;
};

Pixels read_ppm(const fs::path& path)
{
    Pixels p;
    std::ifstream file(path, std::ios::binary);
    std::string magic;
    int most = 0;
    file >> magic >> p.width >> p.height >> most;
    file.get();
    p.rgb.assign(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(magic, "P6");
    EXPECT_EQ(p.rgb.size(), size_t(p.width) * size_t(p.height) * 3);
    return p;
}

/// The share of pixels that differ by more than 8 of 255 in a channel.
double differing(const Pixels& a, const Pixels& b)
{
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    size_t count = 0;
    for (size_t i = 0; i + 2 < std::min(a.rgb.size(), b.rgb.size()); i += 3) {
        int most = 0;
        for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a.rgb[i + c]) - int(b.rgb[i + c])));
        count += most > 8;
    }
    return double(count) / double(a.rgb.size() / 3);
}

fs::path scratch()
{
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    const fs::path folder = fs::path(HOST_ENGINE).parent_path() / "runs" / name;
    fs::create_directories(folder);
    return folder;
}

/// What it said, where it failed; "" otherwise.
std::string engine(const std::string& arguments, const std::string& before = {})
{
    const fs::path log = scratch() / "log.txt";
    const int status = std::system((before + HOST_ENGINE " --validation " + arguments + " >'" + log.string() + "' 2>&1").c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    std::ifstream file(log);
    return arguments + ": " + std::string(std::istreambuf_iterator<char>(file), {}) + " (ended with " + std::to_string(status) + ")";
}

Pixels picture(const std::string& arguments)
{
    const fs::path file = scratch() / "picture.ppm";
    fs::remove(file);
    EXPECT_EQ(engine("--headless --size 192x120 --frames 6 --output '" + file.string() + "' " + arguments), "");
    return read_ppm(file);
}

double darker_than(const Pixels& p, int limit)
{
    size_t count = 0;
    for (size_t i = 0; i + 2 < p.rgb.size(); i += 3) count += std::max({p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]}) < limit;
    return double(count) / double(p.rgb.size() / 3);
}

TEST(HostEngine, MapVolumeAndSoftTechniquesShadeTheSameScene)
{
    for (const std::string light : {"sun", "lamp"}) {
        const Pixels volumes = picture("--technique shadow_volumes --light " + light);
        const Pixels map = picture("--technique shadow_map --light " + light);
        const Pixels soft = picture("--technique pcss --light " + light);
        // Without shadows or without light, any two would agree.
        EXPECT_GT(darker_than(volumes, 110), 0.05);
        EXPECT_LT(darker_than(volumes, 110), 0.7);
        EXPECT_LT(differing(map, volumes), 0.02) << light;
        EXPECT_LT(differing(soft, volumes), 0.15) << light;
        EXPECT_GT(differing(soft, volumes), 0.01) << light << ": no penumbra";
    }
}

struct Variant {
    const char* name;
    const char* arguments;
    double bound; ///< on the share of pixels that differ from the first convention's
};
void PrintTo(const Variant& v, std::ostream* out) { *out << v.name; }

// Conventions do not change the shadow: rounding moves single pixels at edges, up to 5 of these 23040. Normals
// that are made from the depth are those of facets, which moves the terminator of what is round by as much as a pixel. Four samples a pixel
// smooth the edges of everything, which is 7 % of so small a picture.
constexpr Variant variants[] = {
    {"z_up", "--up z", 0.001},
    {"left_handed", "--hand left --front clockwise", 0.001},
    {"centimetres", "--up z --hand left --unit 0.01 --vertices packed --normals octahedral", 0.001},
    {"forward", "--depth forward --clip y_up", 0.001},
    {"forward24", "--depth forward24 --normals none", 0.02},
    {"multisampled", "--samples 4 --normals bytes", 0.1},
};

class Conventions : public ::testing::TestWithParam<Variant> { };

TEST_P(Conventions, DoNotChangeTheShadow)
{
    for (const std::string technique : {"shadow_map", "shadow_volumes", "pcss"}) {
        const Pixels reference = picture("--technique " + technique);
        EXPECT_LT(differing(picture("--technique " + technique + " " + GetParam().arguments), reference), GetParam().bound) << technique;
    }
}
INSTANTIATE_TEST_SUITE_P(HostEngine, Conventions, ::testing::ValuesIn(variants), [](const auto& variant) { return variant.param.name; });

TEST(HostEngine, ChangesSizeAndTechniqueAndEndsInAnyOrder)
{
    const Pixels reference = picture("--technique pcss --frames 18");
    for (const std::string seed : {"1", "2", "3"})
        EXPECT_EQ(differing(picture("--technique shadow_map,shadow_volumes,pcss --frames 18 --hold 6 --resize-every 4 --shuffle " + seed),
                      reference),
            0)
            << "the last frame has the first size, the third technique, and remembers nothing of what was before";
}

TEST(HostEngine, ShowsItInAWindow)
{
    if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0) GTEST_SKIP() << "xvfb-run is not installed (Debian: xvfb, xauth)";
    const fs::path file = scratch() / "window.ppm";
    const std::string said = engine("--size 192x120 --frames 18 --hold 6 --resize-every 4 --shuffle 4 --output '" + file.string() + "'",
        "xvfb-run -a -s '-screen 0 640x480x24' ");
    if (said.find("built without GLFW") != std::string::npos) GTEST_SKIP() << "GLFW is not installed (Debian: libglfw3-dev)";
    ASSERT_EQ(said, "");
    EXPECT_EQ(differing(read_ppm(file), picture("--technique pcss --frames 18")), 0);
}

std::string read_text(const fs::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(HostEngine, IsWhatThePageOnEmbeddingQuotes)
{
    std::string sources;
    for (const auto& entry : fs::directory_iterator(source_root() / "examples/host_engine/src")) sources += read_text(entry.path());
    std::istringstream page(read_text(source_root() / "docs/embedding.md"));
    bool code = false;
    int lines = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            code = line == "```cpp";
        } else if (code) {
            EXPECT_NE(sources.find(line + "\n"), std::string::npos) << line;
            ++lines;
        }
    }
    EXPECT_GT(lines, 20);
}

TEST(HostEngine, SaysWhatIsWrong)
{
    EXPECT_NE(engine("--headless --frames 1 --technique no_such_technique").find("no_such_technique"), std::string::npos);
    EXPECT_NE(engine("--headless --frames 1 --technique pcss --settings no_such_setting=1").find("no_such_setting"), std::string::npos);
    EXPECT_NE(engine("--headless --frames 1 --depth sideways").find("forward24"), std::string::npos);
}

} // namespace
} // namespace gnomon::tests
