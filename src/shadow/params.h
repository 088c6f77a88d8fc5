// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// Parameters of a technique: one struct shared by C++ and GLSL (<id>.shared.h), described once (describe in <id>.cpp). From the
// description come command-line options, JSON, sliders, sweep axes, doc tables and range tests.
namespace gnomon::shadow {

enum class ParamType { real, integer, choice, flag };

struct Range {
    double min, max; ///< both allowed
};

struct ParamInfo {
    std::string name;
    ParamType type;
    size_t offset; ///< in the struct; every field has 4 bytes
    Range range;
    std::string unit, help; ///< help: one sentence
    std::vector<std::string> choices; ///< choice: the names of 0, 1, 2 ...
};

/// The description of one Params struct and its defaults.
struct ParamTable {
    std::vector<ParamInfo> fields; ///< in the order of the struct
    std::vector<std::byte> defaults; ///< the struct as it is born
    const ParamInfo* find(std::string_view name) const;
};

/// Handed to `describe`, which names each field of the struct exactly once.
class Fields {
public:
    Fields(const void* base, ParamTable& table)
        : base_(static_cast<const std::byte*>(base))
        , table_(table)
    {
    }
    void real(const char* name, float& field, Range, const char* unit, const char* help);
    void integer(const char* name, int& field, Range, const char* unit, const char* help);
    void choice(const char* name, int& field, std::vector<std::string> names, const char* help);
    void flag(const char* name, int& field, const char* help);

private:
    void add(ParamInfo, const void* field);
    const std::byte* base_;
    ParamTable& table_;
};

/// The table of a struct. Throws std::logic_error where the described fields do not tile the struct (a forgotten field).
template <class Params> ParamTable param_table(void (*describe)(Params&, Fields&))
{
    static_assert(std::is_trivially_copyable_v<Params>);
    ParamTable table;
    Params params{};
    Fields fields(&params, table);
    describe(params, fields);
    const auto* bytes = reinterpret_cast<const std::byte*>(&params);
    table.defaults.assign(bytes, bytes + sizeof(Params));
    void check_tiling(const ParamTable&);
    check_tiling(table);
    return table;
}

/// A technique without parameters.
struct NoParams { };
inline ParamTable no_params() { return {}; }

/// Values for one table.
class ParamValues {
public:
    explicit ParamValues(ParamTable);
    const ParamTable& table() const { return table_; }
    std::span<const std::byte> bytes() const { return bytes_; }
    /// "0.5", "true", "d16". Throws Error: unknown name lists the near ones, a value out of range states the range.
    void set(std::string_view name, std::string_view value);
    void set(std::string_view name, double value);
    double get(const ParamInfo&) const; ///< choice: its index; flag: 0 or 1
    std::string text(const ParamInfo&) const; ///< as `set` reads it
    nlohmann::ordered_json json() const;
    void set_json(const nlohmann::ordered_json&); ///< an object of name: value

private:
    ParamTable table_;
    std::vector<std::byte> bytes_;
};

} // namespace gnomon::shadow
