// SPDX-License-Identifier: Apache-2.0
#include "lab/export_spirv.h"

#include <cstring>
#include <set>

#include <spirv_cross_c.h>

namespace gnomon::lab {

namespace {

constexpr size_t header_words = 5;

template <class Word> struct Instruction {
    uint32_t op;
    std::span<Word> words; ///< the first holds length and op
};

/// The modules come from this program's own compiler; a broken one would still end the walk.
template <class Module, class Visit> void for_each(Module&& module, Visit visit)
{
    using Word = std::remove_reference_t<decltype(module[0])>;
    for (size_t i = header_words; i < module.size();) {
        const size_t length = module[i] >> 16;
        if (length == 0 || i + length > module.size()) return;
        visit(Instruction<Word>{module[i] & 0xffffu, std::span<Word>(module.data() + i, length)});
        i += length;
    }
}

template <class Word> std::string text_of(std::span<Word> words)
{
    const char* chars = reinterpret_cast<const char*>(words.data());
    return {chars, strnlen(chars, words.size_bytes())};
}

void append(Words& out, std::span<const uint32_t> words) { out.insert(out.end(), words.begin(), words.end()); }

uint32_t first_word(SpvOp op, uint32_t length) { return length << 16 | uint32_t(op); }

/// The variable with this BuiltIn decoration, 0 = none; the decoration becomes `now`.
uint32_t redecorate(Words& words, SpvBuiltIn from, SpvBuiltIn now)
{
    uint32_t id = 0;
    for_each(words, [&](Instruction<uint32_t> i) {
        if (i.op == SpvOpDecorate && i.words[2] == SpvDecorationBuiltIn && i.words[3] == uint32_t(from)) {
            id = i.words[1];
            i.words[3] = uint32_t(now);
        }
    });
    return id;
}

} // namespace

std::map<std::string, std::string> sources_of(std::span<const uint32_t> words, std::string_view shader)
{
    std::map<uint32_t, std::string> paths;
    std::vector<std::pair<uint32_t, std::string>> texts;
    for_each(words, [&](Instruction<const uint32_t> i) {
        if (i.op == SpvOpString) paths[i.words[1]] = text_of(i.words.subspan(2));
        if (i.op == SpvOpSource && i.words.size() > 4) texts.emplace_back(i.words[3], text_of(i.words.subspan(4)));
        if (i.op == SpvOpSourceContinued && !texts.empty()) texts.back().second += text_of(i.words.subspan(1));
    });
    // the shader's own path ends with its name: what goes before is where it was built
    const std::string own = std::string(shader) + ".glsl";
    std::string root;
    for (const auto& [id, path] : paths)
        if (path.ends_with(own)) root = path.substr(0, path.size() - own.size());
    std::map<std::string, std::string> out;
    for (auto& [id, text] : texts) {
        const std::string& path = paths[id];
        if (path.starts_with(root)) out[path.substr(root.size())] = std::move(text);
    }
    return out;
}

Words without_sources(std::span<const uint32_t> words)
{
    static const std::set<uint32_t> debug{
        SpvOpSource, SpvOpSourceContinued, SpvOpSourceExtension, SpvOpString, SpvOpLine, SpvOpNoLine, SpvOpModuleProcessed};
    Words out(words.begin(), words.begin() + header_words);
    for_each(words, [&](Instruction<const uint32_t> i) {
        if (!debug.count(i.op)) append(out, i.words);
    });
    return out;
}

void set_defaults(Words& words, std::span<const gpu::SpecConstant> constants)
{
    std::map<uint32_t, uint32_t> values; // by result id
    for_each(words, [&](Instruction<uint32_t> i) {
        if (i.op == SpvOpDecorate && i.words[2] == SpvDecorationSpecId)
            for (const gpu::SpecConstant& c : constants)
                if (c.id == i.words[3]) values[i.words[1]] = c.value;
        if (i.op != SpvOpSpecConstant && i.op != SpvOpSpecConstantTrue && i.op != SpvOpSpecConstantFalse) return;
        const auto found = values.find(i.words[2]);
        if (found == values.end()) return;
        if (i.op == SpvOpSpecConstant)
            i.words[3] = found->second;
        else
            i.words[0] = first_word(found->second ? SpvOpSpecConstantTrue : SpvOpSpecConstantFalse, 3);
    });
}

void uniforms_to_storage(Words& words)
{
    for_each(words, [](Instruction<uint32_t> i) {
        if (i.op == SpvOpTypePointer && i.words[2] == SpvStorageClassUniform) i.words[2] = SpvStorageClassStorageBuffer;
        if (i.op == SpvOpVariable && i.words[3] == SpvStorageClassUniform) i.words[3] = SpvStorageClassStorageBuffer;
    });
}

void layer_to_location(Words& words)
{
    for_each(words, [](Instruction<uint32_t> i) {
        if (i.op != SpvOpDecorate || i.words[2] != SpvDecorationBuiltIn || i.words[3] != SpvBuiltInLayer) return;
        i.words[2] = SpvDecorationLocation;
        i.words[3] = layer_location;
    });
}

void integers_to_floats(Words& words)
{
    uint32_t real = 0;
    std::set<uint32_t> integers;
    for_each(words, [&](Instruction<uint32_t> i) {
        if (i.op == SpvOpTypeFloat && i.words[2] == 32) real = i.words[1];
        if (i.op == SpvOpTypeInt) integers.insert(i.words[1]);
    });
    constexpr uint32_t sampled = 1; // and not a storage image
    for_each(words, [&](Instruction<uint32_t> i) {
        if (real && i.op == SpvOpTypeImage && integers.count(i.words[2]) && i.words[7] == sampled) i.words[2] = real;
    });
}

void waves_from_lanes(Words& words, uint32_t group_size)
{
    // NumSubgroups' variable is read as the lanes of a wave from here on, and SubgroupId's as the place in the group
    const uint32_t count = redecorate(words, SpvBuiltInNumSubgroups, SpvBuiltInSubgroupSize);
    const uint32_t index = count ? redecorate(words, SpvBuiltInSubgroupId, SpvBuiltInLocalInvocationIndex) : 0;
    if (!count) return;
    uint32_t type = 0;
    for_each(words, [&](Instruction<uint32_t> i) {
        if (i.op == SpvOpTypeInt && i.words[2] == 32 && i.words[3] == 0) type = i.words[1];
    });
    uint32_t next = words[3];
    const uint32_t most = next++; // the constant group_size - 1
    Words out(words.begin(), words.begin() + header_words);
    for_each(words, [&](Instruction<uint32_t> i) {
        const bool load = i.op == SpvOpLoad && (i.words[3] == count || (index && i.words[3] == index));
        if (!load) append(out, i.words);
        if (i.op == SpvOpTypeInt && i.words[1] == type) append(out, Words{first_word(SpvOpConstant, 4), type, most, group_size - 1});
        if (!load) return;
        const uint32_t lanes = next++, result = i.words[2];
        append(out, Words{first_word(SpvOpLoad, 4), type, lanes, count});
        const uint32_t number = next++;
        if (i.words[3] == index)
            append(out, Words{first_word(SpvOpLoad, 4), type, number, index});
        else
            append(out, Words{first_word(SpvOpIAdd, 5), type, number, most, lanes}); // (size - 1 + lanes) / lanes rounds up
        append(out, Words{first_word(SpvOpUDiv, 5), type, result, number, lanes});
    });
    out[3] = next;
    words = std::move(out);
}

void give_table_size(Words& words)
{
    std::set<uint32_t> sampled;
    uint32_t next = words[3];
    Words out(words.begin(), words.begin() + header_words);
    for_each(words, [&](Instruction<uint32_t> i) {
        if (i.op == SpvOpTypeSampledImage) sampled.insert(i.words[1]);
        if (i.op != SpvOpTypeRuntimeArray || !sampled.count(i.words[2])) {
            append(out, i.words);
            return;
        }
        const uint32_t type = next++, size = next++;
        append(out, Words{first_word(SpvOpTypeInt, 4), type, 32, 0});
        append(out, Words{first_word(SpvOpConstant, 4), type, size, table_size});
        append(out, Words{first_word(SpvOpTypeArray, 4), i.words[1], i.words[2], size});
    });
    out[3] = next;
    words = std::move(out);
}

} // namespace gnomon::lab
