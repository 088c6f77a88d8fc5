// SPDX-License-Identifier: Apache-2.0
#include "scene/math.h"

namespace gnomon {

Bounds transformed(const Bounds& b, const mat4& m)
{
    Bounds out;
    if (b.empty()) return out;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y, corner & 4 ? b.max.z : b.min.z);
        out.add(vec3(m * vec4(p, 1.0f)));
    }
    return out;
}

} // namespace gnomon
