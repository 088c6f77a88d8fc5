// SPDX-License-Identifier: Apache-2.0
#include "base/hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace gnomon::base {

namespace {

// Both lanes are bijections of their state for a fixed word, so no word can be swallowed; odd constants from xxHash64 and splitmix64.
void mix(uint64_t& a, uint64_t& b, uint64_t word)
{
    a = (a ^ word) * 0x9fb21c651e98df25ull;
    a ^= a >> 32;
    b = std::rotl(b + word * 0xc2b2ae3d27d4eb4full, 31) * 0x9e3779b185ebca87ull;
}

uint64_t finish(uint64_t v) // splitmix64's finaliser
{
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
    return v ^ (v >> 31);
}

} // namespace

Hasher& Hasher::bytes(std::span<const std::byte> data)
{
    uint64_t a = a_, b = b_;
    size_t at = 0;
    for (; at + 8 <= data.size(); at += 8) {
        uint64_t word;
        std::memcpy(&word, data.data() + at, 8);
        mix(a, b, word);
    }
    // The zero-padded tail is told apart by the length that follows it.
    uint64_t tail = 0;
    if (at < data.size()) std::memcpy(&tail, data.data() + at, data.size() - at);
    mix(a, b, tail);
    mix(a, b, data.size());
    a_ = a, b_ = b;
    return *this;
}

Hasher& Hasher::text(std::string_view text) { return bytes(std::as_bytes(std::span(text))); }

std::string Hasher::hex() const { return fmt::format("{:016x}{:016x}", finish(a_ + b_), finish(b_ ^ std::rotl(a_, 23))); }

} // namespace gnomon::base
