// SPDX-License-Identifier: Apache-2.0
#include "scene/json_reader.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_depth.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

std::string escaped(std::string_view key) // RFC 6901
{
    std::string result;
    for (char c : key) result += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return result;
}

} // namespace

void JsonReader::fail(const std::string& what) const
{
    base::fail("scene file '{}' at {}: {}", file_, pointer_.empty() ? "its top" : pointer_, what);
}

void JsonReader::check_keys(std::span<const std::string> keys) const
{
    if (!value_.is_object()) fail("must be an object in braces");
    for (const auto& [key, ignored] : value_.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) at(key).fail(base::unknown_name("key", key, keys));
}

JsonReader JsonReader::at(std::string_view key) const
{
    if (!has(key)) fail(fmt::format("the key '{}' is missing", key));
    return {value_.at(std::string(key)), file_, pointer_ + "/" + escaped(key)};
}

JsonReader JsonReader::at(size_t index) const { return {value_.at(index), file_, pointer_ + "/" + std::to_string(index)}; }

size_t JsonReader::array_size() const
{
    if (!value_.is_array()) fail("must be an array in brackets");
    return value_.size();
}

std::string JsonReader::text() const
{
    if (!value_.is_string()) fail("must be a text in quotes");
    return value_.get<std::string>();
}

bool JsonReader::truth() const
{
    if (!value_.is_boolean()) fail("must be true or false");
    return value_.get<bool>();
}

double JsonReader::number(double low, double high) const
{
    if (!value_.is_number()) fail("must be a number");
    const double number = value_.get<double>();
    if (!(number >= low && number <= high)) fail(fmt::format("is {:.9g}, outside its range {:g} to {:g}", number, low, high));
    return number;
}

vec3 JsonReader::vector(float low, float high) const
{
    if (!value_.is_array() || value_.size() != 3) fail("must be an array of three numbers");
    return {at(size_t(0)).real(low, high), at(1).real(low, high), at(2).real(low, high)};
}

vec3 JsonReader::direction() const
{
    const vec3 v = vector();
    const float length = glm::length(v);
    if (!(length > 0.0f)) fail("is a direction of zero length");
    return v / length;
}

nlohmann::json read_json(const std::filesystem::path& file)
{
    const std::string text = base::read_text(file, uint64_t(16) << 20);
    base::check_json_depth(text, file.string());
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) { // parse_error, or out_of_range for 1e999
        // The message carries line and column after a library tag in brackets.
        const std::string what = error.what();
        const size_t tag = what.find("] ");
        throw base::Error(
            fmt::format("scene file '{}' is no JSON: {}", file.string(), tag == std::string::npos ? what : what.substr(tag + 2)));
    }
}

} // namespace gnomon::scene
