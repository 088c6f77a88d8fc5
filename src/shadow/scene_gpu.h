// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"
#include "scene/scene.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// Which triangles a draw takes.
enum DrawSet : unsigned { draw_opaque = 1, draw_masked = 2, draw_blended = 4 };

/// Six planes (n, d), inside where dot(n, p) + d >= 0; fewer where a side is open (an infinite far plane).
using Planes = std::vector<vec4>;
Planes frustum_planes(const mat4& clip_from_world); ///< left, right, bottom, top, near; reversed depth, no far plane

/// The scene on the device: buffers made once, acceleration structures on first use. Keeps a reference to the scene.
///   vertex stream 0: positions, vec3; stream 1 where asked for: attributes {uint snorm16x2 octahedral normal; vec2 uv; uint rgba8 colour}
///   instances: shaders/scene.glsl `Instance`, indexed by gl_InstanceIndex (sorted by mesh; the primitive ids are the scene's)
class SceneGpu {
public:
    /// `previous`: the same scene at the previous frame's time, for motion; nullptr = nothing moves.
    SceneGpu(gpu::Device&, const scene::Scene&, const scene::Scene* previous = nullptr);
    /// Of meshes that a device alone has (Mesh::absent_triangles): positions(), indices() and attributes() are left for passes to write,
    /// mesh by mesh at `range`. `counts`: vertices and indices of each mesh; `textures`: in place of the scene's, by the same numbers.
    SceneGpu(gpu::Device&, const scene::Scene&, std::span<const uvec2> counts, gpu::TextureTable textures);
    ~SceneGpu();

    const scene::Scene& scene() const;
    gpu::Device& device() const;
    const Bounds& bounds() const;
    bool has(DrawSet) const; ///< whether the scene has any such triangle
    bool emits() const;

    gpu::Buffer& positions();
    gpu::Buffer& attributes();
    gpu::Buffer& indices();
    gpu::Buffer& instances();
    gpu::Buffer& materials();
    gpu::Buffer& previous_positions(); ///< of the previous frame; the same as positions() where nothing moves
    gpu::Buffer& previous_instances();
    const gpu::TextureTable& textures() const;
    const gpu::AccelerationStructure& tlas(); ///< opaque and masked triangles; instance custom index = instance slot

    static gpu::VertexStream position_stream(); ///< location 0
    static gpu::VertexStream attribute_stream(); ///< locations 1 normal (uint), 2 uv, 3 colour (uint)
    static gpu::VertexStream previous_stream(); ///< location 4

    enum class Second { none, attributes, previous };
    struct DrawOptions {
        unsigned sets = draw_opaque;
        const Planes* cull = nullptr; ///< instances wholly outside are left out
        bool cull_back_faces = false; ///< of single-sided materials; otherwise the encoder's cull mode is left alone
        Second second = Second::none; ///< what stream 1 holds
        const vec3* back_to_front_of = nullptr; ///< sorts instances by the distance of their centres from this eye
        uint32_t layer = 0; ///< < 256; reaches the vertex shader in the top byte of gl_InstanceIndex (shaders/scene.glsl)
        uint32_t pulled = 0; ///< > 0: no vertex or index buffers, but so many vertices for each triangle, which the shader reads for itself
    };
    /// Draw calls for the chosen triangles inside a raster pass; returns the triangles sent.
    uint64_t draw(gpu::Encoder&, const DrawOptions&);

    /// For draws that the GPU chooses: one shaders::Caster (src/shadow/casters.shared.h) a slot, in the order of instances().
    gpu::Buffer& casters();
    uint32_t slot_count() const;
    /// Of a mesh, in the buffers that all meshes share.
    struct MeshRange {
        uint32_t first_vertex, vertex_count, first_index, index_count;
    };
    const MeshRange& range(size_t mesh) const;
    /// To be called when the scene's transforms or the bounds of its meshes have changed, or, by `deformed`, vertices on the device.
    void moved(std::span<const uint32_t> deformed = {});
    /// Asked by `draw` with `cull` of each instance of the scene that its bounds leave: whether it is drawn. Null: all are.
    using Filter = std::function<bool(uint32_t instance, const Planes&)>;
    void set_filter(Filter);
    /// The slots of `sets` by their VkDrawIndexedIndirectCommand, one a slot from `offset` on; the pass names `commands` in `buffers`. Of
    /// the options `sets` and `second` are read.
    void draw_indirect(gpu::Encoder&, const DrawOptions&, gpu::BufferId commands, uint64_t offset);
    /// What `draw` sends for one instance, for techniques that cull on the device.
    struct Drawable {
        uint32_t slot; ///< in instances()
        uint32_t instance, mesh; ///< of the scene
        uint32_t first_index, index_count, first_vertex;
        DrawSet set;
        bool operator==(const Drawable&) const = default;
    };
    std::vector<Drawable> drawables() const;
    /// Stands for these casters where they are, even after this object is gone, unlike its address: techniques that keep something between
    /// frames tell by it whether they see the same again. `shapes`: wherever they are.
    std::shared_ptr<const void> content() const;
    std::shared_ptr<const void> shapes() const;

    struct Impl; ///< scene_gpu_impl.h

private:
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::shadow
