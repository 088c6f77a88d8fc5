// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM at any moment of any command: it ends at once, leaves no part of a file and nothing temporary.
#include "process.h"
#include "tests/faults/reliability.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

struct Command {
    const char* name;
    std::vector<std::string> words;
};

std::vector<Command> commands()
{
    const std::vector<std::string> small = {"--detail", "0.05", "--size", "48x32"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), small.begin(), small.end());
        return words;
    };
    std::vector<Command> out = {
        {"render", with({"render", "contact", "--samples", "16", "--aov", "depth,normal", "-o", "out/a.png"})},
        {"truth", with({"truth", "contact", "--light", "sun,angle=4", "--samples", "2048", "-o", "out/a.exr"})},
        {"compare", with({"compare", "contact", "--techniques", "shadow_map,pcf,vsm", "--truth-samples", "64", "-o", "out"})},
        {"bench", with({"bench", "contact", "--techniques", "shadow_map,pcf", "--repeats", "20"})},
        {"slice", with({"slice", "contact", "--truth", "-o", "out/a.png"})},
    };
    // These take long; shorter tests of their own interrupt the first two.
    const std::vector<Command> long_ones = {
        {"advise", {"advise", "contact", "--size", "64x48", "-o", "out/a.md"}},
        {"tune",
            {"tune", "shadow_map", source_root() / "experiments/tuning/boards.json", "--vary", "bias_scale", "--size", "48x32", "--budget",
                "6", "-o", "out/a.json"}},
        {"docs", {"docs", "--check"}},
    };
    if (at_full_length()) out.insert(out.end(), long_ones.begin(), long_ones.end());
    return out;
}

/// Files end as their formats do, so that half of one is seen.
void expect_whole(const fs::path& file)
{
    const std::string text = read_whole(file), kind = file.extension();
    const std::string end = text.substr(text.size() - std::min<size_t>(text.size(), 8));
    EXPECT_TRUE(kind != ".png" || end.starts_with("IEND")) << file;
    EXPECT_TRUE(kind != ".html" || text.find("</html>") != std::string::npos) << file;
    EXPECT_TRUE(kind != ".json" || end.ends_with("}\n")) << file;
    EXPECT_TRUE(kind != ".exr" || text.size() > 200) << file;
    EXPECT_NE(kind, ".tmp") << file << " is left";
}

/// What children do after their parent's end may take a moment.
void expect_empty_soon(const fs::path& folder)
{
    for (int i = 0; i < 500 && !fs::is_empty(folder); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(fs::is_empty(folder)) << fs::directory_iterator(folder)->path();
}

class Signals : public testing::TestWithParam<Command> { };
void PrintTo(const Command& c, std::ostream* out) { *out << c.name; }

TEST_P(Signals, EndItAtOnceAndLeaveNothingInPart)
{
    const Scratch scratch;
    fs::create_directories(scratch / "tmp");
    RunOptions options{.environment = {{"TMPDIR", scratch / "tmp"}, {"GNOMON_ROOT", source_root()}}, .seconds = 300};
    // a full run rewrites results, so that the pages made of them are stale until its end
    const auto fine = [](int code) { return code == 0 || (code == 1 && GetParam().words[0] == "docs"); };
    const Finished whole = run_gnomon(GetParam().words, scratch.folder(), options);
    ASSERT_TRUE(fine(whole.code)) << whole.err;
    const int runs = at_full_length() ? std::max(2, int((whole.seconds > 20 ? 8 : 24) / step_of(1, 1))) : 2;
    int ended = 0;
    for (int i = 0; i < runs; ++i) {
        fs::remove_all(scratch / "out");
        fs::remove_all(scratch / ".cache");
        const auto begin = std::chrono::steady_clock::now();
        const double moment = whole.seconds * (i + 0.5) / runs;
        const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
        options.kill_when = [&] { return elapsed() >= moment; };
        options.kill_signal = i % 2 ? SIGTERM : SIGINT;
        const Finished f = run_gnomon(GetParam().words, scratch.folder(), options);
        EXPECT_TRUE(fine(f.code) || f.signal == options.kill_signal) << "code " << f.code << ", signal " << f.signal << ": " << f.err;
        EXPECT_LT(f.seconds, moment + 20) << "it went on";
        ended += f.signal != 0;
        for (const fs::directory_entry& e : fs::recursive_directory_iterator(scratch.folder()))
            if (e.is_regular_file()) expect_whole(e.path());
        expect_empty_soon(scratch / "tmp");
    }
    options.kill_when = {};
    EXPECT_TRUE(fine(run_gnomon(GetParam().words, scratch.folder(), options).code)) << "afterwards";
    EXPECT_GT(ended, 0);
    record("faults",
        {{"fault", "SIGINT, SIGTERM"}, {"technique", std::string(GetParam().name) + " (the program)"}, {"calls", runs}, {"tried", runs},
            {"refused", ended}, {"failures", HasFailure()}});
}

INSTANTIATE_TEST_SUITE_P(Commands, Signals, testing::ValuesIn(commands()), [](const auto& p) { return std::string(p.param.name); });

} // namespace
} // namespace gnomon::tests
