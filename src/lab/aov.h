// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"
#include "lab/stage.h"
#include "shadow/gbuffer.h"
#include "shadow/parts/light_map.h"

#include <map>
#include <set>
#include <string>

namespace gnomon::lab {

/// Copies of G-buffer images that outlive their pass list, read back as pictures for people and programs:
/// depth (1 channel, metres along the view axis, 0 = background), normal and geometric_normal (3, world), albedo (3, linear),
/// surface (2: metallic, roughness), primitive (1: id, -1 = background), position (3, world), motion (2, uv). Of the technique's map for
/// the first light: texel_footprint, texel_footprint_perspective, texel_footprint_projection (shadow/parts/texel_footprint.h).
class AovCopies {
public:
    AovCopies(gpu::Device&, base::Size, const std::set<std::string>& names);
    bool wants(const std::string& name) const { return names_.count(name) != 0; }
    void record(gpu::PassList&, const shadow::GBuffer&);
    bool wants_footprint() const { return images_.count("footprint") != 0; }
    void record_footprint(gpu::PassList&, const shadow::GBuffer&, const scene::View&, const shadow::parts::LightMap&);
    std::map<std::string, base::Picture> read(
        gpu::Device&, const scene::View&, vec3 origin); ///< positions are not counted from `origin`, views are

private:
    std::set<std::string> names_;
    std::map<std::string, gpu::Image> images_; ///< by the G-buffer's own image names
};

/// A picture of an AOV for the eye: normals to [0,1], depth by its range, ids by hashed colours.
base::Picture aov_display(const std::string& name, const base::Picture&);

} // namespace gnomon::lab
