// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADERS_LIGHT_MAP_SHARED_H
#define GNOMON_SHADERS_LIGHT_MAP_SHARED_H
#include "shaders/shared.h"

#define LIGHT_MAP_SINGLE 0
#define LIGHT_MAP_CUBE 1
#define LIGHT_MAP_CASCADES 2
#define LIGHT_MAP_TETRAHEDRON 3
#define LIGHT_MAP_DUAL_PARABOLOID 4
#define LIGHT_MAP_MAX_LAYERS 8

SHARED_BEGIN(shaders)

/// Parameters of where a map's layers lie (parts::describe_map).
struct FitParams {
    int fit DEFAULT(1); ///< parts::Fit; by name: uniform, focused, cascades, psm, lispsm, tsm, cascades_warped, sdsm
    int cascades DEFAULT(4);
    float split DEFAULT(0.9f); ///< 0: cascades of one length, 1: of one ratio
    int stable DEFAULT(1);
    float blend DEFAULT(0.1f); ///< of a cascade's length, over which it becomes the next
    float nearest DEFAULT(0.0f); ///< metres: cascades of one ratio begin no nearer
    int warp DEFAULT(0); ///< parts::Falloff
    float warp_near DEFAULT(0.0f); ///< lispsm: of the depths seen, the nearest part that may do with coarser texels
    float psm_slide DEFAULT(0.02f); ///< of the depths seen: how far behind the eye psm looks from
    int point_layout DEFAULT(0); ///< parts::PointLayout
};

/// One depth layer. map_from_world takes a world point to (u w, v w, z w, w): uv in [0,1] with v down, z the reversed depth. A light's ray
/// is one point of the map in every layer, warped ones too.
struct LightMapLayer {
    mat4 map_from_world;
    vec4 depth_plane; ///< linear depth in metres along the layer's axis = dot(depth_plane, (p, 1))
    float texel_metres; ///< width of a texel: in metres (orthographic) or at 1 m linear depth (perspective); warped: where it is least
    float near; ///< metres along the axis where stored z = 1
    float far; ///< where stored z = 0
    uint perspective; ///< 0 or 1: stored z is affine in linear depth, or in its inverse
    uint warped; ///< 1: map_from_world's third row is not the stored depth, which fragments write, texels differ in width, and w is 1
                 ///< where it is least of all that is seen; 2: a paraboloid, to be read through layer_at (shaders/light_map.glsl)
    float texel_uv; ///< width of a texel in uv
    vec2 axis_uv; ///< where a perspective layer's axis falls in uv: 0.5 without rounding in its middle, so that texels on a panel lie in
                  ///< rows; 0 where it is orthographic, of no meaning where it is warped
};

struct LightMap {
    uint layout_kind; ///< LIGHT_MAP_*
    uint layer_count;
    float size; ///< texels a side
    float depth_step; ///< step of fixed-point depth (D16: 1/65535); 0 for D32F, whose rounding is relative
    vec3 centre; ///< where the layers look from (cube, tetrahedron), or the view's eye (cascades)
    int fit_used; ///< parts::Fit: what was asked for, or what that gave way to where it does not suit light and view
    mat3 axes; ///< of the cube or tetrahedron, in world space: identity for points, a rectangle's or disk's own, the light shining along
               ///< +z; of the view along whose third axis cascades are split
    vec4 splits[2]; ///< cascades: distance along that axis where each layer ends; the last has no end
    vec4 bands[2]; ///< and where the band before it begins, in which it is blended into the next
    LightMapLayer layers[LIGHT_MAP_MAX_LAYERS];
};

SHARED_END

#endif
