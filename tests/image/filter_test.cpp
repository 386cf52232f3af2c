// SPDX-License-Identifier: MIT
// Magnified, linearly filtered textures of both paths against the reference in mode scene, which filters
// alike. A device may deviate by what a probe measures for the texels that a pixel mixes.
#include "compare/frames/frame_properties.h"
#include "compare/render/reference_frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/scene_view.h"
#include "tests/image/square.h"

#include <array>

namespace diptych::tests {
namespace {

constexpr int filteredTexels = 6, filteredPixels = 60;

// Noise in which neighbouring codes differ by little to everything.
Scene filteredSquare() {
    Scene scene = square();
    TextureImage image{"noise", filteredTexels, filteredTexels, {}};
    std::uint32_t state = 9;
    for (int i = 0; i < 4 * filteredTexels * filteredTexels; ++i) {
        state = state * 1664525u + 1013904223u;
        const int row = i / (4 * filteredTexels), spread = row < 2 ? 8 : row < 4 ? 60 : 256;
        image.rgba.push_back(static_cast<std::uint8_t>((state >> 24) * static_cast<unsigned>(spread) / 256));
    }
    scene.images[0] = image;
    scene.textures[0].sampler = {Wrap::clamp_to_edge, Wrap::clamp_to_edge, true, true, false, false};
    Material& m = scene.materials[0];
    m.base_color_texture.texture = m.metallic_roughness_texture.texture = m.occlusion_texture.texture =
        m.emissive_texture.texture = m.specular_texture.texture = 0;
    m.emissive = {1, 1, 1};
    return scene;
}

struct FilteredChannel {
    Channel mode;
    std::vector<std::size_t> components;  // texel component for each component of the channel
    bool srgb;
};
const std::array filteredChannels{
    FilteredChannel{Channel::albedo, {0, 1, 2}, true}, FilteredChannel{Channel::emission, {0, 1, 2}, true},
    FilteredChannel{Channel::roughness, {1}, false},   FilteredChannel{Channel::metallic, {2}, false},
    FilteredChannel{Channel::occlusion, {0}, false},   FilteredChannel{Channel::dielectric_f90, {3}, false}};

// The largest difference between the decoded texels that the pixel mixes.
double rangeAt(const TextureImage& image, const TexelDecode& decode, std::size_t component, int x, int y) {
    const auto first = [](int pixel) {
        return static_cast<int>(std::floor((pixel + 0.5) * filteredTexels / filteredPixels - 0.5));
    };
    double min = 1, max = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int column = std::clamp(first(x) + i, 0, filteredTexels - 1),
                      row = std::clamp(first(y) + j, 0, filteredTexels - 1);
            const double texel = double{
                decode[image.rgba[4 * static_cast<std::size_t>(row * filteredTexels + column) + component]]};
            min = std::min(min, texel);
            max = std::max(max, texel);
        }
    return max - min;
}

// Number of values of a channel whose error exceeds `grant` times the bound.
std::size_t beyondBound(const Frame& frame, const Frame& reference, const TextureImage& image,
                        const FilteredChannel& channel, const TextureSampling& sampling, double grant) {
    const Channel mode = channel.mode;
    const FilterBound& bound = channel.srgb ? sampling.srgb_filter : sampling.linear_filter;
    std::size_t beyond = 0;
    for (int y = 0; y < filteredPixels; ++y)
        for (int x = 0; x < filteredPixels; ++x)
            for (std::size_t c = 0; c < channel.components.size(); ++c) {
                const double range =
                    rangeAt(image, sampling.decode(channel.srgb), channel.components[c], x, y);
                // A texel's weight is a product of two float coordinates.
                const double allowed = grant * bound.of(range) + 4 * 0x1p-23 * filteredTexels;
                const double off = double{frame.channels.at(mode).at(x, y, static_cast<int>(c))} -
                                   double{reference.channels.at(mode).at(x, y, static_cast<int>(c))};
                beyond += !(std::abs(off) <= allowed);
            }
    return beyond;
}

TEST(TextureFilters, AreOffByWhatTheDeviceMeasuresAndNoMore) {
    const Scene scene = filteredSquare();
    const TextureSampling sampling = probeTextures(device());
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {filteredPixels, filteredPixels};
    const auto traced = [&](const Scene& of) {
        SceneViews views(of);
        Settings asked = with(settings, "path reference reference-mode scene");
        RenderOptions options;
        options.channels = allChannels();
        return drawReferenceFrame(of, views.at(viewRequest(asked)), asked, nullptr, options);
    };
    const Scene decoded = withDecodedColors(scene, sampling.srgb);
    Scene moved = decoded;  // the negative control: shifted by a twentieth of a texel
    for (const auto slot :
         {&Material::base_color_texture, &Material::metallic_roughness_texture, &Material::occlusion_texture,
          &Material::emissive_texture, &Material::specular_texture})
        (moved.materials[0].*slot).u.z = 0.05 / filteredTexels;
    const Frame reference = traced(decoded), wrong = traced(moved);
    Frame undecoded = traced(scene);
    for (const Frame& frame : bothPaths(scene, settings))
        for (const FilteredChannel& channel : filteredChannels) {
            const std::string who = frame.name + " " + std::string(debugMode(channel.mode).name);
            const auto beyond = [&](const Frame& truth, double grant) {
                return beyondBound(frame, truth, scene.images[0], channel, sampling, grant);
            };
            EXPECT_EQ(beyond(reference, 1), 0u) << who;
            EXPECT_GT(beyond(wrong, 1), 100u) << who << ": the negative control";
            // The whole tolerance is needed if the device deviates at all.
            if (!channel.srgb && sampling.linear_filter.rounding > 0.1 / 255) {
                EXPECT_GT(beyond(reference, 0.5), 0u) << who;
            }
            double worst = 0;
            for (std::size_t code = 0; code < 256; ++code) worst = std::max(worst, sampling.srgbError(code));
            if (channel.srgb && worst > 1e-4) {
                EXPECT_GT(beyond(undecoded, 1), 100u) << who << ": decoded exactly";
            }
        }
}

}  // namespace
}  // namespace diptych::tests
