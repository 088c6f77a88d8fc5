// SPDX-License-Identifier: Apache-2.0
// The surface of glTF 2.0, appendix B: Lambert diffuse and GGX specular, metallic-roughness.
#ifndef GNOMON_BRDF_GLSL
#define GNOMON_BRDF_GLSL

struct Surface {
    vec3 albedo;
    float metallic;
    float roughness;
};

// Brdf times cos(theta_l). n, l, v unit.
vec3 reflect_light(Surface s, vec3 n, vec3 l, vec3 v)
{
    const float nl = dot(n, l);
    if (nl <= 0.0) return vec3(0.0);
    const vec3 h = normalize(l + v);
    const float nv = max(dot(n, v), 1e-4), nh = max(dot(n, h), 0.0), vh = max(dot(v, h), 0.0);
    const float alpha = max(s.roughness * s.roughness, 2e-3), a2 = alpha * alpha;
    const float d = nh * nh * (a2 - 1.0) + 1.0;
    const float distribution = a2 / (3.14159265 * d * d); // GGX, Walter et al. 2007, eq. 33
    // Smith, height-correlated, divided by 4 nl nv (Heitz 2014, eq. 99)
    const float shadowing = 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-6);
    const vec3 f0 = mix(vec3(0.04), s.albedo, s.metallic);
    const vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0); // Schlick 1994
    const vec3 diffuse = (1.0 - fresnel) * (1.0 - s.metallic) * s.albedo / 3.14159265;
    return (diffuse + fresnel * distribution * shadowing) * nl;
}

#endif
