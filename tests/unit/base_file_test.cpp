// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/names.h"
#include "base/progress.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

using namespace gnomon::base;
namespace fs = std::filesystem;

namespace {

struct BaseFile : testing::Test {
    fs::path folder
        = fs::temp_directory_path() / fmt::format("gnomon_base_{}_{}", ::getpid(), testing::UnitTest::GetInstance()->random_seed());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override
    {
        fs::permissions(folder, fs::perms::owner_all);
        fs::remove_all(folder);
    }
    size_t entries() const { return size_t(std::distance(fs::directory_iterator(folder), {})); }
};

std::string message(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_F(BaseFile, text_round_trip_makes_folders_and_replaces)
{
    const fs::path path = folder / "a" / "b" / "c.txt";
    write_text(path, "first and longer");
    write_text(path, "second");
    EXPECT_EQ(read_text(path), "second");
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1) << "a temporary file stayed";
    write_text(path, "");
    EXPECT_EQ(read_text(path), "");
}

TEST_F(BaseFile, a_long_file_name_can_be_written)
{
    const fs::path path = folder / std::string(250, 'x');
    write_text(path, "text");
    EXPECT_EQ(read_text(path), "text");
}

TEST_F(BaseFile, writes_through_a_symbolic_link)
{
    write_text(folder / "real", "old");
    fs::create_symlink(folder / "real", folder / "link");
    write_text(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "real"), "new");
}

TEST_F(BaseFile, does_not_replace_a_device)
{
    write_text("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(BaseFile, errors_name_the_file_and_the_cause)
{
    EXPECT_TRUE(contains(message([&] { read_file(folder / "none.bin"); }), "none.bin"));
    EXPECT_TRUE(contains(message([&] { read_file(folder); }), "folder"));
    EXPECT_TRUE(contains(message([&] { write_text(folder, "x"); }), "folder"));
    write_text(folder / "ten", "0123456789");
    EXPECT_TRUE(contains(message([&] { read_file(folder / "ten", 9); }), "limit of 9"));
    EXPECT_EQ(read_file(folder / "ten", 10).size(), 10u);
    EXPECT_FALSE(message([&] { write_text(folder / "ten" / "below_a_file", "x"); }).empty());
    EXPECT_EQ(entries(), 1u);
}

TEST_F(BaseFile, a_read_only_folder_is_refused_in_a_sentence)
{
    // The superuser may write anywhere, but not into /proc.
    const bool root = ::geteuid() == 0;
    if (!root) fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    const fs::path path = root ? fs::path("/proc/gnomon.txt") : folder / "x.txt";
    const std::string text = message([&] { write_text(path, "x"); });
    EXPECT_TRUE(contains(text, path.string()) && contains(text, "cannot write")) << text;
}

TEST_F(BaseFile, a_full_disk_leaves_the_old_file_and_no_rest)
{
    write_text(folder / "data", "old");
    // A limit on the file size fails in write(2) just as a full disk does, with another errno.
    rlimit before{}, tight{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    tight = before, tight.rlim_cur = 4096;
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string text = message([&] { write_file(folder / "data", std::vector<std::byte>(100000)); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_TRUE(contains(text, "cannot write")) << text;
    EXPECT_EQ(read_text(folder / "data"), "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(BaseFile, two_writers_leave_one_whole_file)
{
    const std::string a(1 << 20, 'a'), b(1 << 20, 'b');
    std::thread other([&] {
        for (int i = 0; i < 10; ++i) write_text(folder / "both", a);
    });
    for (int i = 0; i < 10; ++i) write_text(folder / "both", b);
    other.join();
    const std::string text = read_text(folder / "both");
    EXPECT_TRUE(text == a || text == b);
    EXPECT_EQ(entries(), 1u);
}

TEST(BaseCache, follows_the_environment)
{
    const char* before = std::getenv("GNOMON_CACHE");
    const std::string kept = before ? before : "";
    ::setenv("GNOMON_CACHE", "/some/where", 1);
    EXPECT_EQ(cache_folder(), "/some/where");
    if (before)
        ::setenv("GNOMON_CACHE", kept.c_str(), 1);
    else
        ::unsetenv("GNOMON_CACHE");
}

TEST(BaseHash, tells_lengths_orders_and_single_bits_apart)
{
    std::set<std::string> seen;
    size_t made = 0;
    const auto add = [&](const Hasher& h) { seen.insert(h.hex()), ++made; };
    add(Hasher());
    for (size_t n = 0; n < 40; ++n) add(Hasher().bytes(std::vector<std::byte>(n)));
    for (size_t bit = 0; bit < 320; ++bit) {
        std::vector<std::byte> data(40);
        data[bit / 8] = std::byte(1u << (bit % 8));
        add(Hasher().bytes(data));
    }
    add(Hasher().text("ab").text("c"));
    add(Hasher().text("a").text("bc"));
    add(Hasher().value(1).value(2));
    add(Hasher().value(2).value(1));
    EXPECT_EQ(seen.size(), made);
    EXPECT_EQ(Hasher().hex().size(), 32u);
    EXPECT_EQ(Hasher().text("same").hex(), Hasher().text("same").hex());
}

TEST(BaseNames, suggests_what_is_near_and_nothing_else)
{
    const std::vector<std::string> names{"shadow_map", "pcss", "variance", "shadow_volume", "moment"};
    EXPECT_EQ(near_names("pscs", names), std::vector<std::string>{"pcss"}) << "a swap is one edit";
    EXPECT_EQ(near_names("VARIANCE", names), std::vector<std::string>{"variance"});
    EXPECT_EQ(near_names("volume", names), std::vector<std::string>{"shadow_volume"});
    EXPECT_EQ(near_names("shadow", names).size(), 2u);
    EXPECT_TRUE(near_names("xyz", names).empty());
    EXPECT_TRUE(near_names("", names).empty());
    EXPECT_EQ(unknown_name("technique", "pscs", names), "unknown technique 'pscs'; did you mean 'pcss'?");
    EXPECT_TRUE(contains(unknown_name("technique", "xyz", names), "moment"));
}

TEST(BaseProgress, shows_long_work_only_and_survives_threads)
{
    ::setenv("GNOMON_PROGRESS", "1", 1);
    testing::internal::CaptureStderr();
    {
        Progress quick("quick", 10);
        std::thread other([&] { quick.advance(5); });
        quick.advance(5);
        other.join();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    {
        Progress slow("slow work", 4);
        slow.advance();
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        slow.advance();
    }
    ::unsetenv("GNOMON_PROGRESS");
    EXPECT_TRUE(contains(testing::internal::GetCapturedStderr(), "slow work: 50 %"));
}
