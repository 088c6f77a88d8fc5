// SPDX-License-Identifier: Apache-2.0
#include "glsl_function.h"

#include "base/file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace gnomon::gpu {

/// A folder of its own for the caches, for the time of one test.
class GpuCache : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = std::filesystem::temp_directory_path()
            / (std::string("gnomon_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::remove_all(folder_);
        if (const char* before = std::getenv("GNOMON_CACHE")) before_ = before;
        setenv("GNOMON_CACHE", folder_.c_str(), 1);
    }
    void TearDown() override
    {
        before_.empty() ? unsetenv("GNOMON_CACHE") : setenv("GNOMON_CACHE", before_.c_str(), 1);
        std::filesystem::remove_all(folder_);
    }
    static void run_once()
    {
        const char* name = std::getenv("GNOMON_TEST_DEVICE");
        const std::unique_ptr<Device> device = Device::open({name ? name : "", false});
        const std::vector<Vec4> inputs(3, Vec4{1, 2, 3, 4});
        EXPECT_EQ(run_glsl_function(*device, "tests/gpu/twice.comp", inputs)[2], (Vec4{2, 4, 6, 8}));
    }
    std::filesystem::path only_file() const
    {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) files.push_back(entry.path());
        EXPECT_EQ(files.size(), 1u);
        return files.at(0);
    }

    std::filesystem::path folder_;
    std::string before_;
};

TEST_F(GpuCache, IsWrittenAndADamagedOneIsReplaced)
{
    run_once();
    const std::filesystem::path file = only_file();
    const auto whole = base::read_file(file);
    ASSERT_GT(whole.size(), 32u);
    auto damaged = whole;
    damaged[whole.size() - 1] ^= std::byte(0xff);
    base::write_file(file, damaged);
    run_once();
    EXPECT_NE(base::read_file(file), damaged);
    base::write_text(file, "x");
    run_once();
    EXPECT_GT(base::read_file(file).size(), 32u);
}

TEST_F(GpuCache, AFolderThatCannotBeWrittenFailsNothing)
{
    base::write_text(folder_, "a file where the folder should be");
    run_once();
}

} // namespace gnomon::gpu
