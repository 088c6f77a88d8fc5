// SPDX-License-Identifier: Apache-2.0
#include "shadow/params.h"

#include "base/error.h"
#include "base/names.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace gnomon::shadow {

const ParamInfo* ParamTable::find(std::string_view name) const
{
    for (const ParamInfo& f : fields)
        if (f.name == name) return &f;
    return nullptr;
}

void Fields::add(ParamInfo info, const void* field)
{
    info.offset = size_t(static_cast<const std::byte*>(field) - base_);
    table_.fields.push_back(std::move(info));
}

void Fields::real(const char* name, float& field, Range range, const char* unit, const char* help)
{
    add({name, ParamType::real, 0, range, unit, help, {}}, &field);
}

void Fields::integer(const char* name, int& field, Range range, const char* unit, const char* help)
{
    add({name, ParamType::integer, 0, range, unit, help, {}}, &field);
}

void Fields::choice(const char* name, int& field, std::vector<std::string> names, const char* help)
{
    const double last = double(names.size()) - 1;
    add({name, ParamType::choice, 0, {0, last}, "", help, std::move(names)}, &field);
}

void Fields::flag(const char* name, int& field, const char* help) { add({name, ParamType::flag, 0, {0, 1}, "", help, {}}, &field); }

void check_tiling(const ParamTable& table)
{
    size_t expected = 0;
    for (const ParamInfo& f : table.fields) {
        if (f.offset != expected)
            throw std::logic_error(fmt::format("parameter '{}' is described out of place: a field before it is missing", f.name));
        expected += 4;
    }
    if (expected != table.defaults.size())
        throw std::logic_error(
            fmt::format("the description covers {} of {} bytes of the parameters: a field is missing", expected, table.defaults.size()));
}

ParamValues::ParamValues(ParamTable table)
    : table_(std::move(table))
    , bytes_(table_.defaults)
{
}

namespace {

const ParamInfo& require(const ParamTable& table, std::string_view name)
{
    if (const ParamInfo* info = table.find(name)) return *info;
    if (table.fields.empty()) base::fail("unknown parameter '{}': this technique has no parameters", name);
    std::vector<std::string> names;
    for (const ParamInfo& f : table.fields) names.push_back(f.name);
    throw base::Error(base::unknown_name("parameter", name, names));
}

double parse(const ParamInfo& info, std::string_view text)
{
    if (info.type == ParamType::choice) {
        for (size_t i = 0; i < info.choices.size(); ++i)
            if (info.choices[i] == text) return double(i);
        throw base::Error(base::unknown_name(fmt::format("value for parameter '{}':", info.name), text, info.choices));
    }
    if (info.type == ParamType::flag) {
        if (text == "true" || text == "on" || text == "1") return 1;
        if (text == "false" || text == "off" || text == "0") return 0;
        base::fail("parameter '{}' is on or off, not '{}'", info.name, text);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) base::fail("parameter '{}' takes a number, not '{}'", info.name, text);
    return value;
}

} // namespace

void ParamValues::set(std::string_view name, std::string_view value)
{
    const ParamInfo& info = require(table_, name);
    set(name, parse(info, value));
}

void ParamValues::set(std::string_view name, double value)
{
    const ParamInfo& info = require(table_, name);
    if (!std::isfinite(value) || value < info.range.min || value > info.range.max)
        base::fail("parameter '{}' takes {} to {}{}{}, not {}", info.name, info.range.min, info.range.max, info.unit.empty() ? "" : " ",
            info.unit, value);
    if (info.type == ParamType::real) {
        const float f = float(value);
        memcpy(bytes_.data() + info.offset, &f, 4);
        return;
    }
    if (value != std::floor(value)) base::fail("parameter '{}' takes whole numbers, not {}", info.name, value);
    const int32_t i = int32_t(value);
    memcpy(bytes_.data() + info.offset, &i, 4);
}

double ParamValues::get(const ParamInfo& info) const
{
    if (info.type == ParamType::real) {
        float f;
        memcpy(&f, bytes_.data() + info.offset, 4);
        return double(f);
    }
    int32_t i;
    memcpy(&i, bytes_.data() + info.offset, 4);
    return i;
}

std::string ParamValues::text(const ParamInfo& info) const
{
    const double value = get(info);
    if (info.type == ParamType::choice) return info.choices[size_t(value)];
    if (info.type == ParamType::flag) return value != 0 ? "on" : "off";
    return info.type == ParamType::real ? fmt::format("{}", float(value)) : fmt::format("{}", int(value));
}

nlohmann::ordered_json ParamValues::json() const
{
    nlohmann::ordered_json out = nlohmann::ordered_json::object();
    for (const ParamInfo& f : table_.fields) {
        if (f.type == ParamType::choice)
            out[f.name] = text(f);
        else if (f.type == ParamType::flag)
            out[f.name] = get(f) != 0;
        else if (f.type == ParamType::integer)
            out[f.name] = int(get(f));
        // through the shortest text that gives the same float: 0.1, not 0.10000000149
        else
            out[f.name] = std::stod(text(f));
    }
    return out;
}

void ParamValues::set_json(const nlohmann::ordered_json& values)
{
    if (!values.is_object()) base::fail("parameters are an object of name: value, not {}", values.type_name());
    for (const auto& [name, value] : values.items()) {
        if (value.is_string())
            set(name, std::string_view(value.get_ref<const std::string&>()));
        else if (value.is_boolean())
            set(name, value.get<bool>() ? 1.0 : 0.0);
        else if (value.is_number())
            set(name, value.get<double>());
        else
            base::fail("parameter '{}' takes a number, a name or true/false, not {}", name, value.type_name());
    }
}

} // namespace gnomon::shadow
