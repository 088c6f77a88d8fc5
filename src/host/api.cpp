// SPDX-License-Identifier: Apache-2.0
#include "host/result.h"
#include "shadow/technique.h"

using namespace gnomon;
using host::guarded;

const char* gnomon_error_message(void) { return host::last_message(); }
uint32_t gnomon_version(void) { return GNOMON_VERSION; }

uint32_t gnomon_technique_count(void) { return uint32_t(shadow::techniques().size()); }

gnomon_result gnomon_technique_get(uint32_t index, gnomon_technique* out)
{
    return guarded([&] {
        const auto all = shadow::techniques();
        if (!out || index >= all.size())
            host::refuse(GNOMON_ERROR_ARGUMENT, "gnomon_technique_get: there are {} techniques, and no number {}", all.size(), index);
        const shadow::TechniqueInfo& t = *all[index];
        const shadow::ParamTable table = t.params();
        // the views are of literals, which end in a zero
        *out = {t.id.data(), t.title.data(), t.family.data(), t.cite.data(), t.lights, t.soft, t.output == shadow::Output::transmittance,
            t.reads_vertices, t.reads_ids && t.reads_ids(table.defaults)};
    });
}
