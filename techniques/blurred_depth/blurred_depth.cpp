// SPDX-License-Identifier: Apache-2.0
// A negative control: the depth is filtered before it is compared. What percentage-closer filtering is right about shows beside it.
#include "techniques/blurred_depth/blurred_depth.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::blurred_depth {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering);
    fields.choice("compare", p.compare, {"binary", "smooth"}, "Lit or not, or a smooth step over `softness`.");
    fields.real("softness", p.softness, {0.001, 100}, "m", "smooth: depth behind the average at which a receiver is wholly dark.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/blurred_depth/blurred_depth_values.frag",
                .format = VK_FORMAT_R32_SFLOAT,
                .constants = [](const FilterValues& layer) { return layer; }});
        parts::resolve_filtered(
            passes, frame, map, "techniques/blurred_depth/blurred_depth_resolve.frag", ResolveConstants{map.constants, params});
    }
};

} // namespace

} // namespace gnomon::techniques::blurred_depth

extern const gnomon::shadow::TechniqueInfo technique_blurred_depth;
const gnomon::shadow::TechniqueInfo technique_blurred_depth = {
    .id = "blurred_depth",
    .title = "Blurred depth (negative control)",
    .family = "shadow maps",
    .cite = "Luft, Deussen 2006",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::blurred_depth::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::blurred_depth::Method>();
    },
};
