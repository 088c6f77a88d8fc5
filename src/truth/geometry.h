// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "truth/surface.h"

#include <embree3/rtcore.h>

#include <memory>
#include <mutex>
#include <vector>

namespace gnomon::truth {

/// The scene in Embree's form. An instance is flattened to world space, unless the placed triangles exceed the limit: then meshes
/// that are placed more than once become Embree instances. Numbers the geometries of the top level as the scene's instances.
class Geometry {
public:
    Geometry(const scene::Scene&, size_t flatten_limit);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    /// Opaque and masked triangles. Only masked geometries have a filter (alpha test), so opaque ones run at Embree's full speed.
    RTCScene solid() const { return solid_.scene; }
    /// All triangles, for rays that carry a Transmission: built at the first call.
    RTCScene all() const;

    /// World space. In double from the start: a copy of the float corners costs the processor more (stalled store forwarding) than
    /// the conversion.
    struct Triangle {
        glm::dvec3 corner, edge_u, edge_v; ///< a point is corner + u edge_u + v edge_v
        /// Not normalised; points to the front.
        glm::dvec3 normal() const { return glm::cross(edge_u, edge_v); }
    };
    Triangle triangle(uint32_t instance, uint32_t index) const
    {
        const Placed& p = placed_[instance];
        const uint32_t* v = p.indices + size_t(index) * 3;
        if (!p.world) return transformed_triangle(instance, v);
        const glm::dvec3 corner(p.world[v[0]]);
        return {corner, glm::dvec3(p.world[v[1]]) - corner, glm::dvec3(p.world[v[2]]) - corner};
    }
    const scene::Material& material(uint32_t instance) const { return *surfaces_[instance].material; }
    /// The longest side of the bounds of any triangle of the instance, which bounds the rounding errors of a ray test against it and
    /// its neighbours.
    float extent(uint32_t instance) const { return placed_[instance].extent; }
    /// The instance of a hit: instanced hits name it in instID, flattened ones in geomID.
    static uint32_t instance(uint32_t geom_id, uint32_t inst_id) { return inst_id == RTC_INVALID_GEOMETRY_ID ? geom_id : inst_id; }

    const std::vector<uint32_t>& first_primitives() const { return first_primitives_; }
    /// Half the diagonal of the scene's bounds: what scales errors where no triangle is known.
    float radius() const { return radius_; }
    double build_ms() const { return build_ms_; }

private:
    enum class Casters { solid, all };
    /// A scene with the child scenes of its instanced meshes.
    struct Level {
        RTCScene scene = nullptr;
        std::vector<RTCScene> children;
        ~Level();
    };
    /// What is read at every hit, close together.
    struct Placed {
        const uint32_t* indices;
        const vec3* world; ///< null where instanced
        float extent;
    };
    Triangle transformed_triangle(uint32_t instance, const uint32_t* corners) const;
    bool takes(Casters, const scene::Material&) const;
    void build(Level&, Casters) const;
    RTCGeometry make_triangles(Casters, uint32_t instance, bool world) const;
    void check(const char* what) const;

    const scene::Scene& scene_;
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device_;
    std::vector<Surface> surfaces_; ///< one an instance
    std::vector<Placed> placed_; ///< likewise
    std::vector<std::vector<vec3>> world_; ///< positions of flattened instances with one element of padding; else empty
    std::vector<uint32_t> first_primitives_;
    float radius_ = 0.0f;
    double build_ms_ = 0.0;
    Level solid_;
    mutable Level all_;
    mutable std::once_flag all_built_;
};

/// The context of rays in `all()`: each crossing multiplies `product` of the ray whose id is the index.
struct Transmission {
    RTCIntersectContext context; ///< first, so that a filter can find the rest
    vec3 product[8];
};

} // namespace gnomon::truth
