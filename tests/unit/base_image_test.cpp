// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <unistd.h>

using namespace gnomon::base;
namespace fs = std::filesystem;

namespace {

struct BaseImage : testing::Test {
    fs::path folder = fs::temp_directory_path() / fmt::format("gnomon_image_{}", ::getpid());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    /// Every damage must end in a picture or an Error: 20 lengths and 300 flipped bytes, most of them in the header.
    template <class Read> void damage(const fs::path& path, Read read)
    {
        const std::vector<std::byte> whole = read_file(path);
        int refused = 0;
        const auto attempt = [&](const std::vector<std::byte>& bytes) {
            write_file(folder / "damaged", bytes);
            try {
                read(folder / "damaged");
            } catch (const Error&) {
                ++refused;
            }
        };
        for (size_t i = 0; i < 20; ++i) attempt({whole.begin(), whole.begin() + std::ptrdiff_t(whole.size() * i / 20)});
        EXPECT_GE(refused, 15);
        std::mt19937 random(7);
        for (int i = 0; i < 300; ++i) {
            std::vector<std::byte> bytes = whole;
            const size_t range = i % 3 == 0 ? bytes.size() : std::min<size_t>(bytes.size(), 400);
            bytes[random() % range] = std::byte(random() & 255);
            attempt(bytes);
        }
    }
};

Picture gradient(Size size, int channels)
{
    Picture p(size, channels);
    for (size_t i = 0; i < p.values.size(); ++i) p.values[i] = float(i % 256) / 255.0f;
    return p;
}

} // namespace

TEST_F(BaseImage, png_round_trips_in_both_encodings)
{
    for (const int channels : {1, 3, 4})
        for (const Encoding encoding : {Encoding::linear, Encoding::srgb}) {
            const Picture before = gradient({37, 21}, channels);
            write_png(folder / "p.png", before, encoding);
            const Picture after = read_png(folder / "p.png", encoding);
            ASSERT_EQ(after.size, before.size);
            ASSERT_EQ(after.channels, channels);
            // Half a code of 255; the steepest part of the inverse transfer function (at 1) doubles it and a bit.
            const float tolerance = encoding == Encoding::linear ? 1e-6f : 0.0046f;
            for (size_t i = 0; i < before.values.size(); ++i) ASSERT_NEAR(after.values[i], before.values[i], tolerance);
        }
}

TEST_F(BaseImage, png_uses_the_srgb_transfer_function_and_leaves_alpha_alone)
{
    Picture p({1, 1}, 4);
    p.values = {0.21404114f, 0.0031308f, 1.0f, 0.5f};
    write_png(folder / "p.png", p, Encoding::srgb);
    const Pixels8 bytes = decode_rgba8(read_file(folder / "p.png"), "p.png");
    EXPECT_EQ(bytes.rgba, (std::vector<uint8_t>{128, 10, 255, 128})); // 0.5 -> 127.5; 12.92 * 0.0031308 * 255 = 10.3
}

TEST_F(BaseImage, png_clamps_and_turns_nan_into_zero)
{
    Picture p({4, 1}, 1);
    p.values = {-1.0f, 2.0f, std::nanf(""), std::numeric_limits<float>::infinity()};
    write_png(folder / "p.png", p, Encoding::linear);
    EXPECT_EQ(read_png(folder / "p.png", Encoding::linear).values, (std::vector<float>{0, 1, 0, 1}));
}

TEST_F(BaseImage, impossible_pictures_are_refused)
{
    EXPECT_THROW(write_png(folder / "p.png", Picture({4, 4}, 2), Encoding::linear), Error);
    EXPECT_THROW(write_png(folder / "p.png", Picture(), Encoding::linear), Error);
    EXPECT_THROW(write_exr(folder / "p.exr", Picture({2, 2}, 1), {"a", "b"}), Error);
    EXPECT_THROW(write_exr(folder / "p.exr", Picture({2, 2}, 2), {"a", "a"}), Error);
    EXPECT_THROW(decode_rgba8({}, "empty"), Error);
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(BaseImage, exr_round_trips_every_float_and_orders_rgb_first)
{
    Picture before({19, 23}, 5);
    std::mt19937 random(1);
    for (float& v : before.values) v = std::ldexp(float(random() & 0xffffff) - 8e6f, int(random() % 60) - 40);
    before.values[0] = std::numeric_limits<float>::infinity();
    write_exr(folder / "p.exr", before, {"R", "G", "B", "A", "variance"});
    std::vector<std::string> names;
    const Picture after = read_exr(folder / "p.exr", &names);
    EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "variance"}));
    EXPECT_EQ(after.size, before.size);
    EXPECT_EQ(after.values, before.values);
}

TEST_F(BaseImage, headers_that_promise_more_than_the_file_holds_are_refused)
{
    const auto refusal = [](const std::vector<std::byte>& file) -> std::string {
        try {
            decode_rgba8(file, "picture");
        } catch (const Error& e) {
            return e.what();
        }
        return "decoded";
    };
    write_png(folder / "p.png", gradient({64, 48}, 3), Encoding::linear);
    const std::vector<std::byte> whole = read_file(folder / "p.png");
    const auto changed = [&](size_t at, std::initializer_list<int> values) {
        std::vector<std::byte> bytes = whole;
        for (const int v : values) bytes.at(at++) = std::byte(v);
        return bytes;
    };
    EXPECT_EQ(refusal(whole), "decoded");
    EXPECT_NE(refusal(changed(16, {0, 0, 0x40, 0, 0, 0, 0x40, 0})).find("268435456 pixels"), std::string::npos) << "of the header";
    EXPECT_NE(refusal(changed(33, {0x3f, 0xff, 0xff, 0xff})).find("within the chunk at byte 33"), std::string::npos) << "of the pixels";
    EXPECT_NE(refusal(changed(33, {0, 0, 0, 0})).find("an empty chunk"), std::string::npos) << refusal(changed(33, {0, 0, 0, 0}));

    // A JPEG with a table of 16 times 17 Huffman codes, where 256 have room; and one of many scans.
    std::vector<std::byte> tables
        = {std::byte(0xff), std::byte(0xd8), std::byte(0xff), std::byte(0xc4), std::byte(1), std::byte(35), std::byte(0)};
    tables.resize(tables.size() + 16 + 272, std::byte(17));
    EXPECT_NE(refusal(tables).find("256 codes"), std::string::npos) << refusal(tables);
    tables.insert(tables.begin(), std::byte(0xff));
    EXPECT_NE(refusal(tables).find("begins with no mark"), std::string::npos) << refusal(tables);
    std::vector<std::byte> scans = {std::byte(0xff), std::byte(0xd8)};
    for (int i = 0; i < 101; ++i) scans.insert(scans.end(), {std::byte(0xff), std::byte(0xda), std::byte(0), std::byte(2)});
    EXPECT_NE(refusal(scans).find("100 scans"), std::string::npos) << refusal(scans);
    EXPECT_NE(refusal(std::vector<std::byte>(50, std::byte('B'))).find("give a PNG or JPEG"), std::string::npos);
}

TEST_F(BaseImage, jpegs_whose_scans_name_tables_that_are_not_there_are_refused)
{
    const auto refused = [](int frame, std::initializer_list<int> tables, std::initializer_list<int> band) {
        std::vector<int> numbers = {0xff, 0xd8, 0xff, frame, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0};
        for (const int name : tables) {
            numbers.insert(numbers.end(), {0xff, 0xc4, 0, 20, name, 1});
            numbers.insert(numbers.end(), 16, 0); // one code of one bit
        }
        numbers.insert(numbers.end(), {0xff, 0xda, 0, 8, 1, 1, 0x21}); // differences by table 2, the others by 1
        numbers.insert(numbers.end(), band);
        std::vector<std::byte> file;
        for (const int n : numbers) file.push_back(std::byte(n));
        try {
            decode_rgba8(file, "picture");
        } catch (const Error& e) {
            return std::string(e.what()).find("before the Huffman tables") != std::string::npos;
        }
        return false;
    };
    constexpr int baseline = 0xc0, progressive = 0xc2, dc = 0x02, ac = 0x11;
    EXPECT_FALSE(refused(baseline, {dc, ac}, {0, 63, 0}));
    EXPECT_TRUE(refused(baseline, {dc}, {0, 63, 0}));
    EXPECT_TRUE(refused(baseline, {ac}, {0, 63, 0}));
    EXPECT_TRUE(refused(baseline, {0x00, 0x10}, {0, 63, 0}));
    EXPECT_FALSE(refused(progressive, {dc}, {0, 0, 1}));
    EXPECT_FALSE(refused(progressive, {ac}, {1, 63, 1}));
    EXPECT_FALSE(refused(progressive, {}, {0, 0, 0x10})) << "a refinement of differences has no codes";
    EXPECT_TRUE(refused(progressive, {dc}, {1, 63, 0}));
    EXPECT_TRUE(refused(progressive, {}, {0, 0, 1}));
}

TEST_F(BaseImage, damaged_png_is_refused)
{
    write_png(folder / "p.png", gradient({64, 48}, 3), Encoding::linear);
    damage(folder / "p.png", [](const fs::path& p) { read_png(p, Encoding::linear); });
}

TEST_F(BaseImage, damaged_exr_is_refused)
{
    write_exr(folder / "p.exr", gradient({64, 48}, 3), {"R", "G", "B"});
    damage(folder / "p.exr", [](const fs::path& p) { read_exr(p); });
}
