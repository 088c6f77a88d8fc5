// SPDX-License-Identifier: Apache-2.0
#include "lab/folder.h"

#include "base/error.h"
#include "base/file.h"

#include <algorithm>
#include <cctype>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to)
{
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

std::string upper(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

} // namespace

std::vector<fs::path> new_technique(const fs::path& root, const std::string& id)
{
    const auto allowed = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; };
    if (id.empty() || !std::islower(static_cast<unsigned char>(id[0])) || !std::all_of(id.begin(), id.end(), allowed))
        base::fail("'{}' cannot be a technique's id; use lower-case letters, digits and underscores, a letter first", id);
    const fs::path from = root / "techniques" / "_template", to = root / "techniques" / id;
    if (fs::exists(to)) base::fail("{} exists already; choose another id", to.string());
    if (!fs::is_directory(from)) base::fail("{} is missing; run this inside a checkout of Gnomon", from.string());
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        std::string name = entry.path().filename().string(), text = base::read_text(entry.path());
        replace_all(name, "template", id);
        replace_all(text, "TEMPLATE", upper(id));
        replace_all(text, "template_id", id);
        base::write_text(to / name, text);
        files.push_back(to / name);
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace gnomon::lab
