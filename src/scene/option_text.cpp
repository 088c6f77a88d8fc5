// SPDX-License-Identifier: Apache-2.0
#include "scene/option_text.h"

#include "base/error.h"
#include "base/names.h"

#include <charconv>
#include <cmath>

namespace gnomon::scene {

namespace {

constexpr float largest_coordinate = 1e9f;

std::string_view trimmed(std::string_view s)
{
    while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
    while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
    return s;
}

std::vector<std::string_view> split(std::string_view text, char at)
{
    std::vector<std::string_view> parts;
    for (;;) {
        const size_t end = text.find(at);
        parts.push_back(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

template <class Number> bool parse_number(std::string_view text, Number& value)
{
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

vec3 three_numbers(const OptionPlace& place, std::string_view value, float low, float high)
{
    const auto parts = split(value, '/');
    if (parts.size() != 3)
        base::fail("{} '{}': {} is '{}', but takes three numbers with slashes, such as 1/2.5/-3", place.what, place.text, place.key, value);
    vec3 result(0.0f);
    for (int i = 0; i < 3; ++i) result[i] = option_number(place, parts[size_t(i)], low, high);
    return result;
}

} // namespace

OptionText split_options(std::string_view text)
{
    OptionText result;
    for (std::string_view part : split(text, ',')) {
        const size_t equals = part.find('=');
        if (equals != std::string_view::npos)
            result.pairs.emplace_back(trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1)));
        else if (!result.pairs.empty())
            base::fail("'{}': '{}' is no key=value pair; names stand first, and no value may hold a comma", text, part);
        else
            result.name += (result.name.empty() ? "" : ", ") + std::string(part);
    }
    return result;
}

float option_number(const OptionPlace& place, std::string_view value, float low, float high, std::string_view unit)
{
    float number = 0.0f;
    if (!parse_number(value, number))
        base::fail("{} '{}': {} is '{}', which is no finite number", place.what, place.text, place.key, value);
    if (number < low || number > high)
        base::fail("{} '{}': {} is {}, outside its range {} to {}{}{}", place.what, place.text, place.key, value, low, high,
            unit.empty() ? "" : " ", unit);
    return number;
}

vec3 option_vec3(const OptionPlace& place, std::string_view value)
{
    return three_numbers(place, value, -largest_coordinate, largest_coordinate);
}

vec3 option_point(const OptionPlace& place, std::string_view value, vec3 origin)
{
    const vec3 checked = option_vec3(place, value);
    if (origin == vec3(0)) return checked;
    const auto parts = split(value, '/');
    glm::dvec3 exact(0.0);
    for (int i = 0; i < 3; ++i) parse_number(parts[size_t(i)], exact[i]);
    return vec3(exact - glm::dvec3(origin));
}

vec3 option_color(const OptionPlace& place, std::string_view value)
{
    if (!value.starts_with('#')) return three_numbers(place, value, 0.0f, largest_coordinate);
    uint32_t rgb = 0;
    const auto [end, error] = std::from_chars(value.data() + 1, value.data() + value.size(), rgb, 16);
    if (value.size() != 7 || error != std::errc() || end != value.data() + value.size())
        base::fail(
            "{} '{}': {} is '{}', but takes r/g/b or six hexadecimal digits, such as #ffe0b0", place.what, place.text, place.key, value);
    vec3 color(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float c = float(rgb >> (16 - 8 * i) & 255u) / 255.0f;
        color[i] = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); // IEC 61966-2-1
    }
    return color;
}

void unknown_key(const OptionPlace& place, std::span<const std::string> keys)
{
    base::fail("{} '{}': {}", place.what, place.text, base::unknown_name("key", place.key, keys));
}

} // namespace gnomon::scene
