// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "techniques/virtual_shadow_map/casters.h"
#include "techniques/virtual_shadow_map/virtual_grid.h"

#include <vector>

namespace gnomon::techniques::virtual_shadow_map {

class VirtualShadowMap final : public shadow::TechniqueWith<Params> {
public:
    explicit VirtualShadowMap(gpu::Device& device)
        : device_(device)
    {
    }

    // What tests ask of the last frame that was submitted.
    const Grid& grid() const { return grid_; }
    Counts counts() { return read<Counts>(counts_).front(); }
    std::vector<Slot> slots() { return read<Slot>(slots_); }
    uint32_t frame() const { return frame_; }
    gpu::Image& pool() { return pool_; }
    uint64_t kept_bytes() const override
    {
        if (!pool_) return 0;
        return pool_.bytes() + slots_.desc().bytes + counts_.desc().bytes + casters_.bytes();
    }

private:
    void record_with(gpu::PassList&, const shadow::Frame&, const Params&) override;

    /// Buffers of one frame.
    struct Work {
        gpu::BufferId marks, table, counts, slots, pages;
        PageConstants constants;
        bool kept; ///< pages of earlier frames may serve
    };
    bool prepare(gpu::PassList&, const shadow::Frame&, const Params&);
    gpu::ImageId request(gpu::PassList&, const shadow::Frame&, const Params&, const Work&);
    void allocate(gpu::PassList&, const Work&);
    void draw(gpu::PassList&, const shadow::Frame&, const Work&);
    void draw_batch(gpu::PassList&, const shadow::Frame&, const Work&, uint32_t first_page, uint32_t page_count);
    void resolve(gpu::PassList&, const shadow::Frame&, const Params&, const Work&, gpu::ImageId wanted);
    gpu::ComputePass compute(const char* name, const Work&, std::vector<gpu::Binding>, uint64_t threads) const;

    template <class T> std::vector<T> read(gpu::Buffer& buffer)
    {
        const std::vector<std::byte> bytes = device_.read_back(buffer);
        std::vector<T> out(bytes.size() / sizeof(T));
        memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
        return out;
    }

    gpu::Device& device_;
    Casters casters_;
    Grid grid_{};
    gpu::Image pool_; ///< a page in each layer
    gpu::Buffer slots_, counts_;
    uint32_t frame_ = 0;
};

} // namespace gnomon::techniques::virtual_shadow_map
