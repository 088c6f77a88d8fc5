// SPDX-License-Identifier: Apache-2.0
#include "base/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gnomon::base {

namespace {

std::string lower(std::string_view text)
{
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Damerau-Levenshtein in its optimal-string-alignment form: insert, delete, replace, swap neighbours.
size_t distance(const std::string& a, const std::string& b)
{
    std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

constexpr size_t longest_compared = 256; // the table of edits is quadratic; no name of ours comes near

} // namespace

std::vector<std::string> near_names(std::string_view name, std::span<const std::string> candidates)
{
    const std::string wanted = lower(name.substr(0, longest_compared));
    std::vector<std::pair<size_t, std::string>> found;
    for (const std::string& candidate : candidates) {
        const std::string other = lower(std::string_view(candidate).substr(0, longest_compared));
        size_t edits = distance(wanted, other);
        const bool part = wanted.size() >= 2 && other.size() >= 2
            && (other.find(wanted) != std::string::npos || wanted.find(other) != std::string::npos);
        // A third of the letters wrong is a typing error; more is another word. A part of the name is near whatever its length.
        const size_t tolerated = std::max<size_t>(1, std::max(wanted.size(), other.size()) / 3);
        if (part) edits = std::min(edits, tolerated);
        if (edits <= tolerated && edits < std::max(wanted.size(), other.size())) found.emplace_back(edits, candidate);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> result;
    for (size_t i = 0; i < found.size() && result.size() < 3; ++i)
        if (std::find(result.begin(), result.end(), found[i].second) == result.end()) result.push_back(found[i].second);
    return result;
}

std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string> candidates)
{
    const std::vector<std::string> near = near_names(name, candidates);
    std::string text = fmt::format("unknown {} '{}'", what, name);
    if (near.empty())
        return candidates.empty() ? text + "; there are none" : fmt::format("{}; choose one of {}", text, fmt::join(candidates, ", "));
    text += "; did you mean ";
    for (size_t i = 0; i < near.size(); ++i) text += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == near.size() ? " or " : ", ", near[i]);
    return text + "?";
}

} // namespace gnomon::base
