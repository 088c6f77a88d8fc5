// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math.h"

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace host {

enum class Normals { none, floats, bytes, octahedral };

/// What engines differ in. The scene is written right-handed, Y-up and in metres; everything that reaches Vulkan and Gnomon is in the
/// host's own space, which this describes.
struct Convention {
    bool reversed_depth = true; ///< 1 at the near plane, 0 at infinity; else 0 at the near plane and 1 at the far one
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    Normals normals = Normals::floats;
    uint32_t up = 1; ///< 1 y, 2 z
    bool left_handed = false;
    bool clockwise = false; ///< front faces
    bool y_up = false; ///< clip space, by a viewport of negative height
    float metres = 1; ///< per unit
    bool packed_vertices = false; ///< 16-bit positions; else floats

    Mat3 axes() const; ///< of the host's space, from the scene's: a permutation with signs
    Vec3 direction(Vec3 v) const { return axes() * v; }
    Vec3 point(Vec3 p) const { return axes() * p * (1 / metres); }
};

struct Options {
    bool headless = false, validation = false, lamp = false, help = false;
    uint32_t width = 960, height = 540;
    uint32_t frames = 0; ///< 0: until the window is closed
    uint32_t resize_every = 0; ///< frames; 0: never
    uint32_t shuffle = 0; ///< seed of the order in which everything is destroyed; 0: the last made first
    std::vector<std::string> techniques{"shadow_map", "shadow_volumes", "pcss"};
    std::string settings; ///< of the techniques: "name=value name=value"
    uint32_t hold = 30; ///< frames before the next technique
    std::string output; ///< .ppm of the last frame
    Convention convention;
};

/// Throws std::runtime_error that names a wrong word.
Options parse(int count, char** words);
extern const char* const usage;

} // namespace host
