// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::base {

/// A 128-bit content hash for cache keys (two lanes of a multiply-mix over 8-byte words). Not for security.
class Hasher {
public:
    Hasher& bytes(std::span<const std::byte>);
    Hasher& text(std::string_view);
    template <class T>
    requires std::is_trivially_copyable_v<T> Hasher& value(const T& v) { return bytes(std::as_bytes(std::span(&v, 1))); }
    template <class T>
    requires std::is_trivially_copyable_v<T> Hasher& array(const std::vector<T>& v)
    {
        value(v.size());
        return bytes(std::as_bytes(std::span(v)));
    }
    /// 32 hexadecimal digits.
    std::string hex() const;

private:
    uint64_t a_ = 0x9e3779b97f4a7c15ull, b_ = 0xd1b54a32d192ed03ull;
};

} // namespace gnomon::base
