// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace gnomon::scene::gltf {
namespace {

struct Shape {
    std::string_view name;
    int width;
};
constexpr Shape shapes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};

size_t component_size(Component c)
{
    return c == Component::i8 || c == Component::u8 ? 1 : c == Component::i16 || c == Component::u16 ? 2 : 4;
}

Component component_of(const Value& owner)
{
    const uint64_t code = owner.at("componentType").integer();
    const bool known = code >= 5120 && code <= 5126 && code != 5124;
    if (!known) owner.bad("has the unknown componentType {}", code);
    return Component(code);
}

/// The bytes of `count` elements in a buffer view, from `owner`'s own byteOffset on.
std::span<const std::byte> elements(Document& document, const Value& owner, size_t count, size_t element, size_t stride)
{
    const std::span<const std::byte> view = document.view(owner.at("bufferView"));
    const uint64_t offset = owner.integer_or("byteOffset", 0);
    // No overflow: count < 2^32 and stride < 2^16.
    const uint64_t needed = count == 0 ? 0 : (count - 1) * stride + element;
    if (offset > view.size() || needed > view.size() - offset)
        owner.bad("needs {} bytes from byte {} on, but its buffer view has {}", needed, offset, view.size());
    return view.subspan(offset, needed);
}

template <class In, class Out> Out converted(In value, bool normalized)
{
    if constexpr (std::is_same_v<Out, float> && !std::is_same_v<In, float>) {
        // A signed -2^(n-1) would be a little below -1: the format clamps it.
        if (normalized) return std::max(float(double(value) / double(std::numeric_limits<In>::max())), -1.0f);
    }
    return Out(value);
}

template <class In, class Out>
void convert(std::span<const std::byte> bytes, size_t stride, size_t count, size_t width, bool normalized, Out* out)
{
    if (std::is_same_v<In, Out> && stride == width * sizeof(In)) {
        if (!bytes.empty()) std::memcpy(out, bytes.data(), bytes.size());
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < width; ++k) {
            In value;
            std::memcpy(&value, bytes.data() + i * stride + k * sizeof(In), sizeof(In)); // may lie unaligned
            out[i * width + k] = converted<In, Out>(value, normalized);
        }
    }
}

template <class Out> void convert(const Accessor& a, std::span<const std::byte> bytes, size_t stride, size_t count, Out* out)
{
    const size_t width = size_t(a.width);
    switch (a.component) {
    case Component::i8:
        return convert<int8_t>(bytes, stride, count, width, a.normalized, out);
    case Component::u8:
        return convert<uint8_t>(bytes, stride, count, width, a.normalized, out);
    case Component::i16:
        return convert<int16_t>(bytes, stride, count, width, a.normalized, out);
    case Component::u16:
        return convert<uint16_t>(bytes, stride, count, width, a.normalized, out);
    case Component::u32:
        return convert<uint32_t>(bytes, stride, count, width, a.normalized, out);
    case Component::f32:
        if constexpr (std::is_same_v<Out, float>) return convert<float>(bytes, stride, count, width, a.normalized, out);
    }
    a.value.bad("must hold whole numbers");
}

template <class Out> void apply_sparse(Document& document, const Accessor& a, Out* out)
{
    const Value sparse = a.value.find("sparse");
    if (!sparse) return;
    const size_t width = size_t(a.width), element = width * component_size(a.component);
    const uint64_t count = sparse.at("count").integer();
    if (count > a.count) sparse.bad("replaces {} elements of {}", count, a.count);
    const Value indices = sparse.at("indices"), values = sparse.at("values");
    Accessor index{indices, size_t(count), 1, component_of(indices), false, {}, 0};
    index.stride = component_size(index.component);
    index.bytes = elements(document, indices, index.count, index.stride, index.stride);
    const std::vector<uint32_t> where = read_integers(document, index);
    const std::span<const std::byte> bytes = elements(document, values, size_t(count), element, element);
    for (size_t i = 0; i < where.size(); ++i) {
        if (where[i] >= a.count) indices.bad("replaces element {} of {}", where[i], a.count);
        convert(a, bytes.subspan(i * element, element), element, 1, out + where[i] * width);
    }
}

template <class Out> void read(Document& document, const Accessor& a, Out* out)
{
    document.take_read(a.count * uint64_t(a.width));
    if (a.bytes.empty())
        std::fill_n(out, a.count * size_t(a.width), Out(0));
    else
        convert(a, a.bytes, a.stride, a.count, out);
    apply_sparse(document, a, out);
}

} // namespace

Accessor open_accessor(Document& document, const Value& reference, std::initializer_list<std::string_view> types)
{
    const Value value = document.element("accessors", reference);
    const std::string& type = value.at("type").text();
    if (std::ranges::find(types, type) == types.end())
        reference.bad("must name an accessor of type {}, but {} is {}", fmt::join(types, " or "), value.path(), printable(type));
    const auto* shape = std::ranges::find(shapes, type, &Shape::name);
    Accessor a{value, 0, shape->width, component_of(value), value.flag_or("normalized", false), {}, 0};
    const uint64_t count = value.at("count").integer();
    const size_t element = size_t(a.width) * component_size(a.component);
    const bool stored = bool(value.find("bufferView"));
    if (count > std::numeric_limits<uint32_t>::max()) value.bad("states {} elements, which is too many", count);
    // Without a buffer view nothing but this bounds the memory that a wrong count takes, or a thousand users of it.
    if (!stored && !document.take_unstored(count * uint64_t(a.width)))
        value.bad("states {} elements without a buffer view, which is too many; in all, {} such numbers are read", count,
            Document::most_unstored);
    a.count = size_t(count);
    a.stride = element;
    if (stored) {
        const Value view = document.element("bufferViews", value.at("bufferView"));
        const uint64_t stride = view.integer_or("byteStride", element);
        if (stride < element || stride > 65535) view.bad("has a byteStride of {} for elements of {} bytes", stride, element);
        a.stride = size_t(stride);
        a.bytes = elements(document, value, a.count, element, a.stride);
    }
    return a;
}

void read_floats(Document& document, const Accessor& accessor, float* out) { read(document, accessor, out); }

std::vector<uint32_t> read_integers(Document& document, const Accessor& accessor)
{
    if (accessor.component != Component::u8 && accessor.component != Component::u16 && accessor.component != Component::u32)
        accessor.value.bad("must hold whole numbers without a sign");
    std::vector<uint32_t> out(accessor.count * size_t(accessor.width));
    read(document, accessor, out.data());
    return out;
}

} // namespace gnomon::scene::gltf
