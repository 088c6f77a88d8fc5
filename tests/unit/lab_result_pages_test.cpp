// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "base/temporary_folder.h"
#include "lab/folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

/// A checkout with one experiment and its committed results.
class ResultPages : public testing::Test {
protected:
    ResultPages()
    {
        const fs::path source = GNOMON_SOURCE, results = fs::path("experiments/results/llvmpipe/sintorn2011_counts");
        fs::create_directories(root_ / results), fs::create_directories(root_ / "experiments/sintorn2011");
        fs::copy(source / results, root_ / results);
        fs::copy(source / "experiments/sintorn2011/sintorn2011_counts.json", root_ / "experiments/sintorn2011");
        table_ = root_ / results / "results.csv", lines_ = root_ / results / "results.jsonl";
    }

    base::TemporaryFolder folder_;
    const fs::path root_ = folder_.path();
    fs::path table_, lines_;
};

TEST_F(ResultPages, ATableThatDoesNotFollowFromTheLinesIsStale)
{
    const std::string before = base::read_text(table_);
    EXPECT_TRUE(update_result_pages(root_, true).empty());
    base::write_text(table_, before + "shadow_volumes,better,than,measured\r\n");
    EXPECT_EQ(update_result_pages(root_, true), std::vector<fs::path>{table_});
    EXPECT_NE(base::read_text(table_), before) << "a check writes nothing";
    EXPECT_EQ(update_result_pages(root_, false), std::vector<fs::path>{table_});
    EXPECT_EQ(base::read_text(table_), before);
}

TEST_F(ResultPages, ALineThatIsGoneMakesItStale)
{
    const std::string text = base::read_text(lines_);
    base::write_text(lines_, text.substr(text.find('\n') + 1));
    const std::vector<fs::path> stale = update_result_pages(root_, true);
    EXPECT_NE(std::find(stale.begin(), stale.end(), table_), stale.end());
}

TEST_F(ResultPages, ResultsOfOtherParametersAreLeft)
{
    std::string text = base::read_text(lines_);
    for (size_t at = 0; (at = text.find("\"key\":\"", at)) != std::string::npos; at += 7) text[at + 7] = 'x';
    base::write_text(lines_, text);
    base::write_text(table_, "what was measured then");
    EXPECT_TRUE(update_result_pages(root_, true).empty());
    update_result_pages(root_, false);
    EXPECT_EQ(base::read_text(table_), "what was measured then");
}

} // namespace
} // namespace gnomon::lab
