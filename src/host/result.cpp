// SPDX-License-Identifier: Apache-2.0
#include "host/result.h"

#include "gpu/functions.h"

#include <array>
#include <cstring>
#include <new>
#include <string_view>

namespace gnomon::host {

namespace {

// Not a std::string: keeping the sentence of a failed allocation must not allocate.
thread_local std::array<char, 1024> message{};

gnomon_result keep(gnomon_result result, std::string_view text) noexcept
{
    const size_t bytes = std::min(text.size(), message.size() - 1);
    std::memcpy(message.data(), text.data(), bytes);
    message[bytes] = '\0';
    return result;
}

} // namespace

gnomon_result guarded(const std::function<void()>& work) noexcept
{
    message[0] = '\0';
    try {
        work();
        return GNOMON_SUCCESS;
    } catch (const Refusal& e) {
        return keep(e.result, e.what());
    } catch (const std::bad_alloc&) {
        return keep(GNOMON_ERROR_OUT_OF_MEMORY, "out of host memory; use a smaller map or picture, or free some first");
    } catch (const gpu::OutOfMemory& e) {
        return keep(GNOMON_ERROR_OUT_OF_MEMORY, e.what());
    } catch (const gpu::DeviceLost& e) {
        return keep(GNOMON_ERROR_DEVICE_LOST, e.what());
    } catch (const std::exception& e) {
        return keep(GNOMON_ERROR_OTHER, e.what());
    } catch (...) {
        return keep(GNOMON_ERROR_OTHER, "an unknown error");
    }
}

const char* last_message() noexcept { return message.data(); }

} // namespace gnomon::host
