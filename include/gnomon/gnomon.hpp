// SPDX-License-Identifier: Apache-2.0
// Gnomon's C++ interface: owners over gnomon.h, which says what everything means. Header only, so that no C++ type or exception crosses
// the library's boundary: errors leave it as results, and become exceptions here, in the host's own code.
#pragma once

#include <gnomon/gnomon.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon {

/// What failed, as a sentence; `result` tells the kind.
struct Error : std::runtime_error {
    explicit Error(gnomon_result r)
        : std::runtime_error(gnomon_error_message())
        , result(r)
    {
    }
    gnomon_result result;
};
inline void check(gnomon_result result)
{
    if (result != GNOMON_SUCCESS) throw Error(result);
}

/// A move-only owner of one of Gnomon's objects; they may be destroyed in any order.
template <class Handle, void (*destroy)(Handle)> class Owner {
public:
    Owner() = default;
    explicit Owner(Handle handle)
        : handle_(handle)
    {
    }
    Handle get() const { return handle_.get(); }
    explicit operator bool() const { return handle_ != nullptr; }

private:
    struct Destroy {
        using pointer = Handle;
        void operator()(Handle handle) const { destroy(handle); }
    };
    std::unique_ptr<Handle, Destroy> handle_;
};

inline std::vector<gnomon_technique> techniques()
{
    std::vector<gnomon_technique> all(gnomon_technique_count());
    for (uint32_t i = 0; i < all.size(); ++i) check(gnomon_technique_get(i, &all[i]));
    return all;
}

struct Device : Owner<gnomon_device, gnomon_device_destroy> {
    Device() = default;
    explicit Device(gnomon_device_info info)
        : Owner([&info] {
            info.version = GNOMON_VERSION;
            gnomon_device out{};
            check(gnomon_device_create(&info, &out));
            return out;
        }())
    {
    }
    void retire(uint64_t ticket) const { gnomon_retire(get(), ticket); }
    uint64_t bytes() const { return gnomon_device_bytes(get()); }
    gnomon_choice choose(uint32_t level, const gnomon_light& light) const
    {
        gnomon_choice out{};
        check(gnomon_choose(get(), level, &light, &out));
        return out;
    }
};

struct Scene : Owner<gnomon_scene, gnomon_scene_destroy> {
    Scene() = default;
    Scene(const Device& device, const gnomon_scene_info& info)
        : Owner([&] {
            gnomon_scene out{};
            check(gnomon_scene_create(device.get(), &info, &out));
            return out;
        }())
    {
    }
    void move(uint32_t instance, const VkTransformMatrixKHR& m) const { check(gnomon_scene_move(get(), instance, 1, &m)); }
    void move(uint32_t first, const std::vector<VkTransformMatrixKHR>& m) const
    {
        check(gnomon_scene_move(get(), first, uint32_t(m.size()), m.data()));
    }
    void deform(uint32_t mesh, const float (&lower)[3], const float (&upper)[3]) const
    {
        check(gnomon_scene_deform(get(), mesh, lower, upper));
    }
};

struct Shadow : Owner<gnomon_shadow, gnomon_shadow_destroy> {
    Shadow() = default;
    Shadow(const Scene& scene, const std::string& technique, const std::string& settings = {})
        : Owner([&] {
            gnomon_shadow out{};
            check(gnomon_shadow_create(scene.get(), technique.c_str(), settings.c_str(), &out));
            return out;
        }())
    {
    }
    void set(const std::string& settings) const { check(gnomon_shadow_set(get(), settings.c_str())); }
    uint64_t record(const gnomon_frame& frame) const ///< the ticket for Device::retire
    {
        uint64_t ticket = 0;
        check(gnomon_record(get(), &frame, &ticket));
        return ticket;
    }
};

} // namespace gnomon
