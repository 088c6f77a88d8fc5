// SPDX-License-Identifier: Apache-2.0
// Pictures: PNG, JPEG and EXR, as textures, as light images and as what the laboratory compares.
#include "base/image_file.h"
#include "fuzz/target.h"
#include "scene/light_image.h"

using namespace gnomon;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const auto whole = [](const base::Picture& p) { return !p.empty() && p.values.size() == p.size.area() * size_t(p.channels); };
    const std::filesystem::path png = fuzz::write("picture.png", fuzz::text_of(data, size));
    fuzz::accepts([&] { fuzz::demand(whole(base::read_png(png, base::Encoding::srgb)), "a picture has all its values"); });
    fuzz::accepts([&] {
        const base::Pixels8 pixels = base::decode_rgba8(std::as_bytes(std::span(data, size)), "picture");
        fuzz::demand(pixels.rgba.size() == size_t(pixels.width) * size_t(pixels.height) * 4, "a texture has all its texels");
    });
    fuzz::accepts([&] { scene::load_light_image("picture.png", fuzz::folder()); });

    const std::filesystem::path exr = fuzz::write("picture.exr", fuzz::text_of(data, size));
    fuzz::accepts([&] {
        std::vector<std::string> names;
        const base::Picture picture = base::read_exr(exr, &names);
        fuzz::demand(whole(picture) && names.size() == size_t(picture.channels), "a picture has all its channels");
    });
    fuzz::accepts([&] { scene::load_light_image("picture.exr", fuzz::folder()); });
    return 0;
}
