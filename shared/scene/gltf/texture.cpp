// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/texture.h"

#include "shared/image/limits.h"
#include "shared/image/picture_file.h"
#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/tally.h"
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

namespace {

Wrap wrapOf(int value, const std::string& who) {
    switch (value) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp_to_edge;
        default:
            fail(who, fmt::format("{} is not a wrap mode", value));
    }
}

// Missing filters default to linear with mipmaps.
Sampler readSampler(const tinygltf::Sampler& s, const std::string& who) {
    Sampler sampler;
    sampler.wrap_s = wrapOf(s.wrapS, who);
    sampler.wrap_t = wrapOf(s.wrapT, who);
    if (s.magFilter != -1 && s.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
        s.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR)
        fail(who, fmt::format("{} is not a magFilter", s.magFilter));
    sampler.magnify_linear = s.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    const auto minify = [&](bool linear, bool mipmaps, bool between) {
        sampler.minify_linear = linear;
        sampler.mipmaps = mipmaps;
        sampler.mipmaps_linear = between;
    };
    switch (s.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            minify(false, false, false);
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            minify(true, false, false);
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            minify(false, true, false);
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            minify(true, true, false);
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            minify(false, true, true);
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
        case -1:
            minify(true, true, true);
            break;
        default:
            fail(who, fmt::format("{} is not a minFilter", s.minFilter));
    }
    return sampler;
}

// Decodes an HDR image as a texture. `most`: limit of its decoded bytes. Errors begin with `who`.
TextureImage decodeRadiance(std::span<const unsigned char> bytes, const std::string& who, std::uint64_t most,
                            std::vector<std::string>& notes) {
    const PictureFile picture = readPicture(std::as_bytes(bytes), who, {}, most);
    if (picture.width > limits::texture_side || picture.height > limits::texture_side)
        fail(who, fmt::format("has {} x {} pixels; each side must be 1 to {}", picture.width, picture.height,
                              limits::texture_side));
    constexpr std::size_t bytesPerPixel = 4 * sizeof(float);
    const Image light = named(who, [&] { return radianceOf(picture, who, notes); });
    if (light.pixels() > most / bytesPerPixel)
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

std::vector<std::string> readTextures(const tinygltf::Model& model, Scene& scene) {
    std::vector<std::string> faults;
    for (std::size_t i = 0; i < model.textures.size(); ++i) {
        const tinygltf::Texture& t = model.textures[i];
        const std::string who = fmt::format("texture {}", i);
        Texture texture;
        const tinygltf::Value* webp = extension(t.extensions, "EXT_texture_webp");
        texture.image = checkedIndex(webp ? indexIn(*webp, "source", t.source, who) : t.source,
                                     model.images.size(), who, "image");
        std::string& fault = faults.emplace_back();
        const int sampler = checkedIndex(t.sampler, model.samplers.size(), who, "sampler");
        try {
            if (sampler >= 0)
                texture.sampler = readSampler(model.samplers[static_cast<std::size_t>(sampler)],
                                              fmt::format("sampler {}", sampler));
        } catch (const std::runtime_error& e) {
            fault = e.what();
        }
        scene.textures.push_back(texture);
    }
    return faults;
}

const char* otherImageOf(const tinygltf::Texture& texture) {
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif"})
        if (extension(texture.extensions, name)) return name;
    return nullptr;
}

std::vector<Claim> readImages(const tinygltf::Model& model, const std::vector<int>& imageOf,
                              const std::vector<bool>& lightmaps, std::vector<TextureImage>& images,
                              std::vector<std::string>& notes, Tally& tally) {
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
        all[i].bytes =
            image.bufferView >= 0 ? viewBytes(model, image.bufferView, all[i].who) : std::span(image.image);
        if (image.bufferView >= 0) all[i].cut = cutOf(model, image.bufferView);
        if (all[i].bytes.empty())
            fail(all[i].who, image.bufferView < 0 ? "cannot be read, or is empty" : "is empty");
        all[i].radiance = lightmaps[i] && isRadiancePicture(std::as_bytes(all[i].bytes));
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
        tally.oneMore();
    });
    return claims;
}

}  // namespace diptych::gltf
