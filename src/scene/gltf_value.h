// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene::gltf {

/// Wrong data or a reference to nothing: the element it concerns can be left out and the rest of the file used. A breach of the
/// glTF form (a string for a number, a property that must be there) is a plain base::Error and ends the loading.
class DataError : public base::Error {
public:
    using Error::Error;
};

/// A JSON value with its place in the file, so that every message can name both. Null (false) stands for an absent value;
/// looking something up in an absent value gives an absent one. Every reader checks the type.
class Value {
public:
    Value(const nlohmann::json* value, std::string path, const std::string& file)
        : value_(value)
        , path_(std::move(path))
        , file_(&file)
    {
    }
    explicit operator bool() const { return value_ != nullptr; }
    const std::string& path() const { return path_; }

    Value find(std::string_view key) const; ///< absent where the object has no such member
    Value at(std::string_view key) const; ///< must be there
    Value extension(std::string_view name) const { return find("extensions").find(name); }
    size_t size() const; ///< of an array; 0 where absent
    Value operator[](size_t i) const;

    double number() const;
    uint64_t integer() const; ///< 0 ... 2^53; 3.0 counts as 3
    bool flag() const;
    const std::string& text() const;
    void numbers(std::span<double> out) const; ///< an array of exactly that many

    double number_or(std::string_view key, double otherwise) const;
    uint64_t integer_or(std::string_view key, uint64_t otherwise) const;
    bool flag_or(std::string_view key, bool otherwise) const;
    std::string text_or(std::string_view key, const std::string& otherwise) const; ///< an empty text counts as absent
    void numbers_if(std::string_view key, std::span<double> out) const; ///< leaves `out` where absent

    /// Throws DataError "FILE: PATH TEXT".
    template <class... Args> [[noreturn]] void bad(fmt::format_string<Args...> text, Args&&... args) const
    {
        throw DataError(sentence(fmt::format(text, std::forward<Args>(args)...)));
    }

private:
    std::string sentence(std::string_view text) const;
    [[noreturn]] void wrong_form(std::string_view text) const;
    const nlohmann::json* value_;
    std::string path_;
    const std::string* file_;
};

/// `text` fit for a message of one line: control characters become '?', and a text longer than `longest` is cut.
std::string printable(std::string_view text, size_t longest = 80);

} // namespace gnomon::scene::gltf
