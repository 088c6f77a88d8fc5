/* SPDX-License-Identifier: Apache-2.0 */
/* Gnomon: real-time shadows for a renderer that owns everything: its Vulkan instance, device, queue, command buffers, images, buffers and
 * culling. Gnomon records into a command buffer of the host's and leaves one image, the fraction of one light that reaches each pixel.
 *
 * It never submits, waits for the device or touches a queue; after the first frame of a size it allocates no device memory. Objects may be
 * destroyed in any order; what recorded commands still need is held until gnomon_retire says that they are done. Different devices
 * (gnomon_device) may be used by different threads at once, one device by one thread at a time; several may stand on one VkDevice.
 *
 * Conventions. Matrices are column-major and act on column vectors. Instances, lights and views are in one space of the host's,
 * described by gnomon_space. Nothing is assumed of view and clip space but Vulkan's depth range of 0 to 1: reversed or not, finite or
 * infinite, jittered, off-centre, mirrored and orthographic projections are taken as they are.
 *
 * Errors. Functions return a gnomon_result; gnomon_error_message has the sentence. A failed call changes nothing.
 */
#ifndef GNOMON_GNOMON_H
#define GNOMON_GNOMON_H

#include <stdint.h>
#include <vulkan/vulkan_core.h>

#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 2
#define GNOMON_VERSION_PATCH 0
#define GNOMON_VERSION (GNOMON_VERSION_MAJOR * 10000 + GNOMON_VERSION_MINOR * 100 + GNOMON_VERSION_PATCH)

#if defined(_WIN32)
#define GNOMON_API
#else
#define GNOMON_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gnomon_result {
    GNOMON_SUCCESS = 0,
    GNOMON_ERROR_ARGUMENT = 1, /* what was given is wrong: a name, a value out of range, a missing handle */
    GNOMON_ERROR_UNSUPPORTED = 2, /* this device, light or image cannot be used for it */
    GNOMON_ERROR_OUT_OF_MEMORY = 3, /* of the host or the device; smaller maps or pictures may work */
    GNOMON_ERROR_DEVICE_LOST = 4,
    GNOMON_ERROR_OTHER = 5
} gnomon_result;

/* What the last failed call on this thread said, in one sentence: the thing, the place, the next step. Valid until the next call. */
GNOMON_API const char* gnomon_error_message(void);
GNOMON_API uint32_t gnomon_version(void); /* GNOMON_VERSION of the library; compatible where major and, below 1.0, minor are equal */

/* ---- the host's device ---- */

typedef struct gnomon_device_t* gnomon_device;

/* Sets what Gnomon needs in the host's own wishes for vkCreateDevice, leaving the rest as it is. Fails where the device lacks any of it.
 * Ray tracing (VK_KHR_acceleration_structure with VK_KHR_ray_query or VK_KHR_ray_tracing_pipeline) is used where the host enables it. */
typedef struct gnomon_features {
    VkPhysicalDeviceFeatures* core;
    VkPhysicalDeviceVulkan11Features* v11;
    VkPhysicalDeviceVulkan12Features* v12;
    VkPhysicalDeviceVulkan13Features* v13;
} gnomon_features;
GNOMON_API gnomon_result gnomon_require(PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice, const gnomon_features*);

typedef struct gnomon_device_info {
    uint32_t version; /* GNOMON_VERSION */
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance; /* Vulkan 1.3 or later, as the device */
    VkPhysicalDevice physical_device;
    VkDevice device; /* with the features of gnomon_require */
    uint32_t queue_family; /* of the command buffers; with graphics and compute */
    const char* const* extensions; /* the device extensions that are enabled */
    uint32_t extension_count;
    VkPipelineCache pipeline_cache; /* the host's, or VK_NULL_HANDLE; Gnomon writes no files */
} gnomon_device_info;
/* The handles stay the host's and outlive the gnomon_device. */
GNOMON_API gnomon_result gnomon_device_create(const gnomon_device_info*, gnomon_device*);
/* The command buffers recorded with it have finished. NULL does nothing, here and below. */
GNOMON_API void gnomon_device_destroy(gnomon_device);
/* Commands up to this ticket of gnomon_record have finished: their resources are used again or freed. */
GNOMON_API void gnomon_retire(gnomon_device, uint64_t ticket);
GNOMON_API uint64_t gnomon_device_bytes(gnomon_device); /* device memory in use, in bytes */

/* ---- techniques ---- */

enum { GNOMON_DIRECTIONAL = 0, GNOMON_SPOT = 1, GNOMON_POINT = 2, GNOMON_RECT = 3, GNOMON_DISK = 4 }; /* gnomon_light::kind */

typedef struct gnomon_technique {
    const char *id, *title, *family, *cite;
    uint32_t light_kinds; /* 1 << kind of those it takes */
    VkBool32 soft; /* penumbrae of lights with an area; else a light is its centre */
    VkBool32 colored; /* the image has three channels: transmittance */
    VkBool32 needs_vertices; /* gnomon_mesh::positions must be given */
    VkBool32 draws_receivers; /* it must know each pixel's triangle, and draws what the view sees of the scene itself */
} gnomon_technique;
GNOMON_API uint32_t gnomon_technique_count(void);
GNOMON_API gnomon_result gnomon_technique_get(uint32_t index, gnomon_technique*); /* strings live as long as the library */

/* ---- casters ---- */

typedef struct gnomon_scene_t* gnomon_scene;

typedef struct gnomon_space {
    uint32_t up; /* the axis that points up: 0 x, 1 y, 2 z */
    VkBool32 left_handed;
    float metres_per_unit; /* tolerances and parameters of techniques are in metres; 0 stands for 1 */
} gnomon_space;

/* A part of a buffer that was made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. */
typedef struct gnomon_stream {
    VkBuffer buffer; /* its size is a multiple of 4 */
    VkDeviceSize offset; /* bytes to the first element; a multiple of 2 */
    uint32_t stride; /* bytes; a multiple of 2 */
    VkFormat format; /* positions: R32G32B32(A32)_SFLOAT, R16G16B16A16_SFLOAT, _SNORM or _UNORM. Texture coordinates: R32G32_SFLOAT,
                        R16G16_SFLOAT, _SNORM or _UNORM. Indices: R32_UINT or R16_UINT, tightly packed, stride unread */
} gnomon_stream;

typedef struct gnomon_mesh {
    gnomon_stream vertices, texture_coordinates, indices; /* a null buffer: no texture coordinates; triangles in the vertices' order */
    uint32_t vertex_count, index_count; /* index_count: a multiple of 3 */
    uint32_t material;
    float lower[3], upper[3]; /* bounds, object space */
    VkBool32 clockwise; /* front faces, seen in a left- or right-handed space as gnomon_space says */
    const float* positions; /* three a vertex, object space; or NULL. Read while the scene is made */
    const uint32_t* triangles; /* index_count, beside `positions`; NULL: the vertices' order */
} gnomon_mesh;

enum { GNOMON_OPAQUE = 0, GNOMON_MASKED = 1, GNOMON_BLENDED = 2 }; /* gnomon_material::kind; blended casts into coloured images only */

typedef struct gnomon_material {
    uint32_t kind;
    float color[4]; /* linear; masked and blended: times the texture */
    float cutoff; /* masked: a point is there where alpha >= cutoff */
    VkBool32 double_sided;
    VkImageView texture; /* 2D, all levels, or VK_NULL_HANDLE; the host's, outlives the scene, in SHADER_READ_ONLY_OPTIMAL when read */
    VkSampler sampler;
} gnomon_material;

typedef struct gnomon_instance {
    uint32_t mesh;
    VkTransformMatrixKHR transform; /* host space from object */
} gnomon_instance;

typedef struct gnomon_scene_info {
    gnomon_space space;
    const gnomon_material* materials;
    const gnomon_mesh* meshes;
    const gnomon_instance* instances;
    uint32_t material_count, mesh_count, instance_count;
} gnomon_scene_info;

/* The first gnomon_record reads the host's buffers into packed copies (12 bytes a position, 4 an index); they may go after it. */
GNOMON_API gnomon_result gnomon_scene_create(gnomon_device, const gnomon_scene_info*, gnomon_scene*);
GNOMON_API void gnomon_scene_destroy(gnomon_scene);
GNOMON_API gnomon_result gnomon_scene_move(gnomon_scene, uint32_t first, uint32_t count, const VkTransformMatrixKHR*);
/* The mesh's vertices have changed (skinning) and are read again by the next gnomon_record; as many, with these bounds. Not for a mesh
 * with gnomon_mesh::positions. */
GNOMON_API gnomon_result gnomon_scene_deform(gnomon_scene, uint32_t mesh, const float lower[3], const float upper[3]);

/* ---- shadows ---- */

typedef struct gnomon_shadow_t* gnomon_shadow;

typedef struct gnomon_light {
    uint32_t kind; /* may not change during a gnomon_shadow's life */
    float position[3]; /* host space; rect and disk: the centre */
    float direction[3]; /* in which it shines, any length; spot: the axis; rect and disk: the normal of the emitting side */
    float half_u[3], half_v[3]; /* rect: corners lie at position +- half_u +- half_v */
    float radius; /* host units; 0: a point. Directional: half its apparent diameter, radians (the sun: 0.00465) */
    float inner_angle, outer_angle; /* spot: half angles, radians */
} gnomon_light;

/* `settings`: "name=value" parted by blanks, as `gnomon list TECHNIQUE` shows them, or NULL. */
GNOMON_API gnomon_result gnomon_shadow_create(gnomon_scene, const char* technique, const char* settings, gnomon_shadow*);
GNOMON_API void gnomon_shadow_destroy(gnomon_shadow);
GNOMON_API gnomon_result gnomon_shadow_set(gnomon_shadow, const char* settings);

/* A ready choice: the arguments of gnomon_shadow_create, and their price as it was measured (docs/quality.md); below 0: not measured. */
typedef struct gnomon_choice {
    char technique[64], settings[512];
    double time; /* as a multiple of shadow_map with its defaults, under the same light shrunk to a point */
    double error; /* mean absolute error of the visibility, of 1 */
    double mebibytes;
} gnomon_choice;
enum { GNOMON_LOW = 0, GNOMON_MEDIUM = 1, GNOMON_HIGH = 2, GNOMON_EXACT = 3 };
/* The first choice of that level for the light's kind, with an area or without, that this device can run. */
GNOMON_API gnomon_result gnomon_choose(gnomon_device, uint32_t level, const gnomon_light*, gnomon_choice*);

typedef struct gnomon_image {
    VkImage image; /* 2D; its first level and layer are used */
    VkFormat format;
    VkExtent2D extent;
    VkSampleCountFlagBits samples; /* 0 stands for 1 */
    VkImageLayout layout; /* found so, and left so; UNDEFINED: the content is not needed, and it is left in SHADER_READ_ONLY_OPTIMAL */
} gnomon_image;

enum { /* gnomon_frame::normal_encoding */
    GNOMON_NORMAL_SIGNED = 0, /* xyz, any length */
    GNOMON_NORMAL_UNSIGNED = 1, /* xyz = 2 * rgb - 1 */
    GNOMON_NORMAL_OCTAHEDRAL = 2, /* rg in [-1, 1] (Cigolle et al. 2014) */
    GNOMON_NORMAL_OCTAHEDRAL_UNSIGNED = 3, /* 2 * rg - 1 */
    GNOMON_NORMAL_GEOMETRIC = 4 /* added to one of these: they are the triangles' own, or smooth ones without normal maps, and are used where
                                   surfaces keep off their own shadow; else that normal is made from the depth, less well at edges */
};

/* Whether an instance may cast into the volume inside all planes (dot(xyz, p) + w >= 0, host space). Asked while recording, by techniques
 * that draw casters into maps, of instances whose bounds touch the volume. */
typedef VkBool32 (*gnomon_cull)(void* user, uint32_t instance, const float (*planes)[4], uint32_t plane_count);

typedef struct gnomon_frame {
    VkCommandBuffer commands; /* recording, outside of rendering */
    float view_from_world[16], clip_from_view[16]; /* world: the host's space */
    VkBool32 y_up; /* the viewport's height is negative: row 0 of the images is clip y = 1 */
    uint32_t index; /* frame number, the only clock and seed */
    gnomon_light light;
    gnomon_image depth; /* a depth or single-channel float format with VK_IMAGE_USAGE_SAMPLED_BIT; multisampled: sample 0, at its standard
                           location. A null image: the receivers are what the view sees of the scene */
    float background; /* depth where nothing was drawn: 0 reversed, else 1 */
    gnomon_image normals; /* of one sample, with VK_IMAGE_USAGE_SAMPLED_BIT, host space; a null image: made from the depth */
    uint32_t normal_encoding;
    gnomon_image motion; /* of one sample; rg = uv now - uv in the previous frame; a null image: nothing moved */
    gnomon_image output; /* any colour format with VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, of the receivers' size; 1 where all the light
                            arrives, and in the background */
    gnomon_cull cull; /* or NULL */
    void* cull_user;
} gnomon_frame;

/* Records the shadow of a light. `ticket`, which is never 0, goes to gnomon_retire once these commands have finished. */
GNOMON_API gnomon_result gnomon_record(gnomon_shadow, const gnomon_frame*, uint64_t* ticket);

#ifdef __cplusplus
}
#endif

#endif
