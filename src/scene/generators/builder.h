// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// What the built-in scenes are made of. Every shape is a solid with closed, outward faces unless it says "sheet".
namespace gnomon::scene::generators {

struct Vertex {
    vec3 p, n;
    vec2 uv{0};
};

/// A surface over [0,1]^2.
using Surface = std::function<Vertex(float u, float v)>;

/// Builds one mesh. All shapes pass through `transform`. Winding follows the vertex normals, so a mirroring transform is allowed.
class MeshBuilder {
public:
    /// `fineness` scales every count of segments: triangles grow with its square.
    MeshBuilder(int material, float fineness, float uv_per_metre)
        : fineness_(fineness)
        , uv_(uv_per_metre)
    {
        mesh_.material = material;
    }

    mat4 transform{1};
    vec3 tint{1}; ///< linear vertex colour
    vec2 uv_offset{0}; ///< so that equal stones do not repeat one piece of the texture

    int segments(int count) const { return std::max(1, int(std::lround(float(count) * fineness_))); }

    uint32_t add(const Vertex&);
    /// Skips triangles with two corners in one place (at poles).
    void triangle(uint32_t a, uint32_t b, uint32_t c);

    /// nu x nv cells (times fineness). `closed_u`: u = 1 is the place of u = 0, to the bit.
    void patch(int nu, int nv, const Surface&, bool closed_u = false);
    /// A flat parallelogram a, a + u, a + u + v, a + v that faces cross(u, v).
    void quad(vec3 a, vec3 u, vec3 v);
    void flat_triangle(vec3 a, vec3 b, vec3 c); ///< faces cross(b - a, c - a)

    /// A box; with a bevel its edges are rounded: as flats with face normals at their rims, so that one segment already looks round.
    void box(vec3 centre, vec3 half, float bevel = 0.0f);
    /// Six flat quads; corner i is at (i&1, i&2, i&4) of a deformed cube.
    void hexahedron(const vec3 (&corners)[8]);
    /// A profile of (radius, y), counter-clockwise seen with the axis on the left, turned about y. Corners sharper than 40 degrees stay
    /// sharp.
    void lathe(const std::vector<vec2>& profile, int around);
    void cylinder(vec3 foot, float radius, float height, int around, float bevel = 0.0f);
    void cone(vec3 foot, float radius, float height, int around);
    void sphere(vec3 centre, float radius, int around);
    void torus(vec3 centre, float radius, float tube, int around, int about);
    /// A round bar along a path, with caps. `radius_end` tapers it.
    void tube(const std::vector<vec3>& path, float radius, float radius_end, int around);
    /// A bar with a simple counter-clockwise profile and flat sides: x runs along `side`, y along cross(tangent, side).
    void sweep(const std::vector<vec3>& path, const std::vector<vec2>& profile, vec3 side);
    /// A simple counter-clockwise polygon in xy, from z = -depth/2 to depth/2.
    void extrude(const std::vector<vec2>& polygon, float depth);
    /// An upward height field over [min, max] in xz: a sheet.
    void height_field(vec2 min, vec2 max, int nx, int nz, const std::function<float(float, float)>& height);

    bool empty() const { return mesh_.indices.empty(); }
    Mesh finish(std::string name) &&;

private:
    void face_corner(const vec3 (&directions)[3], vec3 centre, vec3 inner, float bevel);

    Mesh mesh_;
    float fineness_, uv_;
    bool tinted_ = false;
};

/// Transforms, to be read in the order written: at(x, y, z) * turned(degrees about y).
mat4 at(vec3 p);
mat4 turned(float degrees, vec3 axis = vec3(0, 1, 0));
mat4 scaled(vec3 s);

/// Places `count` points on an arc in the plane of x and y about `centre`, from one angle to another (degrees, counter-clockwise).
std::vector<vec2> arc(vec2 centre, float radius, float from, float to, int count);

/// A scene in the making.
class Stage {
public:
    Stage(std::string name, double detail);

    int texture(Texture);
    int material(Material);
    /// A plain or textured material.
    int material(std::string name, vec3 base, float roughness, int texture = -1);
    Material& edit(int material) { return scene_.materials[size_t(material)]; }
    MeshBuilder builder(int material, float uv_per_metre = 1.0f) const { return {material, fineness_, uv_per_metre}; }
    int mesh(std::string name, MeshBuilder&&);
    void place(int mesh, const mat4& world_from_object = mat4(1)) { scene_.instances.push_back({mesh, world_from_object}); }
    void add(std::string name, MeshBuilder&& b) { place(mesh(std::move(name), std::move(b))); }

    void camera(std::string name, vec3 eye, vec3 target, float fov_degrees = 50.0f);
    /// Degrees, as `--light sun` has them.
    void sun(std::string name, float elevation, float azimuth, float diameter, vec3 color = vec3(1));
    void spot(std::string name, vec3 position, vec3 target, float cone, float radius, vec3 color = vec3(1));
    void point(std::string name, vec3 position, float radius, vec3 color = vec3(1));
    /// `half_u` and `half_v` as in RectLight.
    void rect(std::string name, vec3 centre, vec3 half_u, vec3 half_v, vec3 color = vec3(1));
    void disk(std::string name, vec3 centre, vec3 target, float radius, vec3 color = vec3(1));

    float fineness() const { return fineness_; }
    Scene finish() && { return std::move(scene_); }

private:
    Scene scene_;
    float fineness_;
};

} // namespace gnomon::scene::generators
