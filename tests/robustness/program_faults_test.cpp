// SPDX-License-Identifier: Apache-2.0
// Memory, disk, clock and caches as they are on a bad day (tests/preload): a sentence, a code, no part of a file.
#include "base/error.h"
#include "base/image_file.h"
#include "process.h"
#include "tests/faults/reliability.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> truth_command
    = {"truth", "contact", "--detail", "0.05", "--size", "16x12", "--samples", "4", "--light", "sun,angle=2", "-o", "a.exr"};
const std::vector<std::string> render_command = {"render", "contact", "--detail", "0.05", "--size", "32x24", "-o", "a.png"};

std::map<std::string, std::string> preload(std::map<std::string, std::string> more)
{
    more["LD_PRELOAD"] = GNOMON_PRELOAD;
    return more;
}

/// How many requests for memory and writes an undisturbed run has.
std::pair<long, long> count(const std::vector<std::string>& command, const Scratch& scratch)
{
    const Finished f = run_gnomon(command, scratch.folder(), {.environment = preload({{"GNOMON_COUNT", scratch / "count"}})});
    EXPECT_EQ(f.code, 0) << f.err;
    std::istringstream in(read_whole(scratch / "count"));
    long requests = 0, writes = 0;
    in >> requests >> writes;
    return {requests, writes};
}

void forget(const Scratch& scratch)
{
    for (const char* name : {"a.exr", "a.png", ".cache"}) fs::remove_all(scratch / name);
}

std::string outputs(const Scratch& scratch) { return read_whole(scratch / "a.exr") + read_whole(scratch / "a.png"); }

/// One of the files may be there alone, but then it is whole.
void expect_whole_or_absent(const Scratch& scratch, const std::map<std::string, std::string>& whole)
{
    for (const auto& [name, bytes] : whole)
        if (fs::exists(scratch / name)) {
            EXPECT_TRUE(read_whole(scratch / name) == bytes) << name << " in part";
        }
    for (const fs::directory_entry& e : fs::recursive_directory_iterator(scratch.folder()))
        EXPECT_NE(e.path().extension(), ".tmp") << e.path() << " is left";
}

std::map<std::string, std::string> written(const Scratch& scratch)
{
    std::map<std::string, std::string> out;
    for (const char* name : {"a.exr", "a.png"})
        if (fs::exists(scratch / name)) out[name] = read_whole(scratch / name);
    return out;
}

TEST(ProgramFaults, MemoryThatRunsOutAnywhereIsSaid)
{
    const Scratch scratch;
    const long requests = count(truth_command, scratch).first;
    ASSERT_GT(requests, 500);
    const std::map<std::string, std::string> whole = written(scratch);
    const long step = long(step_of(uint64_t(requests), 12));
    long said = 0, runs = 0;
    for (long n = 0; n < requests; n += step, ++runs) {
        forget(scratch);
        SCOPED_TRACE("request " + std::to_string(n));
        const Finished f = run_gnomon(
            truth_command, scratch.folder(), {.environment = preload({{"GNOMON_FAIL_NEW", std::to_string(n)}}), .seconds = 60});
        if (f.code != 0) expect_sentence(f, 1, {"memory"});
        said += f.code == 1;
        expect_whole_or_absent(scratch, whole);
    }
    EXPECT_GT(said, runs / 2);
    record("faults",
        {{"fault", "host memory"}, {"technique", "truth (the program)"}, {"calls", requests}, {"tried", runs}, {"refused", said},
            {"failures", testing::Test::HasFailure()}});
}

TEST(ProgramFaults, ADiskThatIsFullFromAnyWriteOnIsSaid)
{
    for (const std::vector<std::string>& command : {truth_command, render_command}) {
        const Scratch scratch;
        const long writes = count(command, scratch).second;
        ASSERT_GT(writes, 0);
        const std::map<std::string, std::string> whole = written(scratch);
        long said = 0;
        for (long n = 0; n < writes; ++n) {
            forget(scratch);
            const Finished f = run_gnomon(command, scratch.folder(), {.environment = preload({{"GNOMON_FAIL_WRITE", std::to_string(n)}})});
            if (f.code != 0) expect_sentence(f, 1, {"No space left"});
            said += f.code == 1;
            expect_whole_or_absent(scratch, whole);
        }
        EXPECT_GT(said, 0);
        record("faults",
            {{"fault", "full disk"}, {"technique", command[0] + " (the program)"}, {"calls", writes}, {"tried", writes}, {"refused", said},
                {"failures", testing::Test::HasFailure()}});
    }
}

TEST(ProgramFaults, ADiskThatCannotBeWrittenIsSaid)
{
    for (const std::vector<std::string>& command : {truth_command, render_command}) {
        const Scratch scratch;
        const Finished f = run_gnomon(command, scratch.folder(), {.environment = preload({{"GNOMON_READ_ONLY", "1"}})});
        expect_sentence(f, 1, {"Read-only file system", command.back().substr(0, 2)});
        EXPECT_FALSE(fs::exists(scratch / command.back()));
        record("faults",
            {{"fault", "read-only disk"}, {"technique", command[0] + " (the program)"}, {"calls", 1}, {"tried", 1},
                {"refused", int(f.code == 1)}, {"failures", testing::Test::HasFailure()}});
    }
}

TEST(ProgramFaults, ATruncatedGoldenIsNamedAndBlessingHealsIt)
{
    const Scratch scratch;
    const fs::path folder = scratch / "techniques/shadow_map", golden = folder / "golden.directional.png";
    fs::create_directories(folder.parent_path());
    fs::copy(source_root() / "techniques/shadow_map", folder);
    const std::string whole = read_whole(golden);
    const long cuts = at_full_length() ? 40 : 3;
    for (long i = 0; i < cuts; ++i) {
        fs::resize_file(golden, uint64_t(i) * whole.size() / uint64_t(cuts));
        try {
            base::read_png(golden, base::Encoding::linear);
            ADD_FAILURE() << fs::file_size(golden) << " bytes of " << whole.size() << " were taken for a picture";
        } catch (const base::Error& e) {
            EXPECT_NE(std::string(e.what()).find(golden.string()), std::string::npos) << e.what();
        }
    }
    const Finished f = run_gnomon({"bless", "shadow_map", "--because", "it was cut"}, scratch.folder(),
        {.environment = {{"GNOMON_ROOT", scratch.folder()}}, .seconds = 300});
    if (f.err.find("goldens are made by") != std::string::npos) GTEST_SKIP() << f.err;
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_NE(f.out.find("golden.directional.png: new, since"), std::string::npos) << f.out;
    EXPECT_NO_THROW(base::read_png(golden, base::Encoding::linear));
    record("faults",
        {{"fault", "truncated golden"}, {"technique", "shadow_map"}, {"calls", whole.size()}, {"tried", cuts}, {"refused", cuts},
            {"failures", testing::Test::HasFailure()}});
}

TEST(ProgramFaults, ClocksThatJumpChangeNothing)
{
    const Scratch scratch;
    ASSERT_EQ(run_gnomon(truth_command, scratch.folder()).code, 0);
    const std::string right = outputs(scratch);
    forget(scratch);
    const Finished f
        = run_gnomon(truth_command, scratch.folder(), {.environment = preload({{"GNOMON_CLOCK", "1"}, {"GNOMON_PROGRESS", "1"}})});
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_TRUE(outputs(scratch) == right);
    for (const char* wrong : {"-", "nan", "inf"}) EXPECT_EQ(f.err.find(wrong), std::string::npos) << f.err;
    record("faults",
        {{"fault", "clock jumps"}, {"technique", "truth (the program)"}, {"calls", 1}, {"tried", 1}, {"refused", 0},
            {"failures", testing::Test::HasFailure()}});
}

TEST(ProgramFaults, DamagedCachesHeal)
{
    for (const std::vector<std::string>& command : {truth_command, render_command}) {
        const Scratch scratch;
        ASSERT_EQ(run_gnomon(command, scratch.folder()).code, 0);
        const std::string right = outputs(scratch);
        std::vector<fs::path> files;
        for (const fs::directory_entry& e : fs::recursive_directory_iterator(scratch / ".cache"))
            if (e.is_regular_file()) files.push_back(e.path());
        EXPECT_FALSE(files.empty());
        long tried = 0;
        for (const int damage : {0, 1, 2}) {
            for (const fs::path& file : files) {
                const auto size = fs::file_size(file);
                if (damage < 2) fs::resize_file(file, damage == 0 ? 0 : size / 2);
                if (damage == 2)
                    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(long(size / 2)).write("damage", 6);
            }
            const Finished f = run_gnomon(command, scratch.folder());
            EXPECT_EQ(f.code, 0) << f.err;
            EXPECT_TRUE(outputs(scratch) == right) << "damage " << damage;
            ++tried;
        }
        record("faults",
            {{"fault", "damaged cache"}, {"technique", command[0] + " (the program)"}, {"calls", files.size()}, {"tried", tried},
                {"refused", 0}, {"failures", testing::Test::HasFailure()}});
    }
}

TEST(ProgramFaults, ACacheThatCannotBeWrittenCostsTimeAlone)
{
    const Scratch scratch;
    for (const std::vector<std::string>& command : {truth_command, render_command}) {
        const Finished f = run_gnomon(command, scratch.folder(), {.environment = {{"GNOMON_CACHE", "/proc/gnomon"}}});
        EXPECT_EQ(f.code, 0) << f.err;
        EXPECT_EQ(f.err, "");
    }
}

} // namespace
} // namespace gnomon::tests
