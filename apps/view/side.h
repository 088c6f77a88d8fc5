// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "overlays.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::view {

/// A G-buffer that outlives its pass list, so that moving a light or a slider does not draw the scene again.
class Receivers {
public:
    std::vector<gpu::PassTime> draw(gpu::Device&, shadow::SceneGpu&, const scene::View&);
    shadow::GBuffer import(gpu::PassList&);
    gpu::Image depth, normal, primitive, albedo, surface, emissive;
};

/// One technique's picture, or the truth's.
class Side {
public:
    /// Draws where `key` is not that of the last time. True where it did; `error` says why it could not.
    bool draw(gpu::Device&, shadow::SceneGpu&, Receivers&, const lab::Stage&, const lab::Choice&, float ambient, const std::string& key,
        Overlays* overlays);
    /// The same with given visibility.
    bool draw(gpu::Device&, shadow::SceneGpu&, Receivers&, const lab::Stage&, const std::vector<base::Picture>& images, float ambient,
        const std::string& key);
    void draw_again() { key_.clear(); }
    void forget(); ///< its techniques too

    bool valid = false; ///< there is a picture, if only an older one
    std::string error; ///< a sentence; "" = none
    std::vector<gpu::PassTime> times;
    gpu::Image radiance;
    std::vector<gpu::Image> visibility; ///< one a light

private:
    void make_techniques(gpu::Device&, const lab::Stage&, const lab::Choice&);
    void record(gpu::Device&, shadow::SceneGpu&, Receivers&, const lab::Stage&, const lab::Choice&, float ambient, Overlays*);
    void shade(gpu::PassList&, shadow::SceneGpu&, const shadow::GBuffer&, const lab::Stage&, float ambient, bool shadowed);
    void fit(gpu::Device&, const lab::Stage&, const std::vector<VkFormat>&);

    std::string key_, techniques_key_;
    std::vector<std::unique_ptr<shadow::Technique>> techniques_;
    uint32_t frame_ = 0;
};

/// Makes the image anew where its size or format is another.
void fit_image(gpu::Device&, gpu::Image&, VkFormat, base::Size, const char* name);

/// Cameras, lights and size as words: keys of what depends on them.
std::string view_key(const lab::Stage&);
std::string lights_key(const lab::Stage&);

} // namespace gnomon::view
