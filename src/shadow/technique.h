// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"
#include "scene/scene.h"
#include "shadow/gbuffer.h"
#include "shadow/params.h"
#include "shadow/scene_gpu.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// The contract of every algorithm: given a drawn G-buffer, the scene, one light and the view, write ONE image.
namespace gnomon::shadow {

namespace parts {
struct LightMap;
}

/// The kind of image that a technique writes; it fixes format, range and truth (docs/conventions.md).
enum class Output : uint8_t {
    visibility, ///< r32f: fraction of the light's area that reaches the point; 1 = all
    transmittance, ///< rgba32f: the same per colour channel, through semitransparent casters; alpha unused
    ambient, ///< rgba32f: r = cosine-weighted unoccluded fraction of the hemisphere, gba = bent normal, world space
    inscatter, ///< rgba32f: rgb radiance added by the medium along the eye ray, a = the medium's transmittance
    radiance, ///< rgba32f: indirect light
};
std::string_view output_name(Output);

/// Light kinds as bits.
constexpr unsigned light_bit(scene::LightKind kind) { return 1u << unsigned(kind); }
inline constexpr unsigned directional_lights = light_bit(scene::LightKind::directional);
inline constexpr unsigned spot_lights = light_bit(scene::LightKind::spot);
inline constexpr unsigned point_lights = light_bit(scene::LightKind::point);
inline constexpr unsigned area_lights = light_bit(scene::LightKind::rect) | light_bit(scene::LightKind::disk);
inline constexpr unsigned all_lights = (1u << scene::light_kind_count) - 1;

/// A whole number that a technique counted on the device while it made a frame.
struct Counter {
    std::string name; ///< in words joined by underscores: tile_tests, casters_culled; entries of one name are added up
    gpu::BufferId buffer;
    uint32_t offset = 0; ///< of a uint, in bytes
};

/// What a technique found on its way to its image, a number for each pixel, for people to look at.
struct Inspection {
    std::string name; ///< in words joined by underscores: penumbra, page
    std::string unit; ///< "m" where it is a length, which can be shown in pixels too; "" of plain numbers
    bool label = false; ///< whole numbers that tell things apart and need a colour each; false: a quantity
    gpu::ImageId image; ///< r32f, size of the view; negative where there is nothing to say
};

/// Everything a technique may read, and the one image that it writes. Valid during `record`.
struct Frame {
    const scene::Scene& scene;
    const scene::View& view;
    const scene::Light& light;
    SceneGpu& resources;
    GBuffer gbuffer; ///< already drawn
    gpu::ImageId output; ///< output_format, size of the view; every pixel is to be written (background: 1, or 0 for inscatter and
                         ///< radiance)
    uint32_t index = 0; ///< frame number: the only clock and the only seed
    parts::LightMap* light_map = nullptr; ///< where given, a technique that looks its shadows up in one light map leaves it here
    std::vector<Counter>* counters = nullptr; ///< where given, a technique that `counts` counts its work and leaves the numbers here;
                                              ///< such frames are not timed
    std::vector<Inspection>* inspections = nullptr; ///< where given, a technique that has such images draws them too and leaves them here;
                                                    ///< its output stays the same; such frames are not timed
};

/// An image for an Inspection of this frame.
gpu::ImageId inspection_image(gpu::PassList&, const Frame&);

/// One algorithm for one scene and one light, with what it keeps between frames (a member; a new scene or light is a new object).
class Technique {
public:
    virtual ~Technique() = default;
    /// Adds the passes that write frame.output. `params` is the technique's Params struct.
    virtual void record(gpu::PassList&, const Frame&, std::span<const std::byte> params) = 0;
    /// Device memory that it keeps between frames, in bytes; what a frame makes and drops again is counted by its pass list.
    virtual uint64_t kept_bytes() const { return 0; }
};

/// Hands `record` its own struct.
template <class Params> class TechniqueWith : public Technique {
public:
    void record(gpu::PassList& passes, const Frame& frame, std::span<const std::byte> bytes) final
    {
        Params params{};
        if constexpr (!std::is_empty_v<Params>) memcpy(&params, bytes.data(), sizeof(Params));
        record_with(passes, frame, params);
    }

protected:
    virtual void record_with(gpu::PassList&, const Frame&, const Params&) = 0;
};

/// Identity. Each techniques/<id>/<id>.cpp defines `extern const TechniqueInfo technique_<id>`.
struct TechniqueInfo {
    std::string_view id; ///< the folder's name
    std::string_view title, family, cite; ///< cite: author and year, as in the page's references
    Output output = Output::visibility;
    Output (*output_of)(std::span<const std::byte> params) = nullptr; ///< where its parameters choose; null: always `output`
    unsigned lights = all_lights; ///< kinds it claims; conformance tests hold it to that
    bool soft = false; ///< computes penumbrae of lights with an area; false: treats every light as its centre
    bool textured = false; ///< of a light with an image it writes the visibility in each channel, in the format of transmittance; false:
                           ///< takes the light as uniform
    bool partial = false; ///< shadows only some surfaces, or by some casters, as its page says; all else is lit as if nothing cast
    bool exact = false; ///< differs from truth only in a stated band at true edges
    bool counts = false; ///< leaves Frame::counters
    bool temporal = false; ///< keeps state between frames: the lab warms it up and tests it from a reset
    bool reads_vertices = false; ///< reads Mesh::positions and indices on the CPU; else a scene's triangles may be on the device alone
    bool (*reads_ids)(std::span<const std::byte> params) = nullptr; ///< tells receivers apart by GBuffer::primitive; null: never
    ParamTable (*params)() = no_params;
    std::string (*unavailable)(const gpu::Device&) = nullptr; ///< "" or the reason, a sentence
    std::unique_ptr<Technique> (*create)(gpu::Device&) = nullptr;
};

/// Of the image that a technique with these parameters writes.
Output output(const TechniqueInfo&, std::span<const std::byte> params);
VkFormat output_format(const TechniqueInfo&, std::span<const std::byte> params, const scene::Light&);

/// All techniques, sorted by id. Generated from the folders.
std::span<const TechniqueInfo* const> techniques();
/// Throws Error that lists the near ids.
const TechniqueInfo& technique(std::string_view id);
/// "" or why this technique cannot run on this device or for this kind of light.
std::string refusal(const TechniqueInfo&, const gpu::Device&, const scene::Light&);

} // namespace gnomon::shadow
