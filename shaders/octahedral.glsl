// SPDX-License-Identifier: Apache-2.0
// Unit vectors as two snorm16 values (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors").
#ifndef GNOMON_OCTAHEDRAL_GLSL
#define GNOMON_OCTAHEDRAL_GLSL

vec2 octahedral_wrap(vec2 v)
{
    return (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

uint encode_normal(vec3 n)
{
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    return packSnorm2x16(n.z >= 0.0 ? n.xy : octahedral_wrap(n.xy));
}

vec3 decode_normal(uint code)
{
    const vec2 e = unpackSnorm2x16(code);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = octahedral_wrap(n.xy);
    return normalize(n);
}

#endif
