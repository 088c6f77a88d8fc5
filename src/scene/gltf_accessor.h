// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf_document.h"
#include "scene/math.h"

#include <initializer_list>

namespace gnomon::scene::gltf {

/// glTF's codes for the types of numbers.
enum class Component : uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// A checked accessor: every element lies inside its buffer view.
struct Accessor {
    Value value;
    size_t count = 0;
    int width = 1; ///< numbers an element
    Component component = Component::f32;
    bool normalized = false;
    std::span<const std::byte> bytes; ///< from the first element on; empty: all zero but for the sparse values
    size_t stride = 0;
};

/// The accessor that the index `reference` names. Its type must be one of `types` ("SCALAR", "VEC3" ...). Throws DataError.
Accessor open_accessor(Document&, const Value& reference, std::initializer_list<std::string_view> types);

/// Its numbers, count * width of them, with sparse values and normalisation applied.
void read_floats(Document&, const Accessor&, float* out);
/// Its whole numbers; DataError where it holds floats or signed ones.
std::vector<uint32_t> read_integers(Document&, const Accessor&);

/// Its elements as vectors. An element narrower than V (a colour without alpha) is not accepted here.
template <class V> std::vector<V> read_vectors(Document& document, const Accessor& accessor)
{
    if (accessor.width != V::length()) accessor.value.bad("must have {} numbers an element, but has {}", V::length(), accessor.width);
    std::vector<V> out(accessor.count);
    if (!out.empty()) read_floats(document, accessor, &out[0].x);
    return out;
}

} // namespace gnomon::scene::gltf
