// SPDX-License-Identifier: MIT
// Skipped texture samples leave the bits unchanged: images of one colour become factors, and slots that
// read one image alike share a sample. Also the error of --textures packed.
#include "shared/material/materials.h"
#include "shared/scene/model/material_slots.h"
#include "tests/image/square.h"

#include <functional>
#include <set>

namespace diptych::tests {
namespace {

TextureImage noiseOf(int width, int height, std::uint32_t seed) {
    TextureImage image{"noise", width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i) {
        seed = seed * 1664525u + 1013904223u;
        image.rgba.push_back(static_cast<std::uint8_t>(seed >> 24));
    }
    return image;
}

// The square rotated, so that mip levels vary across it, lit by a lamp and ambient light. Every slot reads
// texture 0 (`image`) with trilinear filtering, and has its own factors.
Scene turnedSquare(const TextureImage& image) {
    Scene scene = square();
    scene.nodes[0].parent_from_node = glm::rotate(glm::dmat4(1.0), glm::radians(65.0), glm::dvec3(1, 0.3, 0));
    scene.images = {image};
    scene.textures = {{0, {}}};
    Material& m = scene.materials[0];
    m.base_color = {0.9f, 0.7f, 0.8f, 1};
    m.metallic = 0.7f;
    m.roughness = 0.9f;
    m.emissive = {0.1f, 0.3f, 0.2f};
    m.occlusion_strength = 0.6f;
    m.normal_scale = 0.8f;
    m.specular = 0.9f;
    m.specular_color = {0.5f, 0.8f, 0.7f};
    m.double_sided = true;
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = {0.2, 0.4, 0.8};
    lamp.intensity = 4;
    scene.lights = {lamp};
    return scene;
}

Settings litImage(TexturePrecision textures = TexturePrecision::device) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.ambient = {0.2f, 0.3f, 0.4f};
    settings.textures = textures;
    return settings;
}

// Texel sources of the slots of a scene's first material.
SlotTexels texelsOnDevice(const Scene& scene, TexturePrecision textures = TexturePrecision::device) {
    Uploader uploader(device());
    const Materials onDevice(device(), uploader, scene, textures);
    uploader.flush();
    SlotTexels texels{};
    for (std::size_t slot = 0; slot < texels.size(); ++slot)
        texels[slot] = onDevice.variant(0).get(slotFeatures[slot]);
    return texels;
}

void expectSameImages(const Scene& a, const Scene& b, const Settings& settings) {
    const std::vector<Frame> framesA = bothPaths(a, settings), framesB = bothPaths(b, settings);
    for (std::size_t i = 0; i < framesA.size(); ++i) {
        SCOPED_TRACE(framesA[i].name);
        EXPECT_GT(coveredPixels(framesA[i]), 1000u);
        expectSameChannels(framesA[i], framesB[i]);
    }
}

// Compared with a copy of the image, which is then sampled separately.
TEST(TexelSharing, OneSampleHasTheBitsOfTwo) {
    Scene shared = turnedSquare(noiseOf(64, 32, 3));
    Material& m = shared.materials[0];
    m.base_color_texture.texture = m.emissive_texture.texture = m.metallic_roughness_texture.texture =
        m.occlusion_texture.texture = m.sheen_color_texture.texture = m.sheen_roughness_texture.texture = 0;
    m.metallic_roughness_texture.u = m.occlusion_texture.u = {1.5, 0.2, 0.1};
    m.sheen_color = {0.3f, 0.2f, 0.4f};
    m.sheen_roughness = 0.6f;
    for (const TexturePrecision textures : {TexturePrecision::device, TexturePrecision::exact}) {
        Scene twice = shared;
        twice.images.push_back(twice.images[0]);
        twice.textures.push_back({1, {}});
        Material& own = twice.materials[0];
        own.emissive_texture.texture = own.occlusion_texture.texture = own.sheen_roughness_texture.texture =
            1;
        for (const gpu::uint slot : {gpu::SLOT_emissive, gpu::SLOT_occlusion, gpu::SLOT_sheen_roughness}) {
            EXPECT_EQ(texelsOnDevice(shared, textures)[slot], gpu::TEXEL_SHARED);
            EXPECT_EQ(texelsOnDevice(twice, textures)[slot], gpu::TEXEL_OWN);
        }
        expectSameImages(shared, twice, litImage(textures));
    }
}

// Compared with an image that has another colour at an unread texel and is therefore sampled.
TEST(TexelSharing, AFactorHasTheBitsOfASampleOfItsColor) {
    constexpr int side = 16;
    std::uint32_t state = 11;
    for (const TexturePrecision textures : {TexturePrecision::device, TexturePrecision::exact})
        for (const bool nearest : {false, true})
            for (int round = 0; round < 3; ++round) {
                std::vector<std::uint8_t> color;
                for (int c = 0; c < 4; ++c) {
                    state = state * 1664525u + 1013904223u;
                    color.push_back(static_cast<std::uint8_t>(state >> 24));
                }
                color[2] |= 128;  // a normal that faces outwards
                TextureImage image{"one", side, side, {}};
                for (int i = 0; i < side * side; ++i)
                    image.rgba.insert(image.rgba.end(), color.begin(), color.end());
                Scene one = turnedSquare(image);
                Sampler sampler;
                sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
                sampler.mipmaps = sampler.mipmaps_linear = false;
                sampler.magnify_linear = sampler.minify_linear = !nearest;
                one.textures[0].sampler = sampler;
                for (const MaterialSlot& slot : materialSlots)
                    one.materials[0].*slot.texture = {0, 0, {0.5, 0, 0.1}, {0, 0.5, 0.1}};
                one.materials[0].clearcoat = one.materials[0].anisotropy = one.materials[0].iridescence =
                    0.7f;
                one.materials[0].sheen_color = glm::vec3(0.7f);
                one.materials[0].sheen_roughness = one.materials[0].diffuse_transmission = 0.7f;
                Scene sampled = one;
                for (std::size_t c = 0; c < 4; ++c)
                    sampled.images[0].rgba[sampled.images[0].rgba.size() - 4 + c] ^= 255;
                const SlotTexels texels = texelsOnDevice(one, textures);
                for (gpu::uint slot = 0; slot < texels.size(); ++slot)
                    if (slot != gpu::SLOT_transmission && slot != gpu::SLOT_thickness) {
                        EXPECT_EQ(texels[slot], gpu::TEXEL_CONSTANT) << slot;
                    }
                SCOPED_TRACE(std::string(nameOf(textures)) + (nearest ? ", nearest, " : ", linear, ") +
                             std::to_string(round));
                expectSameImages(one, sampled, litImage(textures));
            }
}

// A mask of uniform alpha, in every pass that tests it, and with MSAA, whose coverage depends on
// differences of alpha.
TEST(TexelSharing, AMaskOfOneColorCutsAlike) {
    for (const int alpha : {100, 180}) {
        TextureImage image{"one", 4, 4, {}};
        for (int i = 0; i < 16; ++i) image.rgba.insert(image.rgba.end(), {90, 120, 200, std::uint8_t(alpha)});
        Scene one = turnedSquare(image);
        one.textures[0].sampler = {Wrap::clamp_to_edge, Wrap::clamp_to_edge, true, true, false, false};
        Material& m = one.materials[0];
        m.alpha_mode = AlphaMode::mask;
        m.alpha_cutoff = 0.5f;
        m.base_color_texture = {0, 0, {0.5, 0, 0.1}, {0, 0.5, 0.1}};
        m.base_color.a = 0.9f;
        Scene sampled = one;
        sampled.images[0].rgba.back() ^= 255;
        Settings settings = litImage();
        settings.prepass = Switch::on;
        for (const int samples : {1, 4}) {
            settings.msaa = samples;
            settings.alpha_to_coverage = samples > 1;
            SCOPED_TRACE(std::to_string(alpha) + ", " + std::to_string(samples));
            const std::vector<Frame> a = bothPaths(one, settings), b = bothPaths(sampled, settings);
            for (std::size_t i = 0; i < a.size(); ++i) {
                EXPECT_EQ(coveredPixels(a[i]) > 0, alpha == 180);
                expectSameChannels(a[i], b[i]);
            }
        }
    }
}

// Highlights are widened by the mapped normal's change, a difference between pixels.
TEST(TexelSharing, ANormalOfOneColorWidensHighlightsAlike) {
    TextureImage image{"one", 4, 4, {}};
    for (int i = 0; i < 16; ++i) image.rgba.insert(image.rgba.end(), {90, 160, 220, 255});
    Scene one = turnedSquare(image);
    one.textures[0].sampler = {Wrap::clamp_to_edge, Wrap::clamp_to_edge, true, true, false, false};
    one.materials[0].normal_texture = {0, 0, {0.5, 0, 0.1}, {0, 0.5, 0.1}};
    one.materials[0].roughness = 0.1f;
    Primitive& p = one.meshes[0].primitives[0];
    for (std::size_t i = 0; i < p.normals.size(); ++i)  // bent
        p.normals[i] = glm::normalize(p.positions[i] * 0.5f + glm::vec3(0, 0, 1));
    Scene sampled = one;
    sampled.images[0].rgba[sampled.images[0].rgba.size() - 3] ^= 255;
    Settings settings = with(litImage(), "spec-aa on spec-aa-normals mapped");
    expectSameImages(one, sampled, settings);
}

// Roughness and metallic of the other textures' size: channels that both linear 8-bit samples store are
// equal bit for bit. Metallic comes from an sRGB sample filtered in floats, so it differs by 8-bit
// rounding. At half size, magnified texels are smoothed by at most 1/8 of the difference to their
// neighbours; from afar they are equal.
TEST(TexelSharing, PackedTexturesAreNearTheirOwnSamples) {
    struct Case {
        int width, height;
        double min_distance;  // m, of the camera
        double roughness, metallic;
    };
    constexpr double code = 1.0 / 255;
    for (const Case& c :
         {Case{64, 32, 1, 0, 2.5 * code}, Case{32, 16, 1, 0.5, 0.5}, Case{32, 16, 40, 0, 2.5 * code}}) {
        Scene scene = turnedSquare(noiseOf(64, 32, 3));
        scene.images.push_back(noiseOf(64, 32, 4));
        scene.images.push_back(noiseOf(c.width, c.height, 5));
        scene.textures = {{0, {}}, {1, {}}, {2, {}}};
        scene.cameras[0].world_from_camera[3].z = c.min_distance;
        scene.cameras[0].yfov = 2 * std::atan(1 / c.min_distance);
        Material& m = scene.materials[0];
        for (TextureSlot* slot : {&m.base_color_texture, &m.normal_texture, &m.metallic_roughness_texture})
            slot->u.x = slot->v.y = c.min_distance > 1 ? 16 : 1;
        m.base_color_texture.texture = 0;
        m.normal_texture.texture = 1;
        m.metallic_roughness_texture.texture = 2;
        constexpr TexturePrecision packed = TexturePrecision::packed;
        EXPECT_EQ(texelsOnDevice(scene)[gpu::SLOT_metallic_roughness], gpu::TEXEL_OWN);
        EXPECT_EQ(texelsOnDevice(scene, packed)[gpu::SLOT_metallic_roughness], gpu::TEXEL_ALPHAS);
        const std::vector<Frame> apart = bothPaths(scene, litImage()),
                                 together = bothPaths(scene, litImage(packed));
        expectSameChannels(together[0], together[1]);  // both paths
        for (std::size_t i = 0; i < apart.size(); ++i) {
            double worst[2] = {}, sum[2] = {};
            for (const int k : {0, 1}) {
                const Channel channel = k == 0 ? roughness : metallic;
                const Image &a = apart[i].channels.at(channel), &b = together[i].channels.at(channel);
                for (std::size_t p = 0; p < a.data.size(); ++p) {
                    const double off = std::abs(double{a.data[p]} - double{b.data[p]});
                    worst[k] = std::max(worst[k], off);
                    sum[k] += off;
                }
                RecordProperty(std::to_string(c.width) + (k == 0 ? " roughness" : " metallic"),
                               std::to_string(worst[k]));
            }
            EXPECT_LE(worst[0], c.roughness) << c.width << " at " << c.min_distance;
            EXPECT_LE(worst[1], c.metallic) << c.width << " at " << c.min_distance;
            if (c.roughness > 0.1) {
                EXPECT_GT(worst[0], 0.01) << "it was magnified";
            }
            for (const Channel channel : {albedo, normals, emission, occlusion})
                EXPECT_EQ(differingPixels(apart[i], together[i], channel), 0u) << debugMode(channel).name;
        }
    }
}

// Two texels magnified to four along each axis, as their own wrap mode along it has it: those in the middle
// are 1/4 and 3/4 between both, those at an edge are an end's, or 1/4 from the other end's. One pixel a
// texel.
TEST(TexelSharing, PackedTexelsAreMagnifiedAsTheyRepeat) {
    constexpr int side = 4;
    const std::array<std::array<double, 2>, 2> metal{{{0, 200}, {80, 240}}}, rough{{{240, 40}, {120, 0}}};
    for (const Wrap along_s : {Wrap::repeat, Wrap::clamp_to_edge})
        for (const Wrap along_t : {Wrap::repeat, Wrap::clamp_to_edge}) {
            Scene scene = square();
            scene.images = {noiseOf(side, side, 3), noiseOf(side, side, 4), {"two", 2, 2, {}}};
            for (const std::size_t y : {0u, 1u})
                for (const std::size_t x : {0u, 1u})
                    for (const double code : {0.0, rough[y][x], metal[y][x], 255.0})
                        scene.images[2].rgba.push_back(static_cast<std::uint8_t>(code));
            Sampler nearest = scene.textures[0].sampler;
            nearest.wrap_s = along_s;
            nearest.wrap_t = along_t;
            scene.textures = {{0, nearest}, {1, nearest}, {2, nearest}};
            Material& m = scene.materials[0];
            m.base_color_texture.texture = 0;
            m.normal_texture.texture = 1;
            m.metallic_roughness_texture.texture = 2;
            ASSERT_EQ(texelsOnDevice(scene, TexturePrecision::packed)[gpu::SLOT_metallic_roughness],
                      gpu::TEXEL_ALPHAS);
            Renderer renderer(device(), scene, pipelines());
            const Frame drawn = drawnBy(Path::deferred, renderer,
                                        with(smallImage(GBufferEncoding::full), "size 4x4 textures packed"),
                                        {metallic, roughness});
            // Fraction of the second texel.
            const auto second = [](int i, Wrap wrap) {
                const bool repeats = wrap == Wrap::repeat;
                return std::array{repeats ? 0.25 : 0, 0.25, 0.75,
                                  repeats ? 0.75 : 1}[static_cast<std::size_t>(i)];
            };
            const auto magnified = [&](const std::array<std::array<double, 2>, 2>& codes, int x, int y) {
                const double u = second(x, along_s), v = second(y, along_t);
                return ((codes[0][0] * (1 - u) + codes[0][1] * u) * (1 - v) +
                        (codes[1][0] * (1 - u) + codes[1][1] * u) * v) /
                       255;
            };
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    EXPECT_NEAR(drawn.channels.at(metallic).at(x, y, 0), magnified(metal, x, y), 0.51 / 255)
                        << x << ", " << y;
                    EXPECT_NEAR(drawn.channels.at(roughness).at(x, y, 0), magnified(rough, x, y), 0.51 / 255)
                        << x << ", " << y;
                }
        }
}

}  // namespace
}  // namespace diptych::tests
