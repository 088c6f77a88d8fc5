// SPDX-License-Identifier: Apache-2.0
// Filtering over a stretched footprint by several trilinear fetches along it, for images whose sampler cannot: a map seen at a
// glancing angle is band-limited along one axis only.
#ifndef GNOMON_ANISOTROPIC_GLSL
#define GNOMON_ANISOTROPIC_GLSL

struct Footprint {
    vec2 major; // texels: the long axis of the ellipse that the pixel's inscribed circle maps to, both ways, thus as long as the pixel
    float minor; // texels: length of the short one
};

// From the change of the place, in texels, to the next pixel in x and in y. The derivatives themselves are the axes only where they are
// at right angles; the singular values and vectors of (dx dy) are the axes always (Heckbert 1989, "Fundamentals of texture mapping and image
// warping"). J J^T = (a b; b c) has them squared as its eigenvalues.
Footprint ellipse_footprint(vec2 dx, vec2 dy)
{
    const float a = dx.x * dx.x + dy.x * dy.x, b = dx.x * dx.y + dy.x * dy.y, c = dx.y * dx.y + dy.y * dy.y;
    const float half_trace = 0.5 * (a + c), half_difference = 0.5 * (a - c);
    const float root = sqrt(half_difference * half_difference + b * b);
    const float longest = sqrt(half_trace + root);
    // the determinant is the product of both: no difference of nearly equal squares
    const float shortest = longest > 0.0 ? abs(dx.x * dy.y - dx.y * dy.x) / longest : 0.0;
    // eigenvector: of its two forms, the one that does not vanish
    const vec2 v = half_difference >= 0.0 ? vec2(half_difference + root, b) : vec2(b, root - half_difference);
    const float size = length(v);
    return Footprint(size > 0.0 ? v * (longest / size) : vec2(longest, 0.0), shortest);
}

// Mean of `mips` (layer, sampled linearly with a chain of means) over the footprint around uv, whose derivatives are in uv too. Up to `most`
// (1 to 16) trilinear fetches side by side along the long axis, each as wide as the short one (McCormack et al. 1999, "Feline: fast
// elliptical lines for anisotropic texture mapping"); where those would be too few, wider ones: a blur is preferred to aliases.
//
// Differs from the paper: the probes have equal weights, for the footprint is a pixel's box and not a Gaussian, and there are as many as
// the ratio of the axes says, rounded up, so that they overlap by less than one.
vec4 anisotropic_mean(sampler2DArray mips, int layer, vec2 uv, vec2 uv_dx, vec2 uv_dy, int most)
{
    const vec2 size = vec2(textureSize(mips, 0).xy);
    const Footprint f = ellipse_footprint(uv_dx * size, uv_dy * size);
    const float longest = length(f.major);
    // A hundredth less, or rounding would give a round footprint two probes.
    const float wanted = ceil(longest / max(f.minor, 1e-6) - 0.01);
    // less than a texel wide is not sharper: probes nearer than a texel add nothing
    const int count = int(clamp(min(wanted, ceil(longest - 0.01)), 1.0, float(most)));
    const float level = log2(max(max(f.minor, longest / float(count)), 1.0));
    const vec2 step_uv = f.major / size / float(count);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        const vec2 at = uv + step_uv * (float(i) + 0.5 - 0.5 * float(count));
        sum += textureLod(mips, vec3(at, float(layer)), level);
    }
    return sum / float(count);
}

#endif
