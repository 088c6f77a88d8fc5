// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"

#include <cstring>
#include <set>

namespace gnomon::lab {

namespace {

template <class T> T read(std::span<const std::byte> bytes, size_t offset)
{
    T value{};
    if (offset + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

/// Words that a type of GLSL takes in scalar layout, and the kind of them: 'f', 'i', 'u'. {0, ' '}: a struct.
std::pair<uint32_t, char> words_of(const std::string& type)
{
    static const std::map<std::string, std::pair<uint32_t, char>> known{{"float", {1, 'f'}}, {"int", {1, 'i'}}, {"uint", {1, 'u'}},
        {"vec2", {2, 'f'}}, {"vec3", {3, 'f'}}, {"vec4", {4, 'f'}}, {"ivec2", {2, 'i'}}, {"ivec3", {3, 'i'}}, {"ivec4", {4, 'i'}},
        {"uvec2", {2, 'u'}}, {"uvec3", {3, 'u'}}, {"uvec4", {4, 'u'}}, {"mat2", {4, 'f'}}, {"mat3", {9, 'f'}}, {"mat4", {16, 'f'}},
        {"mat3x4", {12, 'f'}}, {"mat4x3", {12, 'f'}}};
    const auto found = known.find(type);
    return found == known.end() ? std::pair{0u, ' '} : found->second;
}

Json decode_value(std::span<const std::byte> bytes, size_t offset, const std::string& type, const Json& types)
{
    const auto [words, kind] = words_of(type);
    if (words == 0)
        return types.contains(type) ? decode_block(bytes.subspan(std::min(offset, bytes.size())), types[type]["members"], types) : Json();
    Json out = Json::array();
    for (uint32_t i = 0; i < words; ++i) {
        const size_t at = offset + i * 4;
        if (kind == 'f')
            out.push_back(read<float>(bytes, at));
        else if (kind == 'i')
            out.push_back(read<int32_t>(bytes, at));
        else
            out.push_back(read<uint32_t>(bytes, at));
    }
    return words == 1 ? out[0] : out;
}

Json decode_array(std::span<const std::byte> bytes, const Json& member, const Json& types)
{
    uint32_t count = 1;
    for (const Json& side : member["array"]) count *= side.get<uint32_t>();
    Json out = Json::array();
    for (uint32_t i = 0; i < count; ++i)
        out.push_back(decode_value(bytes, member["offset"].get<size_t>() + i * member["stride"].get<size_t>(), member["type"], types));
    return out;
}

class HeaderWriter {
public:
    explicit HeaderWriter(const Json& types)
        : types_(types)
    {
    }

    std::string text()
    {
        out_
            = "// The structs of the constants blocks and storage buffers, in scalar layout: every member is made of 4-byte words and lies "
              "where C++ puts it.\n// Written by `gnomon export`; the assertions are the offsets that the shaders were compiled with.\n"
              "#pragma once\n\n#include <cstddef>\n#include <cstdint>\n\nnamespace layouts {\n\nusing uint = uint32_t;\n";
        for (const auto& [name, words] : {std::pair{"vec2", 2}, {"vec3", 3}, {"vec4", 4}})
            out_ += fmt::format("struct {} {{ float v[{}]; }};\n", name, words);
        for (const auto& [name, words] : {std::pair{"ivec2", 2}, {"ivec3", 3}, {"ivec4", 4}})
            out_ += fmt::format("struct {} {{ int v[{}]; }};\n", name, words);
        for (const auto& [name, words] : {std::pair{"uvec2", 2}, {"uvec3", 3}, {"uvec4", 4}})
            out_ += fmt::format("struct {} {{ uint v[{}]; }};\n", name, words);
        for (const auto& [name, columns, rows] :
            {std::tuple{"mat2", 2, 2}, {"mat3", 3, 3}, {"mat4", 4, 4}, {"mat3x4", 3, 4}, {"mat4x3", 4, 3}})
            out_ += fmt::format("struct {} {{ float column[{}][{}]; }};\n", name, columns, rows);
        for (const auto& [name, type] : types_.items()) write(name);
        return out_ + "\n} // namespace layouts\n";
    }

private:
    void write(const std::string& name)
    {
        if (!done_.insert(name).second) return;
        const Json& type = types_[name];
        for (const Json& m : type["members"])
            if (types_.contains(m["type"].get<std::string>())) write(m["type"]);
        out_ += "\n";
        if (type.contains("meaning")) out_ += fmt::format("/// {}\n", type["meaning"].get<std::string>());
        out_ += fmt::format("struct {} {{\n", name);
        std::string checks;
        for (const Json& m : type["members"]) {
            std::string sides;
            for (const Json& side : m.value("array", Json::array())) sides += fmt::format("[{}]", side.get<uint32_t>());
            const std::string member = m["name"];
            out_ += fmt::format("    {} {}{};{}\n", m["type"].get<std::string>(), member, sides,
                m.contains("meaning") ? " ///< " + m["meaning"].get<std::string>() : "");
            checks += fmt::format("static_assert(offsetof({}, {}) == {});\n", name, member, m["offset"].get<uint32_t>());
        }
        out_ += "};\n" + checks;
        out_ += fmt::format("static_assert(sizeof({}) == {});\n", name, type["bytes"].get<uint32_t>());
    }

    const Json& types_;
    std::set<std::string> done_;
    std::string out_;
};

} // namespace

Json decode_block(std::span<const std::byte> bytes, const Json& members, const Json& types)
{
    Json out = Json::object();
    for (const Json& m : members)
        out[m["name"].get<std::string>()]
            = m.contains("array") ? decode_array(bytes, m, types) : decode_value(bytes, m["offset"].get<size_t>(), m["type"], types);
    return out;
}

std::string layout_header(const Json& types) { return HeaderWriter(types).text(); }

} // namespace gnomon::lab
