// SPDX-License-Identifier: MIT
// Clear coats, anisotropy, sheens and thin films (builtin:layers) in both paths: bit for bit with a float32
// G-buffer under every kind of light, within their bits when packed, and as the reference integrates them. A
// material whose factors are 0 is the base to the bit.
#include "shared/frame/supported_channels.h"
#include "shared/material/gbuffer_layout.h"
#include "tests/bench/environment_errors.h"
#include "tests/image/square.h"
#include "tests/image/verdicts.h"
#include "tests/support/layer_table.h"

#include <fmt/format.h>

#include <array>
#include <functional>

namespace diptych::tests {
namespace {

// Layers of builtin:layers.
constexpr gpu::uint of_scene =
    gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE;

// Every kind of light at once.
Scene litByAll() {
    Scene scene = loadScene("builtin:layers");
    scene.environment = environment_errors::lampSky(32);
    return scene;
}
void removeLayers(Material& m) {
    for (const TestedLayer& layer : testedLayers()) layer.factors[0].set(m, glm::vec3(0));
}
Settings inAllLight(GBufferEncoding gbuffer) {
    Settings settings = with(smallImage(gbuffer), "ambient 0.1,0.2,0.3 lights point:3,spot:2 shadows pcf");
    return settings;
}

// The light of coats and sheens is a part of the light of all lobes, and 0 without them.
void expectPartsOfLobes(const Frame& frame) {
    const auto pixel = [&](Channel mode, std::size_t i) {
        const float* const p = frame.channels.at(mode).pixel(i);
        return glm::vec3(p[0], p[1], p[2]);
    };
    std::size_t without = 0, with = 0;
    for (std::size_t i = 0; i < frame.channels.at(Channel::lit).pixels(); ++i) {
        const glm::vec3 sheen = pixel(Channel::lit_sheen, i),
                        of_layers = sheen + pixel(Channel::lit_clearcoat, i),
                        all = pixel(Channel::lit_specular, i) + pixel(Channel::lit_ambient, i);
        if (pixel(Channel::sheen_color, i) == glm::vec3(0)) {
            ++without;
            EXPECT_EQ(sheen, glm::vec3(0)) << frame.name << " " << i;
        } else {
            with += sheen != glm::vec3(0);
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(sheen[c], 0) << frame.name << " " << i;
            EXPECT_LE(of_layers[c], all[c] * 1.00001f) << frame.name << " " << i;
        }
    }
    EXPECT_GT(without, 1000u);
    EXPECT_GT(with, 500u);
}

// Light of every kind, and what lights and samples change of a surface.
std::vector<Channel> lightChannels() {
    std::vector<Channel> channels{litModes.begin(), litModes.end()};
    channels.insert(channels.end(), {Channel::material_id, Channel::roughness, Channel::clearcoat_roughness,
                                     Channel::sheen_color});
    return channels;
}

void expectBitEqual(const std::function<void(Settings&)>& change,
                    const std::vector<Channel>& channels = lightChannels()) {
    const Scene scene = litByAll();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = inAllLight(GBufferEncoding::full);
    change(settings);
    const std::vector<Frame> frames = bothPaths(renderer, settings, channels);
    for (const Channel mode : channels) {
        if (layerOf(mode) == 0) continue;
        ASSERT_EQ(frames[0].channels.contains(mode), (layerOf(mode) & of_scene) != 0) << debugMode(mode).name;
    }
    expectPartsOfLobes(frames[1]);
    expectSameChannels(frames[0], frames[1], std::min<std::size_t>(30, channels.size() / 2));
    EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u) << settings.msaa;
    EXPECT_EQ(frames[1].counters.nonfinite_pixels, 0u) << settings.msaa;
}

TEST(Layers, BothPathsAreBitEqualInAllLight) {
    expectBitEqual([](Settings& s) { s.haze = true; }, allChannels());
}

TEST(Layers, BothPathsAreBitEqualUnderEverySetting) {
    expectBitEqual([](Settings& s) {
        s.lights = "area:3";
        s.multiscatter = Multiscatter::fdez;
    });
    expectBitEqual([](Settings& s) {
        s.assign = Assignment::tiled;
        s.lighting = Lighting::compute;
        s.spec_aa = true;
        s.spec_aa_normals = SpecularNormals::mapped;
    });
}

TEST(Layers, BothPathsAreBitEqualWithSamples) {
    expectBitEqual(
        [](Settings& s) {
            s.msaa = 4;
            s.ibl = Ibl::sampled;
        },
        allChannels());
}

TEST(Layers, PackedPassesByItsBits) {
    const Scene scene = litByAll();
    Renderer renderer(device(), scene, pipelines());
    for (const GBufferEncoding gbuffer : {GBufferEncoding::standard, GBufferEncoding::compact})
        EXPECT_EQ(failuresOf(verdictOn(bothPaths(renderer, inAllLight(gbuffer)), scene)), "");
}

// Surfaces with layers that the forward shader draws after deferred lighting equal forward+'s, whatever the
// G-buffer's encoding; the others are decoded as ever.
void expectExactByForward(int msaa) {
    Scene scene = litByAll();
    for (std::size_t i = 0; i < scene.materials.size(); i += 3) removeLayers(scene.materials[i]);
    Renderer renderer(device(), scene, pipelines());
    Settings settings = inAllLight(GBufferEncoding::full);
    settings.msaa = msaa;
    settings.layers = Layers::forward;
    const std::vector<Channel> channels = msaa == 1 ? allChannels() : lightChannels();
    const std::vector<Frame> full = bothPaths(renderer, settings, channels);
    expectSameChannels(full[0], full[1], std::min<std::size_t>(30, channels.size() / 2));
    EXPECT_EQ(full[0].counters.unreproduced_pixels, 0u);
    settings.gbuffer = GBufferEncoding::compact;
    const std::vector<Frame> packed = bothPaths(renderer, settings, channels);
    std::size_t layered = 0, differing = 0;
    const Image &ids = packed[0].channels.at(Channel::material_id),
                &deferred = packed[0].channels.at(Channel::lit),
                &forward = packed[1].channels.at(Channel::lit);
    for (std::size_t i = 0; i < ids.pixels(); ++i) {
        if (ids.data[i] < 0 || layersOf(scene.materials[static_cast<std::size_t>(ids.data[i])]) == 0)
            continue;
        ++layered;
        differing += !std::equal(deferred.pixel(i), deferred.pixel(i) + 3, forward.pixel(i));
    }
    EXPECT_GT(layered, 1000u);
    if (msaa == 1) {
        EXPECT_EQ(differing, 0u);
    }
    EXPECT_EQ(failuresOf(verdictOn(packed, scene)), "");
}

TEST(Layers, DrawnByTheForwardShaderTheyAreExact) {
    expectExactByForward(1);
}

TEST(Layers, DrawnByTheForwardShaderTheyAreExactWithSamples) {
    expectExactByForward(4);
}

TEST(Layers, AFactorOfZeroIsTheBaseToTheBit) {
    Scene plain = litByAll(), zero = plain;
    for (std::size_t i = 1; i < plain.materials.size(); ++i) {
        Material& m = plain.materials[i];
        removeLayers(m);
        removeLayers(zero.materials[i]);
        m.clearcoat_roughness = m.sheen_roughness = m.iridescence_thickness_max = 0;
        for (std::size_t slot = gpu::SLOT_clearcoat; slot < gpu::SLOT_COUNT; ++slot)
            m.*materialSlots[slot].texture = {};
    }
    // One ball with all layers keeps them in the scene; in `none` there are none.
    for (Scene* scene : {&plain, &zero}) {
        Material& m = scene->materials[0];
        m.clearcoat = m.anisotropy = m.iridescence = 1;
        m.sheen_color = {1, 1, 1};
    }
    Scene none = plain;
    removeLayers(none.materials[0]);
    const Settings settings = inAllLight(GBufferEncoding::standard);
    const std::vector<Frame> with = bothPaths(zero, settings), without = bothPaths(plain, settings),
                             base = bothPaths(none, settings);
    for (std::size_t path = 0; path < 2; ++path) {
        expectSameChannels(with[path], without[path], 30);
        const Image &ids = base[path].channels.at(Channel::material_id),
                    &there = base[path].channels.at(Channel::lit),
                    &here = with[path].channels.at(Channel::lit);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < ids.pixels(); ++i)
            if (ids.data[i] != 0) differing += !std::equal(there.pixel(i), there.pixel(i) + 3, here.pixel(i));
        EXPECT_EQ(differing, 0u) << "layers elsewhere in the scene change a surface without them";
        for (const auto& [mode, image] : base[path].channels)
            EXPECT_EQ(layerOf(mode), 0u) << debugMode(mode).name;
    }
    const GBufferLayout layout =
        gbufferLayout(GBufferEncoding::full, requirements(none, poseAt(none, 0)), false);
    for (gpu::uint i = gpu::GBUFFER_LAYERS; i < gpu::GBUFFER_SHADED; ++i)
        EXPECT_EQ(layout.formats[i], VK_FORMAT_UNDEFINED) << gbufferAttachmentNames[i];
}

// Under uniform radiance 1 no surface reflects more.
TEST(Layers, AWhiteFurnaceHolds) {
    Scene scene = loadScene("builtin:layers");
    for (Material& m : scene.materials) {
        m.base_color = {1, 1, 1, 1};
        m.metallic = 1;  // appendix B's base under a layer does not conserve energy
        m.sheen_roughness =
            std::max(m.sheen_roughness, 0.5f);  // smoother sheens reflect more at grazing views
        m.sheen_roughness_texture = {};
    }
    Settings settings = smallImage(GBufferEncoding::full);
    settings.ambient = {1, 1, 1};
    for (const Frame& frame :
         bothPaths(scene, settings, {Channel::lit_ambient, Channel::clearcoat, Channel::material_id})) {
        const Image& all = frame.channels.at(Channel::lit_ambient);
        std::size_t coated = 0;
        for (std::size_t i = 0; i < all.pixels(); ++i) {
            if (frame.channels.at(Channel::material_id).data[i] < 0) continue;
            EXPECT_LE(all.pixel(i)[0], 1 + 1e-4f);
            coated += frame.channels.at(Channel::clearcoat).data[i] > 0.5f;
        }
        EXPECT_GT(coated, 500u) << frame.name;
    }
}

// ---- textures ----------------------------------------------------------------------------------------

class EachLayer : public testing::TestWithParam<TestedLayer> {};

// The scenes of Layers, Panes and Refraction, which draw them in every light, encoding and way.
TEST_P(EachLayer, IsInABuiltinScene) {
    gpu::uint layers = 0;
    for (const char* scene : {"builtin:layers", "builtin:transmission"})
        for (const Material& m : loadScene(scene).materials) layers |= layersOf(m);
    EXPECT_NE(layers & GetParam().bit, 0u);
}

// The square with the layer, and an alpha of its own in each texel.
Scene layeredSquare(const TestedLayer& layer) {
    Scene scene = square();
    for (std::size_t i = 0; i < 4; ++i)
        scene.images[0].rgba[4 * i + 3] = static_cast<std::uint8_t>(255 - 51 * i);
    scene.textures[0].sampler.wrap_s = Wrap::repeat;
    scene.materials[0] = layer.typical();
    return scene;
}
// The texel of the square at a corner pixel. `swapped`: left and right.
glm::dvec4 cornerTexel(const Scene& scene, int x, int y, bool swapped = false) {
    const auto at = static_cast<std::size_t>(4 * (2 * (y / 2) + (swapped ? 3 - x : x) / 2));
    const std::vector<std::uint8_t>& rgba = scene.images[0].rgba;
    return glm::dvec4(rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]) / 255.0;
}

// Every slot reads its components of its texture, each by another UV set and transform than the next slot.
TEST_P(EachLayer, ReadsItsTextures) {
    const TestedLayer& layer = GetParam();
    Scene scene = layeredSquare(layer);
    Material& m = scene.materials[0];
    struct Read {
        int texcoord;
        double offset;
        bool swapped;
    };
    constexpr std::array reads{Read{0, 0, false}, Read{1, 0, true}, Read{0, 0.5, true}, Read{1, 0.5, false}};
    for (std::size_t first = 0; first < reads.size(); ++first) {
        const auto readOf = [&](std::size_t i) { return reads[(first + i) % reads.size()]; };
        for (std::size_t i = 0; i < layer.textures.size(); ++i)
            layer.textures[i].of(m) = {0, readOf(i).texcoord, {1, 0, readOf(i).offset}, {0, 1, 0}};
        for (const Frame& frame : draw(scene))
            for (const int y : {0, 3})
                for (const int x : {0, 3}) {
                    const auto texel = [&](std::size_t i) {
                        return cornerTexel(scene, x, y, readOf(i).swapped);
                    };
                    const auto expectShown = [&](Channel mode, const glm::dvec3& expected, float tolerance) {
                        expectColor(colorAt(frame, mode, x, y), glm::vec3(expected), tolerance,
                                    fmt::format("{} {} {} {}", frame.name, debugMode(mode).name, x, y));
                    };
                    const bool there = layer.shown(layer.textures[0], m, texel(0)) != glm::dvec3(0);
                    for (std::size_t i = 0; i < layer.textures.size(); ++i) {
                        const LayerTexture& t = layer.textures[i];
                        const glm::dvec3 direction = glm::dvec3(texel(i)) * 2.0 - 1.0;
                        if (t.components.empty()) {
                            expectShown(t.channel, there ? glm::normalize(direction) : glm::dvec3(0), 1e-6f);
                            expectShown(Channel::normals, {0, 0, 1}, 0);
                            continue;
                        }
                        const glm::dvec3 shown = there ? layer.shown(t, m, texel(i)) : glm::dvec3(0);
                        expectShown(t.channel, shown,
                                    t.components == "rgb"
                                        ? srgbTexel
                                        : float32 * std::max(1.0f, static_cast<float>(shown.x)));
                        if (t.channel != Channel::anisotropy) continue;
                        const double turn =
                            double{m.anisotropy_rotation} + std::atan2(direction.y, direction.x);
                        const glm::dvec3 along(std::cos(turn), std::sin(turn), 0),
                            seen(colorAt(frame, Channel::anisotropy_direction, x, y));
                        EXPECT_NEAR(std::abs(glm::dot(seen, along)), there ? 1 : 0, float32)  // either sign
                            << frame.name;
                    }
                    for (const LayerFactor& f : layer.factors)
                        if (f.channel)
                            expectShown(*f.channel, there ? glm::dvec3(f.of(m)) : glm::dvec3(0), float32);
                }
    }
}

// A texture that is 0 on the left half alone removes it there alone.
TEST_P(EachLayer, ATexelOfZeroIsTheBaseToTheBit) {
    Scene plain = square();
    Material& m = plain.materials[0];
    m.metallic = 0.5f;
    m.roughness = 0.5f;
    plain.images[0].rgba = {0, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 255, 255, 255, 255};
    plain.lights = {sunAlong(glm::normalize(glm::dvec3(-0.3, -0.2, -1)))};
    Scene layered = plain;
    layered.materials[0] = GetParam().typical(m);
    for (const LayerTexture& t : GetParam().textures) t.of(layered.materials[0]).texture = 0;
    Settings settings = with(smallImage(GBufferEncoding::full), "size 4x4 ambient 0.1,0.2,0.3");
    std::vector<Channel> own{Channel::lit_transmission};
    for (const Channel mode : GetParam().channels()) own.push_back(mode);
    std::vector<Channel> channels = own;
    channels.push_back(Channel::lit);
    static const std::vector<Frame> without = bothPaths(plain, settings, {Channel::lit});
    const std::vector<Frame> with = bothPaths(layered, settings, channels);
    for (std::size_t path = 0; path < 2; ++path)
        for (const int x : {0, 1, 2, 3}) {
            const bool there =
                colorAt(with[path], Channel::lit, x, 1) != colorAt(without[path], Channel::lit, x, 1);
            EXPECT_EQ(there, x > 1) << with[path].name;
            for (const Channel mode : own)
                if (x < 2 && with[path].channels.contains(mode)) {
                    EXPECT_EQ(colorAt(with[path], mode, x, 1), glm::vec3(0)) << debugMode(mode).name;
                }
        }
    for (const Frame& frame : with)
        for (const Channel mode : GetParam().channels())
            EXPECT_EQ(frame.channels.contains(mode),
                      unsupportedReason(frame.settings, debugMode(mode)).empty())
                << frame.name << " " << debugMode(mode).name;
}

INSTANTIATE_TEST_SUITE_P(Layers, EachLayer, testing::ValuesIn(testedLayers()), layerName);

// A volume absorbs over the thickness, which its texture and its node scale.
TEST(Layers, LeavesHaveAVolume) {
    Scene leaf = layeredSquare(testedLayers(gpu::LAYER_DIFFUSE_TRANSMISSION)[0]);
    Material& m = leaf.materials[0];
    m.thickness = 0.75f;
    m.thickness_texture.texture = 0;
    m.attenuation_distance = 0.5f;
    m.attenuation_color = {0.5f, 0.9f, 1};
    leaf.nodes[0].parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(2));
    for (const Frame& f : draw(leaf))
        for (const int y : {0, 3})
            for (const int x : {0, 3}) {
                const auto lengths = static_cast<float>(3 * cornerTexel(leaf, x, y).g);
                expectColor(colorAt(f, Channel::diffuse_transmission_color, x, y),
                            m.diffuse_transmission_color * glm::pow(m.attenuation_color, glm::vec3(lengths)),
                            srgbTexel, f.name);
            }
}

// A rotation turns counter-clockwise from the tangent to the bitangent.
TEST(Layers, TheDirectionIsRotated) {
    for (const float degrees : {30.0f, 200.0f}) {
        Scene scene = square();
        scene.materials[0].anisotropy = 1;
        scene.materials[0].anisotropy_rotation = glm::radians(degrees);
        for (const Frame& frame : draw(scene)) {
            const glm::vec3 seen = colorAt(frame, Channel::anisotropy_direction, 1, 1),
                            along(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)), 0);
            EXPECT_NEAR(std::abs(glm::dot(seen, along)), 1, float32) << frame.name << " " << degrees;
        }
    }
}

// Punctual lights and an environment, against the reference's integrals of captured surfaces.
TEST(Layers, TheReferenceAgrees) {
    Scene scene = loadScene("builtin:layers");
    Settings settings = smallImage(GBufferEncoding::full);
    settings.assign = Assignment::every;
    Renderer renderer(device(), scene, pipelines());
    Settings truth = settings;
    truth.path = Path::reference;
    const Frame reference = renderer.draw(truth, untimed(allChannels()));
    for (const Frame& path : bothPaths(renderer, settings)) {
        const Coverage covered = coverage(reference, path);
        ASSERT_GT(covered.count, 3000u);
        for (const DebugMode& m : debugModes()) {
            const Channel mode = m.channel;
            if (mode != Channel::lit && mode != Channel::lit_specular && (layerOf(mode) & of_scene) == 0)
                continue;
            const ChannelStats stats = channelStats(m.error_kind, m.kind, reference.channels.at(mode),
                                                    path.channels.at(mode), covered);
            EXPECT_LE(stats.p999, 1e-4) << path.name << " " << m.name << ", max " << stats.max;
        }
    }
}

}  // namespace
}  // namespace diptych::tests
