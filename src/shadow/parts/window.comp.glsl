// SPDX-License-Identifier: Apache-2.0
#version 460

// Sliding window along one axis in constant time a texel (van Herk 1992; Gil and Werman 1993): an invocation makes the `width` outputs of
// one block, each as the suffix of one stretch of the input joined with a prefix of the next. Nothing is ever subtracted, unlike a
// running sum or a summed-area table: sums of exponentials keep their relative precision, and minima and maxima work the same way.
// Windows that reach over the image's rim repeat its last texel.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2DArray from;
layout(set = 0, binding = 1) writeonly uniform image2DArray to;

layout(constant_id = 0) const int width = 3;
layout(constant_id = 1) const int axis = 0; // 0: along x, 1: along y
layout(constant_id = 2) const int operation = 0; // 0: mean, 1: (minimum, maximum) of pairs, 2: log of the mean of exp, one channel

vec4 join(vec4 a, vec4 b)
{
    if (operation == 0) return a + b;
    if (operation == 1) return vec4(min(a.x, b.x), max(a.yzw, b.yzw));
    return vec4(max(a.x, b.x) + log(1.0 + exp(-abs(a.x - b.x))));
}

void main()
{
    const ivec2 size = textureSize(from, 0).xy;
    const int across = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * width, layer = int(gl_GlobalInvocationID.z);
    const int length_along = axis == 0 ? size.x : size.y;
    if (across >= (axis == 0 ? size.y : size.x) || first >= length_along) return;
    const int start = first - width / 2; // the window of output i begins at i - width / 2

    vec4 suffix[width];
    vec4 sum = vec4(0.0);
    for (int k = width - 1; k >= 0; --k) {
        const int along = clamp(start + k, 0, length_along - 1);
        const vec4 value = texelFetch(from, ivec3(axis == 0 ? ivec2(along, across) : ivec2(across, along), layer), 0);
        sum = k == width - 1 ? value : join(sum, value);
        suffix[k] = sum;
    }
    const float scale = operation == 0 ? 1.0 / float(width) : 1.0;
    const float offset = operation == 2 ? -log(float(width)) : 0.0;
    for (int k = 0; k < width && first + k < length_along; ++k) {
        vec4 result = suffix[k];
        if (k > 0) {
            const int along = clamp(start + width + k - 1, 0, length_along - 1);
            const vec4 value = texelFetch(from, ivec3(axis == 0 ? ivec2(along, across) : ivec2(across, along), layer), 0);
            sum = k == 1 ? value : join(sum, value);
            result = join(result, sum);
        }
        imageStore(to, ivec3(axis == 0 ? ivec2(first + k, across) : ivec2(across, first + k), layer), result * scale + offset);
    }
}
