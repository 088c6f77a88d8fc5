// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

#include <map>
#include <tuple>

namespace gnomon::scene::gltf {

/// Makes the materials and textures that the drawn primitives use, once each, in the scene.
class Materials {
public:
    Materials(Document& document, Scene& scene)
        : document_(document)
        , scene_(scene)
    {
    }
    struct Use {
        int material = 0; ///< index into Scene::materials
        int uv_set = -1; ///< the TEXCOORD set that its textures need; -1: it has no texture
    };
    /// The material of a primitive: its own, or the default (a matt white) where it has none or its own is missing.
    Use use(const Value& primitive);

private:
    Use make(const Value& material);
    void read_surface(const Value& material, Material& out, int& uv_set);
    TextureUse texture(const Value& info, bool srgb, int& uv_set);
    int texture_index(const Value& reference, bool srgb);
    Document& document_;
    Scene& scene_;
    std::map<int64_t, Use> made_; ///< by the index in the file; -1 = the default
    using TextureKey = std::tuple<uint64_t, bool, bool, Wrap, Wrap>; ///< image in the file, srgb, linear, wrapping
    std::map<TextureKey, int> textures_; ///< -1 = it could not be read, which has been warned of
    uint64_t texture_bytes_ = 0;
};

/// An image file in memory as RGBA into `out`. PNG and JPEG only. DataError named after `image`.
void decode_image(std::span<const std::byte> file, const Value& image, Texture& out);

} // namespace gnomon::scene::gltf
