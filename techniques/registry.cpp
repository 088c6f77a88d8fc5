// SPDX-License-Identifier: Apache-2.0
#include "shadow/technique.h"

#define GNOMON_TECHNIQUE(id) extern const gnomon::shadow::TechniqueInfo technique_##id;
#include "techniques.inc"
#undef GNOMON_TECHNIQUE

namespace gnomon::shadow {

std::span<const TechniqueInfo* const> techniques()
{
    static constexpr const TechniqueInfo* list[] = {
#define GNOMON_TECHNIQUE(id) &technique_##id,
#include "techniques.inc"
#undef GNOMON_TECHNIQUE
    };
    return list;
}

} // namespace gnomon::shadow
