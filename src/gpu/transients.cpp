// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include <algorithm>

namespace gnomon::gpu {

namespace {

bool same(const ImageDesc& a, const ImageDesc& b)
{
    return a.format == b.format && a.size == b.size && a.layers == b.layers && a.mips == b.mips && a.samples == b.samples
        && a.cube == b.cube;
}

bool same(const BufferDesc& a, const BufferDesc& b) { return a.bytes == b.bytes && a.usage == b.usage && a.memory == b.memory; }

/// The pool's first, else a new one; where memory is out, the pool is emptied before giving up.
template <class List, class Desc, class Make> auto take_or_make(List& list, const Desc& desc, const Make& make, TransientPool& pool)
{
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& f) { return same(f.resource.desc(), desc); });
    if (found != list.end()) {
        auto resource = std::move(found->resource);
        list.erase(found);
        return resource;
    }
    try {
        return make(desc);
    } catch (const base::Error&) {
        if (list.empty()) throw;
        pool.clear();
    }
    return make(desc);
}

} // namespace

Image TransientPool::take(const ImageDesc& desc)
{
    return take_or_make(
        images_, desc, [&](const ImageDesc& d) { return device_.image(d); }, *this);
}

Buffer TransientPool::take(const BufferDesc& desc)
{
    return take_or_make(
        buffers_, desc, [&](const BufferDesc& d) { return device_.buffer(d); }, *this);
}

void TransientPool::give(Image&& image) { images_.push_back({std::move(image), now_}); }
void TransientPool::give(Buffer&& buffer) { buffers_.push_back({std::move(buffer), now_}); }

void TransientPool::age()
{
    ++now_;
    const auto old = [&](const auto& f) { return f.since + 16 < now_; };
    std::erase_if(images_, old);
    std::erase_if(buffers_, old);
}

void TransientPool::clear()
{
    images_.clear();
    buffers_.clear();
}

} // namespace gnomon::gpu
