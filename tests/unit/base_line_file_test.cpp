// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/line_file.h"

#include <gtest/gtest.h>

#include <csignal>
#include <sys/resource.h>

namespace gnomon::base {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

class LineFileTest : public testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    const fs::path folder_ = fs::path(testing::TempDir()) / "gnomon-line-file";
    const fs::path file_ = folder_ / "deep" / "lines";
};

TEST_F(LineFileTest, GrowsAndIsReadBack)
{
    {
        LineFile file(file_);
        EXPECT_TRUE(file.lines().empty());
        file.append("one"), file.append("");
    }
    LineFile file(file_);
    EXPECT_EQ(file.lines(), (Lines{"one", ""}));
    file.append("three");
    EXPECT_EQ(read_lines(file_), (Lines{"one", "", "three"}));
}

TEST_F(LineFileTest, CutsOffATornLine)
{
    write_text(file_, "one\ntw");
    EXPECT_EQ(read_lines(file_), Lines{"one"});
    EXPECT_EQ(read_text(file_), "one\ntw") << "reading changes nothing";
    LineFile(file_).append("two");
    EXPECT_EQ(read_text(file_), "one\ntwo\n");
}

TEST_F(LineFileTest, HasOneWriter)
{
    const LineFile first(file_);
    EXPECT_THROW(LineFile second(file_), Error);
    EXPECT_THROW(LineFile folder(folder_), Error);
    EXPECT_THROW(LineFile device("/dev/full"), Error);
}

TEST_F(LineFileTest, AFullDiskLeavesWholeLines)
{
    LineFile file(file_);
    file.append("one");
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    // A file that may not grow fails as a full disk does: in the midst of a line.
    const auto old = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string message;
    try {
        file.append("two, which is too long");
    } catch (const Error& e) {
        message = e.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old);
    EXPECT_NE(message.find("lines': File too large"), std::string::npos) << message;
    EXPECT_EQ(read_text(file_), "one\n");
    file.append("two");
    EXPECT_EQ(read_lines(file_), (Lines{"one", "two"}));
}

} // namespace
} // namespace gnomon::base
