// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/temporary_folder.h"
#include "lab/folder.h"
#include "lab/gallery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

/// A checkout with one technique in it.
class Gallery : public testing::Test {
protected:
    Gallery()
    {
        base::write_text(root_ / "README.md", "# x\n<!-- generated:pictures -->\n<!-- /generated -->\n");
        base::write_text(root_ / "docs/gallery.md", "# x\n<!-- generated:gallery -->\n<!-- /generated -->\n");
        base::write_text(root_ / "techniques/README.md", "# x\n");
        base::write_text(root_ / "techniques/pcss/README.md", "# x\n");
        put(200, 100);
        update_docs(root_, false);
    }

    /// A picture whose only error is at that place of its panels, where the first one has a mark.
    void put(int x, int y) const
    {
        constexpr int step = picture_panel.width + picture_gap;
        base::Picture picture({3 * picture_panel.width + 2 * picture_gap, picture_panel.height + 30}, 3, 1.0f);
        for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 0.25f, picture.at(2 * step + 10, 10, c) = 0.5f; // grey: not scored
        picture.at(2 * step + x, y, 1) = picture.at(2 * step + x, y, 2) = 0.0f;
        base::write_png(root_ / "techniques/pcss/pcss.png", picture, base::Encoding::linear);
    }
    fs::path thumbnail() const { return root_ / "docs/pictures/thumbnails/pcss.png"; }

    base::TemporaryFolder folder_;
    const fs::path root_ = folder_.path();
};

TEST_F(Gallery, ThumbnailShowsWhereTheErrorIs)
{
    EXPECT_TRUE(update_docs(root_, true).empty());
    const base::Picture small = base::read_png(thumbnail(), base::Encoding::linear);
    EXPECT_EQ(small.size.width, 160);
    EXPECT_EQ(small.size.height, 120);
    EXPECT_NEAR(*std::min_element(small.values.begin(), small.values.end()), 0.25f, 0.01f) << "the mark";
    for (const char* page : {"README.md", "docs/gallery.md"})
        EXPECT_NE(base::read_text(root_ / page).find("techniques/pcss/README.md"), std::string::npos) << page;
}

TEST_F(Gallery, WhatIsNotOfThePresentPictureIsStale)
{
    const auto stale = [&] { return update_docs(root_, true); };
    put(20, 20);
    EXPECT_EQ(stale(), std::vector<fs::path>{thumbnail()});
    update_docs(root_, false);
    EXPECT_TRUE(stale().empty());
    base::write_text(thumbnail(), "no picture");
    EXPECT_EQ(stale(), std::vector<fs::path>{thumbnail()});
    update_docs(root_, false);
    const fs::path strange = root_ / "docs/pictures/thumbnails/gone.png";
    base::write_text(strange, "of a technique that was removed");
    EXPECT_EQ(stale(), std::vector<fs::path>{strange});
    update_docs(root_, false);
    EXPECT_FALSE(fs::exists(strange));
    EXPECT_TRUE(stale().empty());
}

TEST_F(Gallery, APictureOfOtherPanelsIsRefused)
{
    base::write_png(root_ / "techniques/pcss/pcss.png", base::Picture({100, 100}, 3), base::Encoding::linear);
    EXPECT_THROW(update_docs(root_, true), base::Error);
}

} // namespace
} // namespace gnomon::lab
