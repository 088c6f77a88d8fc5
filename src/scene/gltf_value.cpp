// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_value.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace gnomon::scene::gltf {

std::string printable(std::string_view text, size_t longest)
{
    std::string out;
    for (const char c : text.substr(0, longest)) out += (static_cast<unsigned char>(c) < 32 || c == 127) ? '?' : c;
    return text.size() > longest ? out + "..." : out;
}

std::string Value::sentence(std::string_view text) const
{
    return fmt::format("{}: {} {}", *file_, path_.empty() ? "the document" : path_, text);
}

void Value::wrong_form(std::string_view text) const
{
    base::fail("{}; export the file again, or find the fault with the Khronos glTF validator", sentence(text));
}

Value Value::find(std::string_view key) const
{
    if (!value_) return *this;
    if (!value_->is_object()) wrong_form("must be an object");
    const auto it = value_->find(key);
    std::string path = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    return Value(it == value_->end() ? nullptr : &*it, std::move(path), *file_);
}

Value Value::at(std::string_view key) const
{
    Value member = find(key);
    if (!member) wrong_form(fmt::format("must have a property '{}'", key));
    return member;
}

size_t Value::size() const
{
    if (!value_) return 0;
    if (!value_->is_array()) wrong_form("must be an array");
    return value_->size();
}

Value Value::operator[](size_t i) const { return Value(i < size() ? &(*value_)[i] : nullptr, fmt::format("{}[{}]", path_, i), *file_); }

double Value::number() const
{
    if (!value_ || !value_->is_number()) wrong_form("must be a number");
    return value_->get<double>();
}

uint64_t Value::integer() const
{
    const double n = number();
    if (n < 0 || n > 9007199254740992.0 || n != std::floor(n)) wrong_form(fmt::format("must be a whole number from 0, but is {}", n));
    return uint64_t(n);
}

bool Value::flag() const
{
    if (!value_ || !value_->is_boolean()) wrong_form("must be true or false");
    return value_->get<bool>();
}

const std::string& Value::text() const
{
    if (!value_ || !value_->is_string()) wrong_form("must be a text");
    return value_->get_ref<const std::string&>();
}

void Value::numbers(std::span<double> out) const
{
    if (size() != out.size()) wrong_form(fmt::format("must be an array of {} numbers", out.size()));
    for (size_t i = 0; i < out.size(); ++i) {
        if (!(*value_)[i].is_number()) wrong_form(fmt::format("must be an array of {} numbers", out.size()));
        out[i] = (*value_)[i].get<double>();
    }
}

double Value::number_or(std::string_view key, double otherwise) const
{
    const Value v = find(key);
    return v ? v.number() : otherwise;
}

uint64_t Value::integer_or(std::string_view key, uint64_t otherwise) const
{
    const Value v = find(key);
    return v ? v.integer() : otherwise;
}

bool Value::flag_or(std::string_view key, bool otherwise) const
{
    const Value v = find(key);
    return v ? v.flag() : otherwise;
}

std::string Value::text_or(std::string_view key, const std::string& otherwise) const
{
    const Value v = find(key);
    return v && !v.text().empty() ? v.text() : otherwise;
}

void Value::numbers_if(std::string_view key, std::span<double> out) const
{
    if (const Value v = find(key)) v.numbers(out);
}

} // namespace gnomon::scene::gltf
