// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light_image.h"
#include "scene/math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::scene {

/// Parallel light. `direction` is that in which the light travels (unit, world). `angular_radius` is half the apparent
/// diameter in radians (the sun: 0.00465); 0 = a hard, point-like source.
struct DirectionalLight {
    vec3 direction{0, -1, 0};
    float angular_radius = 0.0f;
};
/// A spot: a sphere of `radius` metres (0 = point) at `position`, inside a cone about `direction`. Half angles in radians.
struct SpotLight {
    vec3 position{0, 3, 0}, direction{0, -1, 0};
    float inner_angle = 0.0f, outer_angle = 0.785398f;
    float radius = 0.0f;
};
/// A point (radius 0) or sphere light.
struct PointLight {
    vec3 position{0, 3, 0};
    float radius = 0.0f;
};
/// A one-sided rectangle: corners centre +- half_u +- half_v; it emits to the side of cross(half_u, half_v).
struct RectLight {
    vec3 centre{0, 3, 0}, half_u{0.5f, 0, 0}, half_v{0, 0, 0.5f};
};
/// A one-sided disk that emits to the side of `normal` (unit).
struct DiskLight {
    vec3 centre{0, 3, 0}, normal{0, -1, 0};
    float radius = 0.5f;
};

using LightShape = std::variant<DirectionalLight, SpotLight, PointLight, RectLight, DiskLight>;

/// The kinds in the order of the variant. As bits (1 << kind) they form a technique's `lights` mask.
enum class LightKind : uint8_t { directional, spot, point, rect, disk };
inline constexpr int light_kind_count = 5;

/// `intensity` is irradiance at normal incidence for directional lights, radiant intensity on the axis for all others
/// (scene-referred units; only ratios matter before exposure). Not given: chosen so that the light alone gives irradiance pi
/// at the scene's centre.
struct Light {
    std::string name;
    vec3 color{1, 1, 1}; ///< linear
    std::optional<float> intensity;
    LightShape shape;
    LightImage image{}; ///< rectangles only: what they emit over their area, times color
    LightKind kind() const { return LightKind(shape.index()); }
    bool soft() const; ///< has an area or a cone of its own
    bool textured() const { return kind() == LightKind::rect && !image.empty(); }
};

std::string_view kind_name(LightKind); ///< "directional", "spot", "point", "rect", "disk"

/// The points of a light as seen from a receiver. `position.w` = 1: a point; 0: a direction towards the light. This is the only
/// definition of what "a fraction of the light's area" means: `u` in [0,1)^2 maps with equal area onto
///   directional: the spherical cap of angular_radius (equal solid angle), rect and disk: their area,
///   point and spot: the disk of `radius` about the centre, perpendicular to receiver - centre (the visible face of the sphere).
/// Mirrored by shaders/light.glsl and tested against it.
vec4 light_point(const Light&, vec3 p_world, vec2 u);

/// Shirley and Chiu's concentric map of [0,1)^2 onto the unit disk: equal area, and neighbours stay neighbours.
vec2 square_to_disk(vec2 u);
/// Right-handed orthonormal columns (tangent, bitangent, n) about a unit n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
mat3 basis_about(vec3 n);

/// Whether the light sends anything towards p at all: spot cone, the emitting side of rect and disk. Shadow aside.
bool reaches(const Light&, vec3 p_world);

/// A light from the command line: a kind, or a name in `known`, then key=value pairs, all separated by commas.
///   sun,elevation=40,azimuth=120,angle=0.53      degrees; `angle` is the apparent diameter; azimuth 0 = +Z, 90 = +X, and names
///                                                where the light stands, so elevation=90 shines straight down
///   spot,position=1/2/3,target=0/0/0,cone=60,radius=0.1      `cone` = full outer angle, degrees; `inner` likewise
///   point,position=0/3/0,radius=0.2    rect,position=..,target=..,width=1,height=0.5    disk,position=..,target=..,radius=0.5
///   rect,...,image=window      what it emits over its area: load_light_image
/// Common keys: color=r/g/b or #rrggbb (sRGB), intensity, name. Left-out positions are fitted to `bounds`.
/// Throws Error listing the near names or the allowed range.
Light parse_light(std::string_view text, const std::vector<Light>& known, const Bounds& bounds);

} // namespace gnomon::scene
