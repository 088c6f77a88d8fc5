// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

struct Wrong {
    std::vector<std::string> arguments;
    int code; ///< 1: cannot be done, 2: not understood
    std::vector<std::string> words;
};

void expect_all(const std::vector<Wrong>& all)
{
    const Scratch scratch;
    for (const Wrong& w : all) {
        std::string line = "gnomon";
        for (const std::string& a : w.arguments) line += " " + a;
        SCOPED_TRACE(line);
        expect_sentence(run_gnomon(w.arguments, scratch.folder()), w.code, w.words);
    }
}

TEST(CommandLine, UnknownNamesListTheNearOnes)
{
    expect_all({
        {{"render", "balls", "--technique", "shadow_mop"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"compare", "balls", "--techniques", "ray_traced,shadow_mop"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"compare", "balls", "--techniques", "shadow_map", "--reference", "shadow_mop"}, 1,
            {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"render", "balls", "--quality", "hihg"}, 1, {"unknown quality 'hihg'", "'high'"}},
        {{"slice", "balls", "--technique", "shadow_mop"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"slice", "balls", "--shadow_map.map_sise", "64"}, 1, {"unknown parameter 'map_sise'", "'map_size'"}},
        {{"bench", "balls", "--techniques", "shadow_mop"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"picture", "shadow_mop"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"bless", "shadow_mop", "--because", "x"}, 1, {"unknown technique 'shadow_mop'", "'shadow_map'"}},
        {{"render", "balls", "--shadow_map.map_sise", "64"}, 1, {"unknown parameter 'map_sise'", "'map_size'"}},
        {{"compare", "balls", "--techniques", "shadow_map:fitt=view"}, 1, {"unknown parameter 'fitt'", "'fit'"}},
        {{"render", "balls", "--shadow_map.fit", "focusedd"}, 1, {"'fit'", "'focused'"}},
        {{"render", "bals"}, 1, {"unknown scene 'bals'", "'balls'"}},
        {{"truth", "citadell"}, 1, {"unknown scene 'citadell'", "'citadel'"}},
        {{"render", "balls", "--camera", "fitt"}, 1, {"'fitt'", "'fit'"}},
        {{"render", "balls", "--light", "sunn"}, 1, {"'sunn'", "did you mean 'sun'?"}},
        {{"render", "balls", "--light", "spot,cona=40"}, 1, {"'cona'", "'cone'"}},
        {{"render", "balls", "--aov", "visibilty"}, 1, {"unknown aov 'visibilty'", "'visibility'"}},
    });
}

TEST(CommandLine, WhatIsNotUnderstoodIsNamed)
{
    expect_all({
        {{}, 2, {"name a subcommand", "render", "truth"}},
        {{"rendr", "balls"}, 2, {"unknown subcommand 'rendr'", "'render'"}},
        {{"--versoin"}, 2, {"unknown option '--versoin'", "'--version'"}},
        {{"render"}, 2, {"scene is required", "gnomon render --help"}},
        {{"render", "balls", "--siz", "64x64"}, 2, {"unknown option '--siz'", "'--size'"}},
        {{"render", "balls", "--siz=64x64"}, 2, {"unknown option '--siz'", "'--size'"}},
        {{"render", "balls", "citadel"}, 2, {"'citadel'"}},
        {{"render", "balls", "--shadow_map.pcf"}, 2, {"--shadow_map.pcf needs a value"}},
        {{"render", "balls", "--ray_traced.samples", "4"}, 2, {"--ray_traced.samples", "--shadow_map.NAME"}},
        {{"render", "balls", "--quality", "low", "--technique", "pcf"}, 2, {"--quality", "--technique"}},
        {{"render", "balls", "--quality", "low", "--shadow_map.pcf", "3"}, 2, {"--shadow_map.pcf", "a quality has its parameters"}},
        {{"truth", "balls", "--sampels", "3"}, 2, {"unknown option '--sampels'", "'--samples'"}},
        {{"truth", "balls", "--samples", "many"}, 2, {"--samples", "many"}},
        {{"truth", "balls", "--samples"}, 2, {"--samples"}},
        {{"compare", "balls"}, 2, {"--techniques"}},
        {{"bench", "--repeats", "1"}, 2, {"--repeats", "2 to 10000"}},
        {{"list", "scenes"}, 2, {"'scenes'"}},
        {{"new"}, 2, {"id is required"}},
        {{"bless"}, 2, {"--because"}},
    });
}

TEST(CommandLine, ValuesOutOfRangeStateTheRange)
{
    expect_all({
        {{"render", "balls", "--shadow_map.pcf", "99"}, 1, {"'pcf'", "1 to 15", "99"}},
        {{"render", "balls", "--shadow_map.map_size=15"}, 1, {"'map_size'", "16 to 8192"}},
        {{"render", "balls", "--shadow_map.bias_scale", "nan"}, 1, {"'bias_scale'", "0 to 64"}},
        {{"render", "balls", "--samples", "0"}, 2, {"--samples", "1 to 4096"}},
        {{"slice", "balls", "--centre", "1/2"}, 1, {"--centre", "1/2"}},
        {{"slice", "balls", "--right", "0/1/0"}, 1, {"axes", "plane"}},
        {{"slice", "balls", "--camera", "fit"}, 2, {"--camera"}},
        {{"slice", "balls", "-o", "x.exr"}, 1, {"x.exr", ".png"}},
        {{"truth", "balls", "--detail", "0"}, 1, {"detail", "0.05 to 256"}},
        {{"truth", "balls", "--detail", "nan"}, 1, {"detail", "0.05 to 256"}},
        {{"truth", "balls", "--time", "inf"}, 1, {"time", "finite"}},
        {{"truth", "balls", "--light", "spot,cone=400"}, 1, {"cone"}},
        {{"truth", "balls", "--light", "point,radius=-1"}, 1, {"radius"}},
        {{"truth", "balls", "--camera", "eye=1/1/1,target=1/1/1"}, 1, {"eye and target"}},
        {{"truth", "balls", "--camera", "eye=1/1/1,target=0/0/0,fov=180"}, 1, {"fov"}},
    });
}

TEST(CommandLine, SizesThatAreNoneAreRefused)
{
    for (const char* command : {"render", "truth", "bench"})
        expect_all({
            {{command, "balls", "--size", "0x10"}, 1, {"0x10", "1 to 16384"}},
            {{command, "balls", "--size", "99999x1"}, 1, {"99999x1", "1 to 16384"}},
            {{command, "balls", "--size", "-5x5"}, 1, {"-5x5"}},
            {{command, "balls", "--size", "abc"}, 1, {"abc", "WIDTHxHEIGHT"}},
            {{command, "balls", "--size", "10x"}, 1, {"10x", "WIDTHxHEIGHT"}},
            {{command, "balls", "--size", "10x10x10"}, 1, {"10x10x10", "WIDTHxHEIGHT"}},
            {{command, "balls", "--size", "99999999999999999999x1"}, 1, {"WIDTHxHEIGHT"}},
        });
}

TEST(CommandLine, OutputsThatCannotBeWrittenAreNamed)
{
    const Scratch scratch;
    fs::create_directories(scratch / "folder.exr");
    fs::create_directories(scratch / "folder.png");
    fs::create_symlink("/dev/full", scratch / "full.exr");
    const std::vector<std::string> truth = {"truth", "plane", "--size", "8x8", "-o"}, render = {"render", "plane", "--size", "8x8", "-o"};
    const auto expect = [&](std::vector<std::string> command, const std::string& target, const std::vector<std::string>& words) {
        command.push_back(target);
        SCOPED_TRACE(command.front() + " -o " + target);
        expect_sentence(run_gnomon(command, scratch.folder()), 1, words);
    };
    expect(truth, "x.jpg", {"x.jpg", ".exr"});
    expect(render, "x.jpg", {"x.jpg", ".png"});
    expect(render, "x", {"'x'", ".png"});
    expect(truth, "folder.exr", {"folder.exr", "folder"});
    expect(render, "folder.png", {"folder.png", "folder"});
    expect(truth, "/proc/nowhere/x.exr", {"/proc/nowhere"});
    expect(truth, "full.exr", {"full.exr", "No space left"});
    if (::geteuid() == 0) return; // the superuser may write everywhere
    fs::create_directories(scratch / "locked");
    ::chmod((scratch / "locked").c_str(), 0555);
    expect(truth, "locked/x.exr", {"locked/x.exr", "Permission denied"});
}

TEST(CommandLine, HelpIsThereForAll)
{
    const Scratch scratch;
    const Finished top = run_gnomon({"--help"}, scratch.folder());
    EXPECT_EQ(top.code, 0);
    EXPECT_EQ(top.err, "");
    for (const char* command :
        {"list", "render", "truth", "compare", "bench", "new", "picture", "docs", "bless", "convert", "slice", "sweep", "merge"}) {
        EXPECT_NE(top.out.find(std::string("\n  ") + command + " "), std::string::npos) << command;
        const Finished f = run_gnomon({command, "--help"}, scratch.folder());
        EXPECT_EQ(f.code, 0) << command;
        EXPECT_EQ(f.err, "") << command;
        EXPECT_NE(f.out.find("--json"), std::string::npos) << f.out;
    }
    const Finished version = run_gnomon({"--version"}, scratch.folder());
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out.rfind("gnomon ", 0), 0u) << version.out;
}

} // namespace
} // namespace gnomon::tests
