// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/export.h"

#include <nlohmann/json.hpp>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

bool is_earlier_export(const fs::path& folder)
{
    try {
        const auto json = nlohmann::json::parse(base::read_text(folder / "passes.json"));
        return json.at("generator").get<std::string>().starts_with("gnomon ");
    } catch (const std::exception&) {
        return false;
    }
}

void demand_replaceable(const fs::path& folder)
{
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status)) return;
    if (!fs::is_directory(status)) base::fail("'{}' is a file; name a folder for the export", folder.string());
    if (!fs::is_empty(folder, error) && !error && !is_earlier_export(folder))
        base::fail("'{}' holds files that are no export; name an empty folder or a new one", folder.string());
    if (error) base::fail("'{}' cannot be read: {}; name another folder", folder.string(), error.message());
}

/// Gone at the end, whatever happens.
struct Removed {
    fs::path path;
    ~Removed()
    {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

} // namespace

void write_export(const Exported& exported, const fs::path& named)
{
    // "out/" names the folder too, but has no last part to put a neighbour beside
    const fs::path folder = named.has_filename() ? named : named.parent_path();
    demand_replaceable(folder);
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    std::error_code error;
    fs::create_directories(parent, error);
    std::string pattern = (parent / ("." + folder.filename().string() + "-XXXXXX")).string();
    if (error || !::mkdtemp(pattern.data())) base::fail("no folder can be made in '{}'; name one elsewhere with -o", parent.string());
    const Removed made{pattern};
    for (const auto& [path, content] : exported.files) base::write_text(made.path / "new" / path, content);
    if (fs::exists(folder)) fs::rename(folder, made.path / "old", error);
    if (!error) fs::rename(made.path / "new", folder, error);
    if (!error) return;
    std::error_code ignored;
    if (!fs::exists(folder)) fs::rename(made.path / "old", folder, ignored);
    base::fail("'{}' cannot be replaced: {}; name another folder", folder.string(), error.message());
}

} // namespace gnomon::lab
