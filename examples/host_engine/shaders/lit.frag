// SPDX-License-Identifier: Apache-2.0
#version 460
layout(push_constant) uniform Push {
    mat4 clip_from_host;
    vec4 light_position; // w: 1 for a lamp, 0 for a sun
    vec4 light_direction;
    vec4 up; // w: metres of a unit
    vec4 cone; // cosines of the lamp's outer and inner half angles
};
layout(set = 0, binding = 1) uniform sampler2D visibility; // what Gnomon wrote: the fraction of the light that reaches each pixel

layout(location = 0) in vec3 p_host;
layout(location = 1) in vec3 n_host;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in vec4 color;
layout(location = 0) out vec4 picture;

void main()
{
    const vec3 n = normalize(n_host);
    vec3 to_light = -light_direction.xyz;
    float arriving = 1.4;
    if (light_position.w != 0) {
        const vec3 way = light_position.xyz - p_host;
        const float metres = length(way) * up.w;
        to_light = normalize(way);
        arriving = 90 / (metres * metres) * smoothstep(cone.x, cone.y, dot(-to_light, light_direction.xyz));
    }
    vec3 albedo = color.rgb;
    if (color.a != 0) albedo *= mod(floor(uv.x) + floor(uv.y), 2) == 0 ? 1.0 : 0.8;
    const float ambient = 0.13 + 0.06 * dot(n, up.xyz);
    const float light = arriving * max(dot(n, to_light), 0) * texelFetch(visibility, ivec2(gl_FragCoord.xy), 0).r;
    const vec3 c = albedo * (ambient + light);
    picture = vec4(pow(c / (c + 0.6), vec3(1 / 2.2)), 1);
}
