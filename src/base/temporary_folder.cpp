// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_folder.h"

#include "base/error.h"

#include <cstdlib>
#include <string>

namespace gnomon::base {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (fs::temp_directory_path() / "gnomon-XXXXXX").string(); // mkdtemp fills in the six letters
    if (!::mkdtemp(pattern.data()))
        fail("cannot make a folder in {}; set TMPDIR to one that can be written", fs::temp_directory_path().string());
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace gnomon::base
