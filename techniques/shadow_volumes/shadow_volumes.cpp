// SPDX-License-Identifier: Apache-2.0
// Shadow volumes (Crow 1977) counted in the picture (Heidmann 1991) by the edges of any mesh (Aldridge and Woods 2004; Kim et al. 2008).
#include "techniques/shadow_volumes/shadow_volumes.shared.h"

#include "shadow/parts/volume_culling.h"
#include "shadow/parts/volumes.h"

#include <optional>

namespace gnomon::techniques::shadow_volumes {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    fields.choice("edges", p.edges, {"closed", "bergeron", "any"},
        "Edges from which quads are drawn: silhouettes, right for closed meshes; those and open borders, right where no edge has more than "
        "two triangles; or as many quads at each edge as do not cancel, always right.");
    fields.choice("count", p.count, {"zpass", "zfail", "zp_plus", "pp_zp"},
        "Where counting begins: at the eye, taken as lit; at infinity; at the near plane, counted from the light; or at the eye, counted "
        "by "
        "a test of each triangle.");
    fields.choice("counter", p.counter, {"auto", "stencil", "blend"},
        "What counts: a stencil of 8 bits, only where fewer than 256 triangles cast; additions to a float image; auto is the latter, "
        "which takes no longer.");
    fields.choice("order", p.order, {"planes", "depth"},
        "How a face and a receiver are put in order: by the face's plane, exactly; or by the depth test, which is faster and puts single "
        "pixels wrong.");
    fields.flag("log_alpha", p.log_alpha,
        "Transmittance in place of visibility: semitransparent casters let light through by the colour and alpha of their material.");
    fields.flag("scissor", p.scissor, "A spot's volumes are drawn only where its cone is seen; the picture is the same.");
    fields.choice("culling", p.culling, {"none", "casters", "max", "clamp", "all"},
        "Counting from infinity in a perspective view, which volumes are not drawn: none; those that add to shadows only, or to none that "
        "is seen; those behind "
        "all receivers; those outside of the bands of the picture in which they may darken something; all of these. The picture is the "
        "same.");
    fields.integer("bands", p.bands, {1, VOLUME_MAX_BANDS}, "bands",
        "How many, with culling = clamp or all; one where `order` is depth, since a face that is cut has other depths.");
}

enum class Culling : int { none, casters, max, clamp, all };

/// Where counting does not begin outside of all volumes, those that it begins in count at every pixel: none can be left out. So it is at
/// the eye, and at infinity along parallel rays.
std::optional<parts::CulledVolumes> cull(gpu::PassList& passes, const Frame& frame, const Params& params)
{
    const auto by = Culling(params.culling);
    if (by == Culling::none || parts::VolumeCount(params.count) != parts::VolumeCount::zfail || frame.view.orthographic) return {};
    const bool in_planes = parts::VolumeOrder(params.order) == parts::VolumeOrder::planes; // clipped, faces have other depths
    return parts::cull_volumes(passes, frame,
        {.casters = by == Culling::casters || by == Culling::all,
            .max = by == Culling::max || by == Culling::all,
            .clamp = (by == Culling::clamp || by == Culling::all) && in_planes,
            .bands = params.bands});
}

class ShadowVolumes final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const std::optional<parts::CulledVolumes> culled = cull(passes, frame, params);
        const parts::VolumeSettings settings{.edges = parts::VolumeEdges(params.edges),
            .count = parts::VolumeCount(params.count),
            .counter = parts::VolumeCounter(params.counter),
            .order = parts::VolumeOrder(params.order),
            .transmittance = params.log_alpha != 0,
            .scissor = params.scissor != 0,
            .slot_bands = culled ? culled->slots : gpu::BufferId{},
            .bands = culled ? &culled->bands : nullptr};
        parts::resolve_volumes(passes, frame, settings, parts::count_volumes(passes, frame, casters_, settings));
    }
    uint64_t kept_bytes() const override { return casters_.bytes(); }

    parts::VolumeCasters casters_;
};

Output output_of(std::span<const std::byte> bytes)
{
    Params params;
    memcpy(&params, bytes.data(), sizeof(params));
    return params.log_alpha ? Output::transmittance : Output::visibility;
}

} // namespace

} // namespace gnomon::techniques::shadow_volumes

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;
const gnomon::shadow::TechniqueInfo technique_shadow_volumes = {
    .id = "shadow_volumes",
    .title = "Shadow volumes",
    .family = "hard shadows",
    .cite = "Crow 1977; Heidmann 1991; Aldridge, Woods 2004",
    .output = gnomon::shadow::Output::visibility,
    .output_of = gnomon::techniques::shadow_volumes::output_of,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .exact = true,
    .counts = true,
    .reads_vertices = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::shadow_volumes::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::shadow_volumes::ShadowVolumes>();
    },
};
