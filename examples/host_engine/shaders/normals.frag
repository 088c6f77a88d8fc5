// SPDX-License-Identifier: Apache-2.0
#version 460
layout(constant_id = 0) const int encoding = 0; // gnomon_frame::normal_encoding
layout(location = 1) in vec3 n_host;
layout(location = 0) out vec4 encoded;

void main()
{
    vec3 n = normalize(n_host);
    if (encoding == 0) encoded = vec4(n, 0);
    else if (encoding == 1) encoded = vec4(0.5 * n + 0.5, 0);
    else {
        n /= abs(n.x) + abs(n.y) + abs(n.z);
        const vec2 folded = (1 - abs(n.yx)) * mix(vec2(-1), vec2(1), greaterThanEqual(n.xy, vec2(0)));
        encoded = vec4(n.z >= 0 ? n.xy : folded, 0, 0);
    }
}
