// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "shadow/parts/light_map.h"
#include "shadow/parts/volumes.h"

#include <array>
#include <string>
#include <vector>

namespace gnomon::view {

/// What of Overlays is wanted.
struct OverlayWish {
    bool footprint = false, layers = false, insets = false; ///< of the light map
    bool volumes = false; ///< shadow volumes as lines
    int inspect = -1; ///< which of the images that the technique offers; -1: none
    bool in_pixels = true; ///< lengths, else in metres
    float scale = 0; ///< full colour at 2^scale times the usual
    bool operator==(const OverlayWish&) const = default;
    std::string key() const; ///< for what depends on it
};

/// What is drawn over the left side's picture from what its technique found on its way.
class Overlays {
public:
    /// What an image that can be inspected says.
    struct Offer {
        std::string name, unit;
        bool label;
    };

    void begin(gpu::Device&, const OverlayWish&); ///< before the technique is recorded
    std::vector<shadow::Inspection>* inspections() { return wish_.inspect >= 0 ? &inspections_ : nullptr; } ///< for its Frame
    void record(gpu::PassList&, const shadow::Frame&, const shadow::parts::LightMap&, bool transmittance); ///< after it

    const std::vector<Offer>& offers() const { return offers_; } ///< of the technique, where an image is wanted
    const Offer* offered() const; ///< the one that is shown; null: none
    float most() const { return most_; } ///< of a quantity: where its colours end
    uint32_t layers() const { return layer_count_; } ///< of the technique's light map; 0: it leaves none
    std::string missing(std::string_view technique) const; ///< what was wanted and is not there, a sentence; "" = nothing

    gpu::Image footprint_image, layers_image, volumes_image, inspect_image, insets_image;

private:
    void draw_map(gpu::PassList&, const shadow::Frame&, const shadow::parts::LightMap&);
    void draw_inspection(gpu::PassList&, const shadow::Frame&);

    OverlayWish wish_;
    std::vector<shadow::Inspection> inspections_;
    std::vector<Offer> offers_;
    shadow::parts::VolumeCasters casters_;
    uint32_t layer_count_ = 0;
    float most_ = 1;
};

/// Colours of a quantity from 0 to `most`, linear between them; encoded for the screen.
const std::array<vec3, 6>& quantity_colors();

} // namespace gnomon::view
