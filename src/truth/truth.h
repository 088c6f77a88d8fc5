// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>

// Ray-traced reference by Embree. Knows no Vulkan.
namespace gnomon::truth {

inline constexpr uint32_t no_primitive = 0xffffffffu;

/// What the camera sees through each pixel centre. Single-sided materials are not seen from behind, masked ones not where
/// alpha < cutoff, blended ones not at all: as the rasteriser's G-buffer.
struct Primary {
    base::Picture depth; ///< 1 channel: distance along the view axis in metres; 0 = background
    base::Picture position; ///< 3 channels: world
    base::Picture normal; ///< 3 channels: geometric, unit, turned towards the eye
    std::vector<uint32_t> primitive; ///< scene-wide primitive id (Scene::first_primitives), no_primitive = background
};

struct Settings {
    int samples = 256; ///< light samples a pixel, rounded up to a square; 1 is used for lights without area
    uint64_t seed = 1;
    int threads = 0; ///< 0 = all
    std::stop_token stop{}; ///< where it is asked for, light samples end soon, with base::Error
};

/// Fraction of the light that reaches each visible point. Background pixels are 1.
/// A sample counts as visible when (a) the light sends light there (scene::reaches; else the pixel's mean is 0), (b) it is on the
/// eye's side of the receiver's geometric plane, and (c) the open segment meets no opaque or mask-kept triangle, from either side.
/// Where the light has an image, each channel's samples weigh what the light emits there in that channel.
struct Visibility {
    base::Picture mean; ///< 1 channel (visibility), or 3 (transmittance, or a light with an image)
    /// Of the mean, same channels; 0 for hard lights. One sample a stratum gives no variance within it, so neighbouring strata
    /// are paired: never too small in expectation, too large where visibility changes between the two. Where all samples agree it
    /// is 0, although a blocker smaller than a stratum may have been missed: the true error there is below 1 / samples.
    base::Picture variance;
    int samples = 0;
};

struct RawThroughput; // truth/benchmark.h

class Tracer {
public:
    /// Placed triangles up to this number are flattened to world space; above it, meshes placed more than once are instanced.
    static constexpr size_t default_flatten_limit = 8'000'000;

    /// Builds the acceleration structure; keeps a reference to the scene, which must outlive it.
    explicit Tracer(const scene::Scene&, size_t flatten_limit = default_flatten_limit);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    Primary primary(const scene::View&, int threads = 0) const;
    Visibility visibility(const scene::View&, const Primary&, const scene::Light&, const Settings&) const;
    Visibility transmittance(const scene::View&, const Primary&, const scene::Light&, const Settings&) const;
    /// Visibility of single points with given normals (for tests and for edge bands): one value each; a light's image is left out of
    /// account.
    std::vector<double> visibility_at(
        const std::vector<vec3>& points, const std::vector<vec3>& normals, const scene::Light&, const Settings&) const;
    /// The same in each channel of a light with an image.
    std::vector<glm::dvec3> colored_visibility_at(
        const std::vector<vec3>& points, const std::vector<vec3>& normals, const scene::Light&, const Settings&) const;
    double build_ms() const;

private:
    friend RawThroughput raw_packets(const Tracer&, const scene::View&, const scene::Light&, int threads);
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The same through the disk cache: key = content of scene, view, light, settings and the version of this code. A damaged entry is
/// traced again. `folder` empty = base::cache_folder() / "truth".
struct Reference {
    Primary primary;
    Visibility visibility;
    bool from_cache = false;
    double trace_ms = 0; ///< primary + shadow rays, without the build; 0 when from the cache
};
enum class Quantity { visibility, transmittance };
int channels(Quantity, const scene::Light&); ///< of Visibility's pictures
Reference reference(const scene::Scene&, const scene::View&, const scene::Light&, const Settings&, Quantity = Quantity::visibility,
    const std::filesystem::path& folder = {});

} // namespace gnomon::truth
