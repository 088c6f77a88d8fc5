// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene {

/// One value of a JSON file with its place, so that every error names the file and the JSON pointer.
class JsonReader {
public:
    JsonReader(const nlohmann::json& value, std::string file, std::string pointer = "")
        : value_(value)
        , file_(std::move(file))
        , pointer_(std::move(pointer))
    {
    }

    /// Throws Error unless this is an object whose keys are all among these.
    void check_keys(std::span<const std::string> keys) const;
    bool has(std::string_view key) const { return value_.is_object() && value_.contains(key); }
    JsonReader at(std::string_view key) const; ///< Error where it is missing
    JsonReader at(size_t index) const;
    size_t array_size() const; ///< Error unless an array
    bool is_text() const { return value_.is_string(); }
    std::string text() const;
    bool truth() const;
    double number(double low, double high) const; ///< Error unless a finite number in [low, high]
    float real(float low, float high) const { return float(number(double(low), double(high))); }
    vec3 vector(float low = -1e9f, float high = 1e9f) const;
    vec3 direction() const; ///< unit; Error at zero length
    std::string place() const { return file_ + ", " + pointer_; }
    [[noreturn]] void fail(const std::string& what) const;

private:
    const nlohmann::json& value_;
    std::string file_, pointer_;
};

/// The parsed file. Throws Error naming the file and, where it is no JSON, line and column.
nlohmann::json read_json(const std::filesystem::path&);

} // namespace gnomon::scene
