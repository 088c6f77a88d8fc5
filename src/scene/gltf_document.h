// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf_value.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

namespace gnomon::scene::gltf {

/// An opened .glb or .gltf: its JSON, its bytes, and the warnings of the loading. Buffers are read when first asked for.
///
/// The JSON is read by Gnomon itself rather than by tinygltf: tinygltf keeps a second copy of every array and picture, gives up the
/// place in the file that messages name, reads sparse, quantised and compressed accessors no further than their JSON anyway, and
/// must be guarded against malformed files by the very checks that are here.
class Document {
public:
    explicit Document(const std::filesystem::path&);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const std::string& file() const { return file_; }
    Value root() const { return Value(&json_, "", file_); }
    size_t count(std::string_view collection) const { return root().find(collection).size(); }
    Value element(std::string_view collection, size_t i) const { return root().find(collection)[i]; }
    /// What the index `reference` (a number in the file) points at; DataError where there is nothing.
    Value element(std::string_view collection, const Value& reference) const;

    /// The bytes of the buffer view with that index, decompressed. Valid as long as the document.
    std::span<const std::byte> view(const Value& reference);
    /// What a URI names: the bytes of a data URI, or of a file beside the document.
    std::vector<std::byte> resource(const Value& uri) const;

    static constexpr uint64_t most_unstored = 1 << 24; ///< numbers of accessors without data, of all together
    /// Counts so many of them; false where they would be too many, and then they are not counted.
    bool take_unstored(uint64_t numbers)
    {
        if (numbers > most_unstored - unstored_) return false;
        unstored_ += numbers;
        return true;
    }

    static constexpr uint64_t most_read = uint64_t(1) << 35; ///< numbers in all: minutes, where a thousand users read one large array
    void take_read(uint64_t numbers)
    {
        read_ += numbers;
        if (read_ > most_read)
            base::fail("{}: more than {} numbers would have to be read, because large arrays are used again and again; simplify it with "
                       "gltfpack",
                file_, most_read);
    }

    void warn(std::string sentence);
    /// Runs `f`; a DataError becomes a warning that ends in `consequence`. Whether all went well.
    template <class F> bool recover(std::string_view consequence, F&& f)
    {
        try {
            f();
            return true;
        } catch (const DataError& e) {
            warn(fmt::format("{}; {}", e.what(), consequence));
            return false;
        }
    }
    std::vector<std::string> take_warnings();

private:
    struct Bytes {
        std::vector<std::byte> owned;
        std::span<const std::byte> bytes;
        std::string error; ///< a failure is remembered too, so that a thousand users of a missing buffer try it once
    };
    void read_container(const std::filesystem::path&);
    void check_header() const;
    template <class F> std::span<const std::byte> remembered(std::map<size_t, Bytes>& cache, size_t key, F&& read);
    std::span<const std::byte> buffer(const Value& reference);
    std::span<const std::byte> slice(const Value& view_like);
    void decompress(const Value& extension, std::vector<std::byte>& out);

    std::string file_;
    std::filesystem::path folder_;
    std::vector<std::byte> content_; ///< of a .glb: the binary chunk lies in it
    std::span<const std::byte> binary_chunk_;
    nlohmann::json json_;
    std::map<size_t, Bytes> buffers_, decompressed_;
    std::vector<std::string> warnings_;
    size_t unlisted_warnings_ = 0;
    uint64_t unstored_ = 0, read_ = 0;
};

} // namespace gnomon::scene::gltf
