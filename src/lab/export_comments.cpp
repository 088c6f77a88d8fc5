// SPDX-License-Identifier: Apache-2.0
#include "lab/export_comments.h"

#include <regex>
#include <sstream>
#include <vector>

namespace gnomon::lab {

namespace {

std::string trimmed(const std::string& s)
{
    const size_t first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
    return first == std::string::npos ? "" : s.substr(first, last - first + 1);
}

/// Code, and the comment after it: "//", "///" or "///<".
std::pair<std::string, std::string> split(const std::string& line)
{
    const size_t slashes = line.find("//");
    if (slashes == std::string::npos) return {trimmed(line), ""};
    const size_t text = line.find_first_not_of("/<", slashes);
    return {trimmed(line.substr(0, slashes)), text == std::string::npos ? "" : trimmed(line.substr(text))};
}

/// The names that "vec4 row_x, row_y[2] DEFAULT(1)" declares.
std::vector<std::string> declared(std::string code)
{
    static const std::regex noise(R"(DEFAULT\([^()]*(\([^()]*\))?[^()]*\)|\[[^\]]*\])"), name(R"((\w+)\s*(,|;|$))");
    code = std::regex_replace(code, noise, "");
    std::vector<std::string> out;
    for (std::sregex_iterator i(code.begin(), code.end(), name), end; i != end; ++i) out.push_back((*i)[1]);
    return out;
}

} // namespace

Comments::Comments(const std::map<std::string, std::string>& sources)
{
    for (const auto& [path, text] : sources) read(text);
}

std::string Comments::of(const std::string& type, const std::string& member) const
{
    const auto found = by_type_.find(type);
    if (found == by_type_.end()) return "";
    const auto comment = found->second.find(member);
    return comment == found->second.end() ? "" : comment->second;
}

void Comments::read(const std::string& text)
{
    static const std::regex opening(R"(^(?:struct|.*\b(?:buffer|uniform))\s+(\w+)\s*\{?(.*)$)");
    std::istringstream lines(text);
    std::string above, type;
    std::vector<std::string> last; // members of the line before, whose comment may go on
    for (std::string line; std::getline(lines, line);) {
        const auto [code, comment] = split(line);
        if (code.empty()) {
            if (!type.empty() && !comment.empty())
                for (const std::string& m : last) by_type_[type][m] += " " + comment;
            above = comment.empty() ? "" : above + (above.empty() ? "" : " ") + comment;
            continue;
        }
        std::smatch match;
        const bool block = code.find('{') != std::string::npos && std::regex_match(code, match, opening);
        if (block) {
            const bool one_line = code.find('}') != std::string::npos;
            const std::string own = comment.empty() ? above : comment;
            if (!own.empty()) by_type_[match[1]].emplace("", own);
            if (!one_line) type = match[1];
        } else if (code[0] == '}') {
            type.clear();
        } else if (code.find(';') != std::string::npos && !comment.empty()) {
            last = declared(code);
            // outside of blocks only resources: locals of functions have comments too
            if (!type.empty() || code.rfind("layout(", 0) == 0)
                for (const std::string& m : last) by_type_[type].emplace(m, comment);
            above.clear();
            continue;
        }
        above.clear();
        last.clear();
    }
}

} // namespace gnomon::lab
