// SPDX-License-Identifier: MIT
// Layered materials (builtin:layers) in both paths: bit for bit with a float32 G-buffer under every
// kind of light, within their bits when packed, and as the reference integrates them. A material whose
// factors are 0 is the base to the bit.
#include "compare/verdict/pair_reports.h"
#include "tests/bench/environment_errors.h"
#include "tests/image/square.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

constexpr int litCoat = static_cast<int>(gpu::DEBUG_lit_clearcoat),
              litLobe = static_cast<int>(gpu::DEBUG_lit_specular),
              litSheen = static_cast<int>(gpu::DEBUG_lit_sheen),
              litAmbient = static_cast<int>(gpu::DEBUG_lit_ambient);

void removeLayers(Material& m) {
    m.clearcoat = m.anisotropy = m.iridescence = m.clearcoat_roughness = 0;
    m.sheen_color = glm::vec3(0);
    m.clearcoat_texture = m.clearcoat_roughness_texture = m.clearcoat_normal_texture = {};
    m.anisotropy_texture = m.sheen_color_texture = m.sheen_roughness_texture = {};
    m.iridescence_texture = m.iridescence_thickness_texture = {};
}

// Every kind of light at once.
Scene litByAll() {
    Scene scene = loadScene("builtin:layers");
    scene.environment = environment_errors::lampSky(32);
    return scene;
}
Settings inAllLight(GBufferEncoding gbuffer) {
    Settings settings = smallPicture(gbuffer);
    settings.ambient = {0.1f, 0.2f, 0.3f};
    settings.lights = "point:3,spot:2";
    settings.shadows = Shadows::pcf;
    return settings;
}

std::vector<Settings> settingsOfLayers() {
    std::vector<Settings> all(4, inAllLight(GBufferEncoding::full));
    all[0].haze = true;
    all[1].msaa = 4;
    all[1].ibl = Ibl::sampled;
    all[2].lights = "area:3";
    all[2].multiscatter = Multiscatter::fdez;
    all[3].assign = Assignment::tiled;
    all[3].lighting = Lighting::compute;
    all[3].spec_aa = true;
    all[3].spec_aa_normals = SpecularNormals::mapped;
    return all;
}

TEST(Layers, BothPathsAreBitEqualInAllLight) {
    const Scene scene = litByAll();
    Renderer renderer(device(), scene, pipelines());
    for (const Settings& settings : settingsOfLayers()) {
        const std::vector<Frame> frames = bothPaths(renderer, settings);
        for (const DebugMode& mode : debugModes()) {
            if (layerOf(mode.number) == 0) continue;
            ASSERT_TRUE(frames[0].channels.contains(mode.number)) << mode.name;
        }
        expectSameChannels(frames[0], frames[1], 30);
        EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u) << settings.msaa;
        EXPECT_EQ(frames[1].counters.nonfinite_pixels, 0u) << settings.msaa;
    }
}

TEST(Layers, PackedPassesByItsBits) {
    const Scene scene = litByAll();
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    Renderer renderer(device(), scene, pipelines());
    for (const GBufferEncoding gbuffer : {GBufferEncoding::standard, GBufferEncoding::compact}) {
        const Report report =
            makeReport(bothPaths(renderer, inAllLight(gbuffer)), {needs, needs},
                       {device().info().name, device().info().driver, device().info().type}, {});
        for (const ChannelDiff& channel : report.comparisons[0].channels)
            EXPECT_NE(channel.verdict, Verdict::fail) << channel.mode->name << ": " << channel.reason;
    }
}

// Surfaces with layers that the forward shader draws after deferred lighting equal forward+'s, whatever the
// G-buffer's encoding; the others are decoded as ever.
TEST(Layers, DrawnByTheForwardShaderTheyAreExact) {
    Scene scene = litByAll();
    for (std::size_t i = 0; i < scene.materials.size(); i += 3) removeLayers(scene.materials[i]);
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    Renderer renderer(device(), scene, pipelines());
    std::vector<Settings> all(2, inAllLight(GBufferEncoding::full));
    all[1].msaa = 4;
    for (Settings& settings : all) {
        settings.layers = Layers::forward;
        const std::vector<Frame> full = bothPaths(renderer, settings);
        expectSameChannels(full[0], full[1], 30);
        EXPECT_EQ(full[0].counters.unreproduced_pixels, 0u);
        settings.gbuffer = GBufferEncoding::compact;
        const std::vector<Frame> packed = bothPaths(renderer, settings);
        std::size_t layered = 0, differing = 0;
        const Image &ids = packed[0].channels.at(8), &deferred = packed[0].channels.at(lit),
                    &forward = packed[1].channels.at(lit);
        for (std::size_t i = 0; i < ids.pixels(); ++i) {
            if (ids.data[i] < 0 || layersOf(scene.materials[static_cast<std::size_t>(ids.data[i])]) == 0)
                continue;
            ++layered;
            differing += !std::equal(deferred.pixel(i), deferred.pixel(i) + 3, forward.pixel(i));
        }
        EXPECT_GT(layered, 1000u);
        if (settings.msaa == 1) {
            EXPECT_EQ(differing, 0u);
        }
        const Report report = makeReport(
            packed, {needs, needs}, {device().info().name, device().info().driver, device().info().type}, {});
        for (const ChannelDiff& channel : report.comparisons[0].channels)
            EXPECT_NE(channel.verdict, Verdict::fail) << channel.mode->name << ": " << channel.reason;
    }
}

// The same balls in the same scene, which has layers elsewhere.
TEST(Layers, AFactorOfZeroIsTheBaseToTheBit) {
    Scene plain = litByAll(), zero = plain;
    for (std::size_t i = 1; i < plain.materials.size(); ++i) {
        Material& z = zero.materials[i];
        removeLayers(plain.materials[i]);
        z.clearcoat = z.anisotropy = z.iridescence = 0;
        z.sheen_color = glm::vec3(0);
    }
    // One ball keeps the layers in the scene; in `none` there are none.
    for (Scene* scene : {&plain, &zero}) {
        Material& m = scene->materials[0];
        m.clearcoat = m.anisotropy = m.iridescence = 1;
        m.sheen_color = glm::vec3(1);
    }
    Scene none = plain;
    removeLayers(none.materials[0]);
    const Settings settings = inAllLight(GBufferEncoding::standard);
    const std::vector<Frame> with = bothPaths(zero, settings), without = bothPaths(plain, settings),
                             base = bothPaths(none, settings);
    for (std::size_t path = 0; path < 2; ++path) {
        expectSameChannels(with[path], without[path], 30);
        const Image &ids = base[path].channels.at(8), &there = base[path].channels.at(lit),
                    &here = with[path].channels.at(lit);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < ids.pixels(); ++i)
            if (ids.data[i] != 0) differing += !std::equal(there.pixel(i), there.pixel(i) + 3, here.pixel(i));
        EXPECT_EQ(differing, 0u) << "layers elsewhere in the scene change a surface without them";
        EXPECT_EQ(base[path].channels.count(litCoat) + base[path].channels.count(litSheen), 0u);
    }
}

// Under uniform radiance 1 no surface reflects more.
TEST(Layers, AWhiteFurnaceHolds) {
    Scene scene = loadScene("builtin:layers");
    for (Material& m : scene.materials) {
        m.base_color = {1, 1, 1, 1};
        m.metallic = 1;     // appendix B's base under a layer does not conserve energy
        m.iridescence = 0;  // the extension's colour matching exceeds 1
        // Smoother sheens reflect more than they receive at grazing views.
        if (m.sheen_color != glm::vec3(0)) m.sheen_roughness = std::max(m.sheen_roughness, 0.5f);
    }
    Settings settings = smallPicture(GBufferEncoding::full);
    settings.ambient = {1, 1, 1};
    constexpr int coat = static_cast<int>(gpu::DEBUG_clearcoat),
                  ids = static_cast<int>(gpu::DEBUG_material_id);
    for (const Frame& frame : bothPaths(scene, settings, {litAmbient, coat, ids})) {
        const Image& all = frame.channels.at(litAmbient);
        std::size_t coated = 0;
        for (std::size_t i = 0; i < all.pixels(); ++i) {
            if (frame.channels.at(ids).data[i] < 0) continue;
            EXPECT_LE(all.pixel(i)[0], 1 + 1e-4f);
            coated += frame.channels.at(coat).data[i] > 0.5f;
        }
        EXPECT_GT(coated, 500u) << frame.name;
    }
}

// Each slot reads its own component of its own texture, by the first or second UV set, moved by a transform.
TEST(Layers, EverySlotReadsItsTexture) {
    // Texels of square(): red, green above blue, grey; by the row and column of a pixel.
    const auto texel = [](int x, int y) {
        const glm::vec3 of[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::vec3(128.0f / 255)};
        return of[2 * (y / 2) + x / 2];
    };
    struct Read {
        int texcoord;
        double offset;
        bool swapped;  // left and right
    };
    for (const Read& read : {Read{0, 0, false}, Read{1, 0, true}, Read{0, 0.5, true}, Read{1, 0.5, false}}) {
        TextureSlot slot;
        slot.texture = 0;
        slot.texcoord = read.texcoord;
        slot.u.z = read.offset;
        Scene scene = square();
        scene.textures[0].sampler.wrap_s = Wrap::repeat;
        Material& m = scene.materials[0];
        m.clearcoat = 0.5f;
        m.clearcoat_roughness = 0.8f;
        m.anisotropy = 0.6f;
        m.sheen_color = {0.5f, 0.25f, 1};
        m.sheen_roughness = 0.8f;
        m.iridescence = 0.5f;
        m.iridescence_ior = 1.5f;
        m.iridescence_thickness_least = 200;
        m.iridescence_thickness_most = 600;
        const auto at = [&](const Frame& frame, gpu::uint mode, int x, int y) {
            return colorAt(frame, static_cast<int>(mode), x, y);
        };
        const auto each = [&](TextureSlot Material::*of, const auto& check) {
            Scene one = scene;
            one.materials[0].*of = slot;
            for (const Frame& frame : draw(one))
                for (const int y : {0, 3})
                    for (const int x : {0, 3}) check(frame, x, y, texel(read.swapped ? 3 - x : x, y));
        };
        each(&Material::clearcoat_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            EXPECT_NEAR(at(f, gpu::DEBUG_clearcoat, x, y).x, 0.5f * t.r, float32) << f.name;
            EXPECT_NEAR(at(f, gpu::DEBUG_clearcoat_roughness, x, y).x, t.r > 0 ? 0.8f : 0, float32) << f.name;
        });
        each(&Material::clearcoat_roughness_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            EXPECT_NEAR(at(f, gpu::DEBUG_clearcoat_roughness, x, y).x, 0.8f * t.g, float32) << f.name;
        });
        each(&Material::clearcoat_normal_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            expectColor(at(f, gpu::DEBUG_clearcoat_normal, x, y), glm::normalize(t * 2.0f - 1.0f), 1e-6f,
                        f.name);
            expectColor(at(f, gpu::DEBUG_normals, x, y), {0, 0, 1}, 0, f.name);
        });
        each(&Material::sheen_color_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            const auto linear = [](float s) {
                return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
            };
            const glm::vec3 color =
                glm::vec3(0.5f, 0.25f, 1) * glm::vec3(linear(t.r), linear(t.g), linear(t.b));
            expectColor(at(f, gpu::DEBUG_sheen_color, x, y), color, 1e-6f, f.name);
            EXPECT_NEAR(at(f, gpu::DEBUG_sheen_roughness, x, y).x, 0.8f, float32) << f.name;
        });
        each(&Material::iridescence_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            EXPECT_NEAR(at(f, gpu::DEBUG_iridescence, x, y).x, 0.5f * t.r, float32) << f.name;
            EXPECT_NEAR(at(f, gpu::DEBUG_iridescence_ior, x, y).x, t.r > 0 ? 1.5f : 0, float32) << f.name;
            EXPECT_NEAR(at(f, gpu::DEBUG_iridescence_thickness, x, y).x, t.r > 0 ? 600 : 0, 1e-3f) << f.name;
        });
        each(&Material::iridescence_thickness_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            EXPECT_NEAR(at(f, gpu::DEBUG_iridescence_thickness, x, y).x, 200 + 400 * t.g, 1e-3f) << f.name;
        });
        each(&Material::anisotropy_texture, [&](const Frame& f, int x, int y, const glm::vec3& t) {
            EXPECT_NEAR(at(f, gpu::DEBUG_anisotropy, x, y).x, 0.6f * t.b, float32) << f.name;
            const glm::vec3 along = glm::normalize(glm::vec3(t.r * 2 - 1, t.g * 2 - 1, 0)),
                            seen = at(f, gpu::DEBUG_anisotropy_direction, x, y);
            // Either sign.
            EXPECT_NEAR(std::abs(glm::dot(seen, along)), t.b > 0 ? 1 : 0, float32) << f.name;
        });
    }
}

// Of both the colour's image, whose alpha is the roughness, and an image of its own.
TEST(Layers, ASheensRoughnessIsTheAlphaOfItsTexture) {
    for (const bool shared : {true, false}) {
        Scene scene = square();
        TextureImage& image = scene.images[0];
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
            image.rgba[i] = static_cast<std::uint8_t>(60 + 40 * (i / 4));
        Material& m = scene.materials[0];
        m.base_color_texture = {};
        m.sheen_color = glm::vec3(1);
        m.sheen_roughness = 0.5f;
        m.sheen_roughness_texture.texture = 0;
        if (shared) m.sheen_color_texture.texture = 0;
        for (const Frame& frame : draw(scene))
            for (const int y : {0, 3})
                for (const int x : {0, 3}) {
                    const float alpha = static_cast<float>(60 + 40 * (2 * (y / 2) + x / 2)) / 255;
                    EXPECT_NEAR(colorAt(frame, static_cast<int>(gpu::DEBUG_sheen_roughness), x, y).x,
                                0.5f * alpha, float32)
                        << frame.name << " " << shared;
                }
    }
}

// A rotation turns counter-clockwise from the tangent to the bitangent.
TEST(Layers, TheDirectionIsRotated) {
    for (const float degrees : {0.0f, 30.0f, 90.0f, 200.0f}) {
        Scene scene = square();
        scene.materials[0].anisotropy = 1;
        scene.materials[0].anisotropy_rotation = glm::radians(degrees);
        for (const Frame& frame : draw(scene)) {
            const glm::vec3 seen = colorAt(frame, static_cast<int>(gpu::DEBUG_anisotropy_direction), 1, 1),
                            along(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)), 0);
            EXPECT_NEAR(std::abs(glm::dot(seen, along)), 1, float32) << frame.name << " " << degrees;
        }
    }
}

// Punctual lights and an environment, against the reference's integrals of captured surfaces.
TEST(Layers, TheReferenceAgrees) {
    Scene scene = loadScene("builtin:layers");
    Settings settings = smallPicture(GBufferEncoding::full);
    settings.assign = Assignment::every;
    Renderer renderer(device(), scene, pipelines());
    RenderOptions options;
    options.channels = allChannels();
    options.runs = 0;
    Settings truth = settings;
    truth.path = Path::reference;
    const Frame reference = renderer.draw(truth, options);
    for (const Frame& path : bothPaths(renderer, settings)) {
        const Coverage covered = coverage(reference, path);
        ASSERT_GT(covered.count, 3000u);
        for (const int mode : {lit, litLobe, litCoat, litSheen, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69}) {
            const DebugMode& m = debugMode(mode);
            const ChannelStats stats =
                channelStats(m.metric, m.kind, reference.channels.at(mode), path.channels.at(mode), covered);
            EXPECT_LE(stats.p999, 1e-4) << path.name << " " << m.name << ", max " << stats.max;
        }
    }
}

}  // namespace
}  // namespace diptych::tests
