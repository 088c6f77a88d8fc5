// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/filter.shared.h"
#include "shadow/parts/light_map.h"

#include <functional>
#include <string>

// What all prefiltered shadow maps have in common (variance, convolution, exponential, moment maps): depth is turned into values that may
// be averaged, windows of them are averaged once a texel, and a receiver reads the mean of its window at a cost that does not depend on
// the window's width. A technique gives two shaders: depth to values (shaders/filter_values.glsl) and mean to visibility
// (shaders/filter_resolve.glsl).
namespace gnomon::shadow::parts {

/// Which ways of averaging a technique's values bear: all, those without subtraction (values over many orders of magnitude), or windows
/// of one width only.
enum class Averages { all, no_sums, fixed_windows };

/// Describes the shared parameters.
void describe_filter(Fields&, shaders::FilterParams&, Averages = Averages::all);

struct ValuesPass {
    std::string shader; ///< fragment: values of one texel, one output a group
    VkFormat format = VK_FORMAT_R32G32_SFLOAT; ///< of one, two or four channels
    int groups = 1; ///< images of values for each layer of the map, at most `outputs`
    int outputs = 1; ///< that the shader declares, at most 8
    bool with_mips = false; ///< all of them, the others to be filled (draw_values)
    std::vector<gpu::Binding> more{}; ///< of the shader, after its depth map
    std::function<gpu::Constants(const shaders::FilterValues&)> constants; ///< of the shader, for one layer: they begin with its argument
    gpu::ImageId (*average)(gpu::PassList&, gpu::ImageId values, int width, bool with_mips)
        = nullptr; ///< instead of the mean that FilterParams asks for
};

/// Channels of a format of values.
int channels_of(VkFormat);

/// The images of values, one array: layer of the map * groups + group. `prefilter` (PREFILTER_*) is what the shader is told.
gpu::ImageId draw_values(gpu::PassList&, const LightMap&, int prefilter, const ValuesPass&);

struct FilteredMap {
    LightMap map;
    gpu::ImageId values; ///< array: layer of the map * groups + group
    gpu::ImageId means; ///< the same, averaged
    gpu::ImageId sums; ///< their summed-area table, where that was asked for
    shaders::FilterResolve constants; ///< for shaders/filter_resolve.glsl; params.kernel is the width in use (filter_width)
};

/// Draws the light map and makes values and means.
FilteredMap draw_filtered_map(gpu::PassList&, const Frame&, const shaders::FilterParams&, const ValuesPass&);

/// The same in two steps, for techniques that look at the depths in between.
LightMap draw_map_to_filter(gpu::PassList&, const Frame&, const shaders::FilterParams&);
FilteredMap filter_map(gpu::PassList&, const Frame&, const LightMap&, const shaders::FilterParams&, const ValuesPass&);

/// The full-screen pass that writes frame.output. Bindings 0 to 3 are those of shaders/filter_resolve.glsl; `more` follow. The constants
/// begin with map.constants.
void resolve_filtered(
    gpu::PassList&, const Frame&, const FilteredMap&, std::string_view shader, gpu::Constants, std::vector<gpu::Binding> more = {});

} // namespace gnomon::shadow::parts
