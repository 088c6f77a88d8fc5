// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "lab/curves.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace gnomon::lab {
namespace {

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> out(1);
    for (const char c : line)
        if (c == ',')
            out.emplace_back();
        else
            out.back() += c;
    return out;
}

// What lies in experiments/sampling_error is what the equations say: `gnomon curves` makes it anew.
TEST(Curves, CommittedNumbersAreThoseOfTheEquations)
{
    const std::filesystem::path folder = tests::source_root() / "experiments" / "sampling_error";
    size_t committed = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) committed += entry.path().extension() == ".csv";
    const std::vector<Curves> all = error_curves();
    EXPECT_EQ(committed, all.size());
    for (const Curves& c : all) {
        SCOPED_TRACE(c.id);
        const std::vector<std::string> now = lines_of(curves_csv(c)), then = lines_of(base::read_text(folder / (c.id + ".csv")));
        ASSERT_EQ(now.size(), then.size());
        ASSERT_EQ(now.front(), then.front());
        for (size_t i = 1; i < now.size(); ++i) {
            const std::vector<std::string> a = cells_of(now[i]), b = cells_of(then[i]);
            ASSERT_EQ(a.size(), b.size());
            for (size_t k = 0; k < a.size(); ++k) {
                ASSERT_EQ(a[k].empty(), b[k].empty()) << "line " << i + 1;
                if (a[k].empty()) continue;
                const double x = std::atof(a[k].c_str()), y = std::atof(b[k].c_str()); // the sixth digit may round otherwise elsewhere
                ASSERT_NEAR(x / y, 1.0, 2e-5) << "line " << i + 1;
            }
        }
    }
}

} // namespace
} // namespace gnomon::lab
