// SPDX-License-Identifier: Apache-2.0
#include "truth/geometry.h"

#include "base/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

namespace gnomon::truth {

namespace {

static_assert(offsetof(Transmission, context) == 0);
static_assert(sizeof(vec3) == 12);

void keep_where_alpha(const RTCFilterFunctionNArguments* a)
{
    const auto& surface = *static_cast<const Surface*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const float value = alpha(surface, RTCHitN_primID(a->hit, a->N, i), RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i));
        if (value < surface.material->alpha_cutoff) a->valid[i] = 0;
    }
}

void multiply(const RTCFilterFunctionNArguments* a)
{
    const auto& surface = *static_cast<const Surface*>(a->geometryUserPtr);
    auto* transmission = reinterpret_cast<Transmission*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const vec4 base = base_color(surface, RTCHitN_primID(a->hit, a->N, i), RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i));
        vec3& product = transmission->product[RTCRayN_id(a->ray, a->N, i)];
        product *= scene::transmittance(*surface.material, base);
        if (product != vec3(0.0f)) a->valid[i] = 0; // go on; at 0 the hit is kept and ends the ray
    }
}

/// Beyond this Embree takes coordinates for infinite (1.8e18), and squares of differences would overflow.
constexpr float farthest = 1e9f;

float largest_extent(const scene::Mesh& mesh, const std::vector<vec3>& world)
{
    vec3 largest(0.0f);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const vec3 a = world[mesh.indices[i]], b = world[mesh.indices[i + 1]], c = world[mesh.indices[i + 2]];
        largest = glm::max(largest, glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c)));
    }
    return std::max(largest.x, std::max(largest.y, largest.z));
}

bool usable(vec3 p) { return std::abs(p.x) < farthest && std::abs(p.y) < farthest && std::abs(p.z) < farthest; }

} // namespace

Geometry::Level::~Level()
{
    if (scene) rtcReleaseScene(scene);
    for (RTCScene child : children)
        if (child) rtcReleaseScene(child);
}

Geometry::Geometry(const scene::Scene& s, size_t flatten_limit)
    : scene_(s)
    , device_(rtcNewDevice(nullptr), [](RTCDevice d) {
        if (d) rtcReleaseDevice(d);
    })
{
    const auto begin = std::chrono::steady_clock::now();
    if (!device_) {
        const RTCError error = rtcGetDeviceError(nullptr);
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        base::fail("Embree cannot start (error {}); ray-traced truth needs a CPU with SSE2", int(error));
    }
    std::vector<int> uses(s.meshes.size());
    size_t total = 0;
    for (const scene::Instance& i : s.instances) {
        ++uses[size_t(i.mesh)];
        total += s.meshes[size_t(i.mesh)].triangle_count();
    }
    if (total >= 0xffffffffu) base::fail("the scene '{}' has {} triangles; at most {} can be traced", s.name, total, 0xfffffffeu);

    first_primitives_ = s.first_primitives();
    Bounds bounds;
    world_.resize(s.instances.size());
    for (size_t i = 0; i < s.instances.size(); ++i) {
        const scene::Instance& instance = s.instances[i];
        const scene::Mesh& mesh = s.meshes[size_t(instance.mesh)];
        surfaces_.push_back({&s, &mesh, &s.materials[size_t(mesh.material)]});
        // A flat placement (scale 0) has no inverse, which an Embree instance would need.
        const bool flatten
            = total <= flatten_limit || uses[size_t(instance.mesh)] == 1 || glm::determinant(instance.world_from_object) == 0.0f;
        std::vector<vec3> world(mesh.positions.size() + 1, vec3(0.0f)); // Embree reads 16 bytes at the last 12-byte vertex
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            world[v] = vec3(instance.world_from_object * vec4(mesh.positions[v], 1.0f));
            if (!usable(world[v]))
                base::fail("vertex {} of the mesh '{}' in the scene '{}' lies at {}, {}, {}; coordinates must be finite and below {} m", v,
                    mesh.name, s.name, world[v].x, world[v].y, world[v].z, farthest);
            bounds.add(world[v]);
        }
        const float extent = largest_extent(mesh, world);
        if (flatten) world_[i] = std::move(world);
        placed_.push_back({mesh.indices.data(), flatten ? world_[i].data() : nullptr, extent});
    }
    radius_ = bounds.radius();
    build(solid_, Casters::solid);
    build_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

Geometry::~Geometry() = default;

RTCScene Geometry::all() const
{
    std::call_once(all_built_, [&] { build(all_, Casters::all); });
    return all_.scene;
}

bool Geometry::takes(Casters casters, const scene::Material& m) const
{
    return casters == Casters::all || m.alpha != scene::AlphaMode::blend;
}

void Geometry::check(const char* what) const
{
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error == RTC_ERROR_OUT_OF_MEMORY) base::fail("not enough memory to {} for the scene '{}'; use a smaller scene", what, scene_.name);
    if (error != RTC_ERROR_NONE) base::fail("Embree cannot {} for the scene '{}' (error {})", what, scene_.name, int(error));
}

RTCGeometry Geometry::make_triangles(Casters casters, uint32_t instance, bool world) const
{
    const Surface& surface = surfaces_[instance];
    const scene::Mesh& mesh = *surface.mesh;
    const scene::Material& material = *surface.material;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    if (world) {
        rtcSetSharedGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, world_[instance].data(), 0, sizeof(vec3), mesh.positions.size());
    } else {
        void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size());
        check("store vertices");
        std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<vec3*>(copy));
    }
    rtcSetSharedGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0, 3 * sizeof(uint32_t), mesh.triangle_count());
    rtcSetGeometryUserData(geometry, const_cast<Surface*>(&surface));
    const bool clear = material.alpha == scene::AlphaMode::blend || material.transmission > 0.0f;
    if (casters == Casters::all && clear) {
        rtcSetGeometryOccludedFilterFunction(geometry, multiply);
    } else if (material.alpha == scene::AlphaMode::mask) {
        rtcSetGeometryIntersectFilterFunction(geometry, keep_where_alpha);
        rtcSetGeometryOccludedFilterFunction(geometry, keep_where_alpha);
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

void Geometry::build(Level& level, Casters casters) const
{
    // Robust: no ray slips through the edge that two triangles share, or a closed box would leak. The context's filter culls back
    // faces on the camera's second try; with none set, allowing it costs nothing that can be measured.
    const auto new_scene = [&] {
        RTCScene scene = rtcNewScene(device_.get());
        check("make an acceleration structure");
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        return scene;
    };
    level.scene = new_scene();
    level.children.assign(scene_.meshes.size(), nullptr);
    for (uint32_t i = 0; i < surfaces_.size(); ++i) {
        const Surface& surface = surfaces_[i];
        if (surface.mesh->indices.empty() || !takes(casters, *surface.material)) continue;
        RTCGeometry geometry;
        if (!world_[i].empty()) {
            geometry = make_triangles(casters, i, true);
        } else {
            RTCScene& child = level.children[size_t(scene_.instances[i].mesh)];
            if (!child) {
                child = new_scene();
                RTCGeometry triangles = make_triangles(casters, i, false);
                rtcAttachGeometry(child, triangles);
                rtcReleaseGeometry(triangles);
                rtcCommitScene(child);
            }
            geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, child);
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &scene_.instances[i].world_from_object[0][0]);
            rtcCommitGeometry(geometry);
        }
        rtcAttachGeometryByID(level.scene, geometry, i);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(level.scene);
    check("build the acceleration structure");
}

Geometry::Triangle Geometry::transformed_triangle(uint32_t instance, const uint32_t* corners) const
{
    const std::vector<vec3>& positions = surfaces_[instance].mesh->positions;
    const mat4& m = scene_.instances[instance].world_from_object;
    const auto world = [&](int k) { return glm::dvec3(vec3(m * vec4(positions[corners[k]], 1.0f))); };
    const glm::dvec3 corner = world(0);
    return {corner, world(1) - corner, world(2) - corner};
}

} // namespace gnomon::truth
