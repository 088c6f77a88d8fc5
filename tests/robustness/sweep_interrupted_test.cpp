// SPDX-License-Identifier: Apache-2.0
// What a sweep loses when it is killed, when the disk is full, when parts of it run at once.
#include "sweep_files.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <random>
#include <regex>
#include <set>
#include <sys/wait.h>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

size_t whole_lines(const fs::path& file)
{
    const std::string text = read_whole(file);
    return size_t(std::count(text.begin(), text.end(), '\n'));
}

/// Results in their order without what differs between two measurements of one run.
std::vector<Json> without_times(const fs::path& file)
{
    std::vector<Json> out;
    for (const std::string& text : lines_of(file)) {
        Json line = Json::parse(text);
        line.erase("technique_ms"), line.erase("technique_least_ms"), line.erase("technique_deviation");
        for (Json& pass : line.at("passes")) pass.erase("ms"), pass.erase("deviation");
        out.push_back(line);
    }
    return out;
}

/// 36 runs that take some milliseconds each.
Json many()
{
    Json json = small();
    json["axes"]["kernel"] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    json["axes"]["map_size"] = {32, 64, 128, 256};
    return json;
}

TEST(SweepInterrupted, TenTimesKilledItEqualsOneThatWasNot)
{
    const Scratch scratch;
    write(scratch, many());
    const fs::path file = scratch / "out/results.jsonl";
    std::mt19937 random(7);
    std::vector<std::string> kept;
    int kills = 0;
    for (; kills < 10; ++kills) {
        // spread over the sweep, the first before any run is finished; then at any moment of a run
        const size_t target = size_t(kills) * 3;
        const std::chrono::duration<double, std::milli> pause(std::uniform_real_distribution<double>(0, 40)(random));
        std::optional<std::chrono::steady_clock::time_point> reached;
        const Finished f = run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder(), {.kill_when = [&] {
            if (!reached && whole_lines(file) >= target) reached = std::chrono::steady_clock::now();
            return reached && std::chrono::steady_clock::now() - *reached > pause;
        }});
        if (f.signal == 0) break;
        ASSERT_EQ(f.signal, SIGKILL);
        std::vector<std::string> now = lines_of(file);
        const std::string text = read_whole(file);
        if (!text.empty() && text.back() != '\n') now.pop_back(); // killed in the midst of a line
        ASSERT_GE(now.size(), kept.size());
        EXPECT_TRUE(std::equal(kept.begin(), kept.end(), now.begin())) << "a finished run was lost or measured again";
        kept = now;
    }
    EXPECT_EQ(kills, 10) << "the sweep ended before it was killed ten times";
    EXPECT_LT(kept.size(), 36u);
    EXPECT_EQ(sweep(scratch).at("made"), 36 - int(kept.size()));
    const std::vector<std::string> lines = lines_of(file);
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), lines.begin()));
    std::set<std::string> keys;
    for (const std::string& line : lines) EXPECT_TRUE(keys.insert(Json::parse(line).at("key")).second) << "made twice";
    EXPECT_EQ(keys.size(), 36u);
    sweep(scratch, {"-o", "whole"});
    EXPECT_EQ(without_times(file), without_times(scratch / "whole/results.jsonl"));
}

TEST(SweepInterrupted, ByTheKeyboardItKeepsWhatIsFinished)
{
    const Scratch scratch;
    write(scratch, many());
    const fs::path file = scratch / "out/results.jsonl";
    const Finished f = run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder(),
        {.kill_when = [&] { return whole_lines(file) >= 5; }, .kill_signal = SIGINT});
    EXPECT_TRUE(f.signal == SIGINT || f.code == 130) << f.signal << " " << f.code;
    const size_t kept = whole_lines(file);
    EXPECT_GE(kept, 5u);
    EXPECT_LT(kept, 36u);
    EXPECT_EQ(sweep(scratch).at("made"), 36 - int(kept));
}

/// Runs a command of the shell in `folder`, where the new folder `disk` is a disk of eight KiB. The exit status.
int on_a_small_disk(const fs::path& folder, const std::string& command)
{
    fs::create_directories(folder / "disk");
    const std::string script = "mount -t tmpfs -o size=8k tmpfs disk && " + command;
    const std::string line = "cd '" + folder.string() + "' && GNOMON_CACHE=\"$PWD/.cache\" unshare -Urm sh -c '" + script + "'";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(SweepInterrupted, OnAFullDiskWhatIsFinishedStays)
{
    const Scratch scratch;
    write(scratch, many());
    if (on_a_small_disk(scratch.folder(), "true") != 0) GTEST_SKIP() << "this system lets no user mount a small disk (unshare -Urm, tmpfs)";
    const std::string gnomon = GNOMON_PROGRAM;
    EXPECT_EQ(on_a_small_disk(scratch.folder(), gnomon + " sweep small.json -o disk 2>said; code=$?; cp -r disk out; exit $code"), 1);
    const std::string said = read_whole(scratch / "said");
    for (const char* word : {"results.jsonl", "No space left", " of 36 ", "kept", "goes on from there"})
        EXPECT_NE(said.find(word), std::string::npos) << said;
    const fs::path file = scratch / "out/results.jsonl";
    const std::string before = read_whole(file);
    const size_t kept = whole_lines(file);
    ASSERT_GE(kept, 2u);
    EXPECT_EQ(before.back(), '\n') << "a part of a line";
    EXPECT_EQ(sweep(scratch).at("made"), 36 - int(kept));
    EXPECT_EQ(read_whole(file).substr(0, before.size()), before);
    // nor does a merge that finds no room leave a part of its results
    EXPECT_EQ(on_a_small_disk(
                  scratch.folder(), gnomon + " merge small.json out/results.jsonl -o disk 2>said; code=$?; ls disk >left; exit $code"),
        1);
    EXPECT_NE(read_whole(scratch / "said").find("results.jsonl"), std::string::npos) << read_whole(scratch / "said");
    EXPECT_EQ(read_whole(scratch / "left"), "");
}

TEST(SweepInterrupted, FinishedRunsDoNotSpoilTheEstimate)
{
    const Scratch scratch;
    Json slow = small();
    slow["size"] = "320x240", slow["repeats"] = 12;
    slow["axes"] = {{"kernel", {1, 3, 5, 7}}, {"map_size", {64}}};
    write(scratch, slow);
    sweep(scratch);
    slow["axes"]["map_size"] = {64, 128};
    write(scratch, slow);
    const Finished f = run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder(), {.environment = {{"GNOMON_PROGRESS", "1"}}});
    ASSERT_EQ(f.code, 0) << f.err;
    // four runs are to be made: after one of them a quarter is done, not five eighths
    const std::regex line(R"(sweep small: (\d+) %, ([0-9.]+) s, ([0-9.]+) s left)");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(f.err, match, line)) << f.err;
    const double part = std::stod(match[1]) / 100, seconds = std::stod(match[2]), left = std::stod(match[3]);
    EXPECT_NEAR(part * 4, std::round(part * 4), 1e-9) << f.err;
    EXPECT_NEAR(left, seconds * (1 - part) / part, 0.2) << f.err;
}

TEST(SweepInterrupted, ShardsAtOnceMakeTheWhole)
{
    const Scratch scratch;
    write(scratch, small());
    sweep(scratch, {"-o", "whole"});
    // as docs/experiments.md has it, by the parallel that every system has
    const std::string shards = "cd '" + scratch.folder().string()
        + "' && seq 2 | GNOMON_CACHE=\"$PWD/.cache\" xargs -P 2 -I{} '" GNOMON_PROGRAM "' sweep small.json -o out --shard {}/2 >/dev/null";
    ASSERT_EQ(std::system(shards.c_str()), 0);
    const Finished merged
        = run_gnomon({"merge", "small.json", "out/results.1-of-2.jsonl", "out/results.2-of-2.jsonl", "-o", "out"}, scratch.folder());
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(without_times(scratch / "out/results.jsonl"), without_times(scratch / "whole/results.jsonl"));
    EXPECT_EQ(sweep(scratch).at("made"), 0);
}

TEST(SweepInterrupted, ShardsThatDoNotFitAreRefused)
{
    const Scratch scratch;
    write(scratch, small());
    for (const char* shard : {"1/2", "2/2", "2/3"}) sweep(scratch, {"--shard", shard});
    const auto merge = [&](std::vector<std::string> files) {
        files.insert(files.begin(), {"merge", "small.json"});
        files.insert(files.end(), {"-o", "merged"});
        return run_gnomon(files, scratch.folder());
    };
    const std::string a = "out/results.1-of-2.jsonl", b = "out/results.2-of-2.jsonl";
    // 2/3 measured runs of both halves once more
    expect_sentence(merge({a, b, "out/results.2-of-3.jsonl"}), 1, {"different results of one run", "2-of-3", "merge only one"});
    std::string text = read_whole(scratch / b);
    const std::string device = Json::parse(text.substr(0, text.find('\n'))).at("device");
    std::string foreign = text;
    for (size_t at = 0; (at = foreign.find(device, at)) != std::string::npos; at += 9) foreign.replace(at, device.size(), "Other GPU");
    std::ofstream(scratch / "foreign.jsonl") << foreign;
    expect_sentence(merge({a, "foreign.jsonl"}), 1, {"foreign.jsonl", "Other GPU", "never mixed"});
    text.insert(10, "\x01");
    std::ofstream(scratch / "damaged.jsonl") << text;
    expect_sentence(merge({a, "damaged.jsonl"}), 1, {"damaged.jsonl", "line 1 is no result"});
    EXPECT_FALSE(fs::exists(scratch / "merged"));
    EXPECT_EQ(merge({a, b}).code, 0);
}

} // namespace
} // namespace gnomon::tests
