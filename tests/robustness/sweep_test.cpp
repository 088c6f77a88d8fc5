// SPDX-License-Identifier: Apache-2.0
#include "sweep_files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <unistd.h>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

TEST(Sweep, MakesEveryRunOnceAndReportsThem)
{
    const Scratch scratch;
    write(scratch, small());
    const Json first = sweep(scratch);
    EXPECT_EQ(first.at("runs"), 6);
    EXPECT_EQ(first.at("made"), 6);
    for (const Json& file : first.at("files")) EXPECT_TRUE(fs::exists(scratch / file.get<std::string>())) << file;
    const std::vector<std::string> before = lines_of(scratch / "out/results.jsonl");
    ASSERT_EQ(before.size(), 6u);
    for (const std::string& text : before) {
        const Json line = Json::parse(text);
        for (const char* key : {"device", "driver", "processor", "gnomon", "commit"})
            EXPECT_FALSE(line.at(key).get<std::string>().empty()) << key;
        EXPECT_TRUE(line.at("metrics").at("filter_mae").is_number());
    }
    EXPECT_EQ(lines_of(scratch / "out/results.csv").size(), 7u);
    const std::string page = read_whole(scratch / "out/README.md");
    EXPECT_NE(page.find("| technique | kernel | map_size | ms | mib | mae | filter_leak |"), std::string::npos) << page;

    EXPECT_EQ(sweep(scratch).at("made"), 0);
    EXPECT_EQ(lines_of(scratch / "out/results.jsonl"), before);
    // one more value: only its runs are made
    Json wider = small();
    wider["axes"]["kernel"].push_back(7);
    write(scratch, wider);
    EXPECT_EQ(sweep(scratch).at("made"), 2);
    // a narrower experiment keeps the rest and says so
    Json narrower = small();
    narrower["axes"]["kernel"] = {3};
    write(scratch, narrower);
    const Json last = sweep(scratch);
    EXPECT_EQ(last.at("made"), 0);
    EXPECT_NE(last.at("notes").dump().find("6 results"), std::string::npos) << last;
    EXPECT_EQ(lines_of(scratch / "out/results.jsonl").size(), 8u);
}

TEST(Sweep, ATornLastLineIsMadeAgain)
{
    const Scratch scratch;
    write(scratch, small());
    sweep(scratch);
    const fs::path file = scratch / "out/results.jsonl";
    for (const int cut : {1, 40, 300}) {
        fs::resize_file(file, fs::file_size(file) - uintmax_t(cut));
        EXPECT_EQ(sweep(scratch).at("made"), 1) << cut;
        EXPECT_EQ(lines_of(file).size(), 6u);
    }
}

TEST(Sweep, FilesThatAreNoResultsOfThisDeviceAreRefusedAndLeft)
{
    const Scratch scratch;
    write(scratch, small());
    sweep(scratch);
    const fs::path file = scratch / "out/results.jsonl";
    const std::string good = read_whole(file);
    const auto expect = [&](const std::string& text, const std::vector<std::string>& words) {
        std::ofstream(file, std::ios::trunc) << text;
        expect_sentence(run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder()), 1, words);
        EXPECT_EQ(read_whole(file), text);
    };
    expect("my own notes\n" + good, {"results.jsonl, line 1 is no result", "-o"});
    std::string damaged = good;
    damaged[damaged.find('\n') + 20] = '\x01';
    expect(damaged, {"line 2 is no result", "delete that line"});
    expect("{\"format\":1,\"key\":7}\n", {"line 1 is no result"});
    std::string foreign = good;
    const std::string device = Json::parse(good.substr(0, good.find('\n'))).at("device");
    for (size_t at = 0; (at = foreign.find(device, at)) != std::string::npos;) foreign.replace(at, device.size(), "Other GPU"), at += 9;
    expect(foreign, {"Other GPU", device, "never mixed", "-o"});
    std::ofstream(file, std::ios::trunc) << good;
    EXPECT_EQ(sweep(scratch).at("made"), 0);
}

TEST(Sweep, TwoAtOnceAreNotMixed)
{
    const Scratch scratch;
    write(scratch, small());
    fs::create_directories(scratch / "out");
    const int held = ::open((scratch / "out/results.jsonl").c_str(), O_RDWR | O_CREAT, 0666);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    expect_sentence(run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder()), 1, {"results.jsonl", "another process"});
    ::close(held);
    fs::remove(scratch / "out/results.jsonl");
    fs::create_symlink("/dev/full", scratch / "out/results.jsonl");
    expect_sentence(run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder()), 1, {"results.jsonl", "no plain file"});
}

TEST(Sweep, ShardsMerge)
{
    const Scratch scratch;
    write(scratch, small());
    for (const char* shard : {"1/3", "2/3", "3/3"}) EXPECT_EQ(sweep(scratch, {"--shard", shard}).at("made"), 2);
    const std::string a = "out/results.1-of-3.jsonl", b = "out/results.2-of-3.jsonl", c = "out/results.3-of-3.jsonl";
    const auto merge = [&](std::vector<std::string> files, const std::string& to) {
        files.insert(files.begin(), {"merge", "small.json"});
        files.insert(files.end(), {"-o", to});
        return run_gnomon(files, scratch.folder());
    };
    expect_sentence(merge({a, c}, "m"), 1, {"2 of 6 runs are missing", "kernel=3"});
    EXPECT_FALSE(fs::exists(scratch / "m/results.jsonl"));
    // the same runs measured twice have other times
    sweep(scratch, {"--shard", "2/3", "-o", "twice"});
    expect_sentence(
        merge({a, b, "twice/results.2-of-3.jsonl", c}, "m"), 1, {"different results of one run", b, "twice/results.2-of-3.jsonl"});
    EXPECT_EQ(merge({a, b, c, a}, "m").code, 0);
    const std::vector<std::string> merged = lines_of(scratch / "m/results.jsonl");
    EXPECT_EQ(merged.size(), 6u);
    EXPECT_TRUE(fs::exists(scratch / "m/README.md"));
    EXPECT_EQ(merge({a}, "m").code, 0) << "what is there already counts";
    EXPECT_EQ(lines_of(scratch / "m/results.jsonl"), merged);
    EXPECT_EQ(sweep(scratch, {"-o", "m"}).at("made"), 0);
    Json other = small();
    other["size"] = "32x24";
    write(scratch, other);
    expect_sentence(merge({a, b, c}, "n"), 1, {"holds no result of small.json"});
    expect_sentence(merge({"nowhere.jsonl"}, "n"), 1, {"nowhere.jsonl"});
}

TEST(Sweep, BadExperimentsAreOneSentence)
{
    const Scratch scratch;
    const auto expect = [&](const Json& json, const std::vector<std::string>& words) {
        write(scratch, json);
        SCOPED_TRACE(json.dump());
        expect_sentence(run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder()), 1, words);
        EXPECT_FALSE(fs::exists(scratch / "out"));
    };
    const auto changed = [](const std::string& pointer, const Json& value) {
        Json json = small();
        json[Json::json_pointer(pointer)] = value;
        return json;
    };
    expect(changed("/techniques/0/technique", "shadow_mop"), {"small.json", "unknown technique 'shadow_mop'", "'shadow_map'"});
    expect(changed("/techniques/0/params", {{"kernal", 3}, {"pcf", "$kernel"}, {"map_size", "$map_size"}}),
        {"small.json", "unknown parameter 'kernal'"});
    expect(changed("/techniques/0/params/pcf", "$kernal"), {"small.json", "unknown axis 'kernal'", "'kernel'"});
    expect(changed("/axes/kernel", {1, 99}), {"small.json", "'pcf'", "1 to 15"});
    expect(changed("/axes/unused", {1, 2}), {"small.json", "axis 'unused' is used nowhere", "$unused"});
    expect(changed("/axes/ms", {1, 2}), {"small.json", "axis 'ms'"});
    expect(changed("/axes/kernel", {1, 1}), {"small.json", "'kernel'", "twice"});
    expect(changed("/axes/kernel", Json::array()), {"small.json", "'kernel'"});
    expect(changed("/metrics", {"filter_leek"}), {"small.json", "'filter_leek'", "'filter_leak'"});
    expect(changed("/plots/0/y", "maee"), {"small.json", "'maee'", "'mae'"});
    expect(changed("/plots/0/x", "kernle"), {"small.json", "'kernle'"});
    expect(changed("/plots/0/series", "techniqe"), {"small.json", "'techniqe'", "'technique'"});
    expect(changed("/plots/0/where", {{"kernel", 4}}), {"small.json", "unknown kernel in \"where\" '4'"});
    expect(changed("/plots/0/log", "z"), {"small.json", "\"log\""});
    expect(changed("/scene", "bals"), {"small.json", "unknown scene 'bals'", "'balls'"});
    expect(changed("/light", "sunn"), {"small.json", "'sunn'"});
    expect(changed("/size", "64"), {"small.json", "WIDTHxHEIGHT"});
    expect(changed("/repeats", 0), {"small.json", "\"repeats\"", "1 to 10000"});
    expect(changed("/repeat", 3), {"small.json", "unknown key 'repeat'", "'repeats'"});
    expect(changed("/reference/technique", "pfc"), {"small.json", "unknown technique 'pfc'"});
    expect(changed("/techniques", Json::array()), {"small.json", "\"techniques\""});
    expect(Json::array(), {"small.json"});
    expect(7, {"small.json"});
    Json twice = small();
    twice["techniques"].push_back(twice["techniques"][0]);
    expect(twice, {"small.json", "\"label\""});
    std::ofstream(scratch / "broken.json") << "{\"scene\": ";
    expect_sentence(run_gnomon({"sweep", "broken.json"}, scratch.folder()), 1, {"broken.json", "line 1"});
    expect_sentence(run_gnomon({"sweep", "nowhere.json"}, scratch.folder()), 1, {"nowhere.json"});
    write(scratch, small());
    for (const char* shard : {"0/2", "3/2", "1", "a/b", "1/0"})
        expect_sentence(run_gnomon({"sweep", "small.json", "-o", "out", "--shard", shard}, scratch.folder()), 1, {"--shard", shard});
}

TEST(Sweep, TheManualsExampleIsOne)
{
    const Scratch scratch;
    const std::string page = read_whole(fs::path(GNOMON_SOURCE) / "docs/experiments.md"), open = "```json\n";
    const size_t begin = page.find(open) + open.size();
    write(scratch, Json::parse(page.substr(begin, page.find("```", begin) - begin)));
    const Finished f = run_gnomon({"sweep", "small.json", "--plan", "--json"}, scratch.folder());
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_GT(Json::parse(f.out).at("runs").size(), 10u);
}

TEST(Sweep, WithoutGnuplotTheTablesAreThere)
{
    const Scratch scratch;
    write(scratch, small());
    const Finished f = run_gnomon({"sweep", "small.json", "-o", "out"}, scratch.folder(), {.environment = {{"PATH", "/nonexistent"}}});
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_NE(f.err.find("gnuplot-nox"), std::string::npos) << f.err;
    EXPECT_TRUE(fs::exists(scratch / "out/README.md"));
    EXPECT_FALSE(fs::exists(scratch / "out/mae_over_kernel.svg"));
    EXPECT_FALSE(fs::exists(scratch / "out/mae_over_kernel.gnuplot"));
}

} // namespace
} // namespace gnomon::tests
