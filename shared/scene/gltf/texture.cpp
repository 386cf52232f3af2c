// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/texture.h"

#include "shared/image/image_file.h"
#include "shared/image/limits.h"
#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/image/decode.h"
#include "shared/scene/image/radiance_layer.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

Wrap wrapOf(int value, const std::string& who) {
    if (value == TINYGLTF_TEXTURE_WRAP_REPEAT) return Wrap::repeat;
    if (value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirrored_repeat;
    if (value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    fail(who, fmt::format("{} is not a wrap mode", value));
}

// Missing filters default to linear with mipmaps.
Sampler readSampler(const Json& file, const std::string& who) {
    Sampler sampler;
    sampler.wrap_s = wrapOf(file.value("wrapS", TINYGLTF_TEXTURE_WRAP_REPEAT), who);
    sampler.wrap_t = wrapOf(file.value("wrapT", TINYGLTF_TEXTURE_WRAP_REPEAT), who);
    const int magnify = file.value("magFilter", TINYGLTF_TEXTURE_FILTER_LINEAR),
              minify = file.value("minFilter", TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR);
    if (magnify != TINYGLTF_TEXTURE_FILTER_NEAREST && magnify != TINYGLTF_TEXTURE_FILTER_LINEAR)
        fail(who, fmt::format("{} is not a magFilter", magnify));
    sampler.magnify_linear = magnify == TINYGLTF_TEXTURE_FILTER_LINEAR;
    // NEAREST and LINEAR follow each other, and so do the four with mipmaps: ..._NEAREST, then ..._LINEAR.
    const int plain = minify - TINYGLTF_TEXTURE_FILTER_NEAREST,
              mipmapped = minify - TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
    sampler.mipmaps = mipmapped >= 0 && mipmapped < 4;
    if (!sampler.mipmaps && plain != 0 && plain != 1) fail(who, fmt::format("{} is not a minFilter", minify));
    sampler.minify_linear = minify % 2 == 1;
    sampler.mipmaps_linear = sampler.mipmaps && mipmapped >= 2;
    return sampler;
}

// Decodes an HDR image as a texture. `max`: limit of its decoded bytes. Errors begin with `who`.
TextureImage decodeRadiance(std::span<const unsigned char> bytes, const std::string& who, std::uint64_t max,
                            std::vector<std::string>& notes) {
    const ImageFile stored = readImage(std::as_bytes(bytes), who, {}, max);
    if (stored.width > limits::texture_side || stored.height > limits::texture_side)
        fail(who, fmt::format("has {} x {} pixels; each side must be 1 to {}", stored.width, stored.height,
                              limits::texture_side));
    constexpr std::size_t bytesPerPixel = 4 * sizeof(float);
    const Image light = named(who, [&] { return radianceOf(stored, who, notes); });
    if (light.pixels() > max / bytesPerPixel)
        fail(who, fmt::format("with it the decoded images exceed the limit of {} MiB",
                              limits::imageBytes() >> 20));
    TextureImage image;
    image.width = light.width;
    image.height = light.height;
    image.rgba32.reserve(4 * light.pixels());
    image.largest = 0;
    for (std::size_t i = 0; i < light.pixels(); ++i) {
        const float* p = light.pixel(i);
        image.rgba32.insert(image.rgba32.end(), {p[0], p[1], p[2], 1});
        image.largest = std::max({image.largest, p[0], p[1], p[2]});
    }
    return image;
}

}  // namespace

std::vector<std::string> readTextures(const Json& document, Scene& scene) {
    const Json& samplers = arrayAt(document, "/samplers");
    std::vector<std::string> faults;
    for (const Json& file : arrayAt(document, "/textures")) {
        Texture& texture = scene.textures.emplace_back();
        texture.image = file.value("source", -1);
        if (const Json* webp = extension(file, "EXT_texture_webp"))
            texture.image = webp->value("source", texture.image);
        const int sampler = file.value("sampler", -1);
        faults.push_back(faultOf([&] {
            if (sampler >= 0)
                texture.sampler = readSampler(samplers[static_cast<std::size_t>(sampler)],
                                              fmt::format("sampler {}", sampler));
        }));
    }
    return faults;
}

const char* otherImageOf(const Json& texture) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif"})
        if (extension(texture, name)) return name;
    return nullptr;
}

std::vector<Claim> readImages(const Model& model, const std::vector<int>& imageOf,
                              const std::vector<bool>& lightmaps, std::vector<TextureImage>& images,
                              std::vector<std::string>& notes, const std::function<void()>& tally) {
    struct Encoded {
        std::string file, who;
        std::span<const unsigned char> bytes;
        std::string cut;            // why bytes are missing at the end
        std::uint64_t decoded = 0;  // bytes
        bool radiance = false;
    };
    std::vector<Encoded> all(images.size());
    const auto ofEach = [&](const auto& run) {
        forEachInParallel(all.size(), [&](std::size_t i) {
            try {
                run(i, all[i]);
            } catch (const std::runtime_error& e) {
                fail(all[i].who, all[i].cut.empty() ? e.what() : all[i].cut);
            }
        });
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        const tinygltf::Image& image = model.images[static_cast<std::size_t>(imageOf[i])];
        all[i].file = image.uri.empty() ? image.name : image.uri;
        all[i].who =
            fmt::format("image {}{}", imageOf[i], all[i].file.empty() ? "" : " (" + all[i].file + ")");
        all[i].bytes = image.bufferView >= 0 ? viewBytes(model, image.bufferView) : std::span(image.image);
        if (image.bufferView >= 0) all[i].cut = cutOf(model, image.bufferView);
        if (all[i].bytes.empty())
            fail(all[i].who, image.bufferView < 0 ? "cannot be read, or is empty" : "is empty");
        all[i].radiance = lightmaps[i] && isRadianceImage(std::as_bytes(all[i].bytes));
    }
    // Headers give the total decoded size before any image is decoded.
    ofEach([](std::size_t, Encoded& image) {
        if (!image.radiance) image.decoded = imageHeader(image.bytes).bytes();
    });
    std::uint64_t total = 0;
    for (const Encoded& image : all)
        if ((total += image.decoded) > limits::imageBytes())
            fail(image.who, fmt::format("with it the decoded images take {} MiB; the limit is {} MiB",
                                        total >> 20, limits::imageBytes() >> 20));
    std::vector<Claim> claims;
    for (const Encoded& image : all)
        claims.push_back(claimMemory(image.decoded, image.bytes.size(), image.who));
    // HDR images are rare, and their size is known only after opening, so they are decoded one by one.
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].radiance) continue;
        images[i] = decodeRadiance(all[i].bytes, all[i].who, limits::imageBytes() - total, notes);
        const std::uint64_t bytes = images[i].rgba32.size() * sizeof(float);
        claims.push_back(claimMemory(bytes, all[i].bytes.size(), all[i].who));
        total += bytes;
    }
    ofEach([&](std::size_t i, const Encoded& image) {
        if (!image.radiance) images[i] = decodeImage(image.bytes);
        images[i].name = image.file;
        tally();
    });
    return claims;
}

}  // namespace diptych::gltf
