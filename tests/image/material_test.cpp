// SPDX-License-Identifier: MIT
// Faults that would affect both paths alike. Every property, texture slot and use of texture coordinates
// of a glTF material, cameras, and mirrored or rotated geometry: both paths and the reference match closed
// forms. Light matches the reference in mode scene, which has its own materials, textures and camera.
#include "compare/frames/frame_properties.h"
#include "compare/render/reference_frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/scene_view.h"
#include "tests/image/material_checker.h"
#include "tests/image/scenes.h"
#include "tests/support/srgb.h"

#include <functional>
#include <map>

namespace diptych::tests {
namespace {

const std::vector<Cell>& cellsOf(const CellCamera& camera) {
    return camera.all ? materialCells() : fewMaterialCells();
}

const Scene& sceneOf(const CellCamera& camera) {
    static const Scene all = materialScene(materialCells()), few = materialScene(fewMaterialCells());
    return camera.all ? all : few;
}

const TextureSampling& deviceSampling() {
    static const TextureSampling sampling = probeTextures(device());
    return sampling;
}

CellDecode deviceDecode() {
    return {[](int code) { return double{deviceSampling().srgb[static_cast<std::size_t>(code)]}; },
            [](int code) { return double{deviceSampling().linear[static_cast<std::size_t>(code)]}; }};
}

Settings materialImage(const CellCamera& camera) {
    Settings settings = with(unshadowed(), "gbuffer full assign every");
    settings.camera = camera.name;
    settings.size = {camera.size.x, camera.size.y};
    settings.ambient = {camera.ambient, 0.8f * camera.ambient, 1.5f * camera.ambient};
    return settings;
}

Frame materialReference(const Scene& scene, const CellCamera& camera) {
    SceneViews views(scene);
    Settings settings = with(materialImage(camera), "path reference reference-mode scene");
    return drawReferenceFrame(scene, views.at(viewRequest(settings)), settings, nullptr,
                              untimed(allChannels()));
}

// All cells need the most pipelines: only material channels. A few cells: every channel.
std::vector<Channel> channelsAt(const CellCamera& camera) {
    if (!camera.all) return allChannels();
    std::vector<Channel> modes;
    for (const Channel mode :
         {Channel::lit, Channel::albedo, Channel::normals, Channel::metallic, Channel::roughness,
          Channel::emission, Channel::occlusion, Channel::specular, Channel::material_id, Channel::depth,
          Channel::dielectric_f90, Channel::lightmap, Channel::tangent, Channel::handedness,
          Channel::tangent_normal, Channel::dielectric_f0})
        modes.push_back(mode);
    return modes;
}

std::vector<Frame> materialFrames(const CellCamera& camera) {
    pipelines();
    static auto& renderers = *new std::map<const Scene*, Renderer>;
    const Scene& scene = sceneOf(camera);
    Renderer& renderer = renderers.try_emplace(&scene, device(), scene, pipelines()).first->second;
    std::vector<Frame> frames;
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Settings settings = materialImage(camera);
        settings.path = path;
        frames.push_back(renderer.draw(settings, untimed(channelsAt(camera))));
    }
    return frames;
}

// ---- images ------------------------------------------------------------------------------------------

class MaterialImages : public testing::TestWithParam<CellCamera> {
protected:
    // `channels`: number of channels that must have been checked.
    static void expectRight(const std::string& who, const ChannelChecks& judgement, std::size_t channels) {
        EXPECT_FALSE(anyWrong(judgement)) << who << "\n" << describe(judgement);
        EXPECT_EQ(judgement.size(), channels) << who;
        for (const auto& [mode, evaluated] : judgement)
            EXPECT_GT(evaluated.values, 2000u) << who << ": " << debugMode(mode).name;
        if (std::getenv("DIPTYCH_JUDGEMENTS")) std::cout << who << "\n" << describe(judgement);
    }
};

TEST_P(MaterialImages, AreWhatTheFileSays) {
    const CellCamera& camera = GetParam();
    EXPECT_EQ(sceneOf(camera).notes, std::vector<std::string>{});
    expectRight(
        "reference",
        againstClosedForm(materialReference(sceneOf(camera), camera), cellsOf(camera), camera, exactDecode()),
        19);
    // sRGB as the device decodes it, without further tolerance.
    const Frame truth = materialReference(withDecodedColors(sceneOf(camera), deviceSampling().srgb), camera);
    for (const Frame& frame : materialFrames(camera)) {
        // Channels that the path supports; closed forms cover surfaces, not light.
        const std::size_t light = camera.all ? 1 : 9;
        const std::size_t channels = camera.all                 ? (frame.name == "deferred" ? 13 : 16)
                                     : frame.name == "deferred" ? 24
                                                                : 28;
        expectRight(frame.name, againstClosedForm(frame, cellsOf(camera), camera, deviceDecode()),
                    channels - light);
        expectRight(frame.name + " against the reference",
                    againstReference(frame, truth, cellsOf(camera), camera), channels);
    }
}

INSTANTIATE_TEST_SUITE_P(Cameras, MaterialImages, testing::ValuesIn(cellCameras()),
                         [](const auto& camera) { return std::string(camera.param.name); });

// ---- injected faults ---------------------------------------------------------------------------------

struct MaterialFault {
    std::string name;
    Channel channel;  // where it must be detected
    std::function<void(Scene&)> plant;
};

// The channel that shows a slot's texture.
constexpr std::array<Channel, cellSlots> channelOfSlot{
    Channel::albedo,   Channel::roughness,      Channel::normals,  Channel::occlusion,
    Channel::emission, Channel::dielectric_f90, Channel::specular, Channel::lightmap};

TextureImage& imageOfSlot(Scene& scene, std::size_t slot) {
    return scene.images[static_cast<std::size_t>(scene.textures[slot].image)];
}

// Changes every code of the three colour components.
template <class Change>
void recode(TextureImage& image, const Change& change) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (i % 4 < 3) image.rgba[i] = static_cast<std::uint8_t>(std::lround(255 * change(image.rgba[i])));
}

void swapComponents(TextureImage& image, std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) std::swap(image.rgba[i + a], image.rgba[i + b]);
}

void addSlotFaults(std::vector<MaterialFault>& faults) {
    const auto add = [&](std::size_t slot, const char* what, const auto& change) {
        faults.push_back(
            {"slot " + std::to_string(slot) + ": " + what, channelOfSlot[slot], [slot, change](Scene& s) {
                 for (Material& m : s.materials) change(m.*materialSlots[slot].texture);
             }});
    };
    for (std::size_t slot = 0; slot < cellSlots; ++slot) {
        add(slot, "second UV set ignored", [](TextureSlot& t) { t.texcoord = 0; });
        add(slot, "first UV set ignored", [](TextureSlot& t) { t.texcoord = 1; });
        add(slot, "no texture", [](TextureSlot& t) { t.texture = -1; });
        const bool srgb = materialSlots[slot].srgb;
        faults.push_back(
            {"slot " + std::to_string(slot) + (srgb ? ": not decoded from sRGB" : ": decoded from sRGB"),
             channelOfSlot[slot], [slot, srgb](Scene& s) {
                 // Decoded by the other curve, these codes give the fault's result.
                 recode(imageOfSlot(s, slot), [srgb](int code) {
                     return srgb ? encodedSrgb(code / 255.0) : exactSrgb(static_cast<std::size_t>(code));
                 });
                 if (!srgb && slot == gpu::SLOT_specular)  // only its alpha is read
                     for (std::size_t i = 3; i < imageOfSlot(s, slot).rgba.size(); i += 4) {
                         std::uint8_t& code = imageOfSlot(s, slot).rgba[i];
                         code = static_cast<std::uint8_t>(std::lround(255 * exactSrgb(code)));
                     }
             }});
        if (slot == gpu::SLOT_lightmap) continue;
        add(slot, "rotation the other way", [](TextureSlot& t) { t.u.y *= -1, t.v.x *= -1; });
        add(slot, "offset ignored", [](TextureSlot& t) { t.u.z = t.v.z = 0; });
        add(slot, "transform ignored", [](TextureSlot& t) { t.u = {1, 0, 0}, t.v = {0, 1, 0}; });
    }
    for (const auto& [slot, a, b, channel] : {std::tuple{gpu::SLOT_base_color, 0u, 2u, Channel::albedo},
                                              {gpu::SLOT_metallic_roughness, 0u, 1u, Channel::roughness},
                                              {gpu::SLOT_metallic_roughness, 0u, 2u, Channel::metallic},
                                              {gpu::SLOT_normal, 0u, 1u, Channel::normals},
                                              {gpu::SLOT_occlusion, 0u, 1u, Channel::occlusion},
                                              {gpu::SLOT_occlusion, 0u, 3u, Channel::occlusion},
                                              {gpu::SLOT_emissive, 1u, 2u, Channel::emission},
                                              {gpu::SLOT_specular, 0u, 3u, Channel::dielectric_f90},
                                              {gpu::SLOT_specular_color, 0u, 1u, Channel::specular},
                                              {gpu::SLOT_specular_color, 0u, 3u, Channel::roughness},
                                              {gpu::SLOT_lightmap, 0u, 1u, Channel::lightmap}})
        faults.push_back(
            {"slot " + std::to_string(slot) + ": another component", channel,
             [slot = slot, a = a, b = b](Scene& s) { swapComponents(imageOfSlot(s, slot), a, b); }});
}

void addMaterialFaults(std::vector<MaterialFault>& faults) {
    const auto add = [&](const char* what, Channel channel, void (*change)(Material&)) {
        faults.push_back({what, channel, [change](Scene& s) {
                              for (Material& m : s.materials) change(m);
                          }});
    };
    // Ignored where there is a texture.
    const auto addFactor = [&](const char* what, std::size_t slot, Channel channel,
                               void (*change)(Material&)) {
        faults.push_back({what, channel, [slot, change](Scene& s) {
                              for (Material& m : s.materials)
                                  if ((m.*materialSlots[slot].texture).texture >= 0) change(m);
                          }});
    };
    addFactor("base colour factor ignored", gpu::SLOT_base_color, Channel::albedo,
              [](Material& m) { m.base_color = glm::vec4(1, 1, 1, m.base_color.a); });
    addFactor("alpha factor ignored", gpu::SLOT_base_color, Channel::material_id,
              [](Material& m) { m.base_color.a = 1; });
    addFactor("metallic factor ignored", gpu::SLOT_metallic_roughness, Channel::metallic,
              [](Material& m) { m.metallic = 1; });
    addFactor("roughness factor ignored", gpu::SLOT_metallic_roughness, Channel::roughness,
              [](Material& m) { m.roughness = 1; });
    addFactor("normal scale ignored", gpu::SLOT_normal, Channel::normals,
              [](Material& m) { m.normal_scale = 1; });
    addFactor("occlusion strength ignored", gpu::SLOT_occlusion, Channel::occlusion,
              [](Material& m) { m.occlusion_strength = 1; });
    addFactor("emissive factor ignored", gpu::SLOT_emissive, Channel::emission, [](Material& m) {
        m.emissive = {1, 1, 1};
    });
    add("emissive strength ignored", Channel::emission, [](Material& m) { m.emissive *= 1 / 2.5f; });
    addFactor("specular factor ignored", gpu::SLOT_specular, Channel::dielectric_f90,
              [](Material& m) { m.specular = 1; });
    addFactor("specular colour ignored", gpu::SLOT_specular_color, Channel::specular, [](Material& m) {
        m.specular_color = {1, 1, 1};
    });
    addFactor("lightmap's intensity ignored", gpu::SLOT_lightmap, Channel::lightmap,
              [](Material& m) { m.lightmap_intensity = 1; });
    add("index of refraction ignored", Channel::specular, [](Material& m) { m.ior = 1.5f; });
    add("unlit ignored", Channel::albedo, [](Material& m) { m.unlit = false; });
    add("specular-glossiness ignored", Channel::albedo, [](Material& m) { m.specular_glossiness = false; });
    add("all are specular-glossiness", Channel::albedo, [](Material& m) { m.specular_glossiness = true; });
    add("sides ignored", Channel::material_id, [](Material& m) { m.double_sided = false; });
    add("all are double-sided", Channel::material_id, [](Material& m) { m.double_sided = true; });
    add("mask ignored", Channel::material_id, [](Material& m) { m.alpha_mode = AlphaMode::opaque; });
    // As <= instead of < would.
    add("the cutoff itself is cut out", Channel::material_id,
        [](Material& m) { m.alpha_cutoff = std::nextafter(m.alpha_cutoff, 2.0f); });
}

void addGeometryFaults(std::vector<MaterialFault>& faults) {
    const auto add = [&](const char* what, Channel channel, void (*change)(Primitive&)) {
        faults.push_back({what, channel, [change](Scene& s) {
                              for (Mesh& mesh : s.meshes)
                                  for (Primitive& p : mesh.primitives) change(p);
                          }});
    };
    add("vertex colours ignored", Channel::albedo, [](Primitive& p) { p.colors.clear(); });
    add("vertex colours decoded from sRGB", Channel::albedo, [](Primitive& p) {
        for (glm::vec4& c : p.colors)
            for (int i = 0; i < 3; ++i)
                c[i] = static_cast<float>(exactSrgb(static_cast<std::size_t>(std::lround(255 * c[i]))));
    });
    add("vertex alpha ignored", Channel::material_id, [](Primitive& p) {
        for (glm::vec4& c : p.colors) c.a = 1;
    });
    add("the bitangent's sign ignored", Channel::normals, [](Primitive& p) {
        for (glm::vec4& t : p.tangents) t.w = 1;
    });
    add("a bitangent of the other side", Channel::normals, [](Primitive& p) {
        for (glm::vec4& t : p.tangents) t.w *= -1;
    });
    add("tangents ignored", Channel::normals, [](Primitive& p) {
        for (glm::vec4& t : p.tangents) t = {1, 0, 0, t.w};
    });
    const auto mirrored = [&](const char* what, bool (*which)(const glm::dmat4&),
                              void (*change)(Primitive&)) {
        faults.push_back({what, Channel::normals, [which, change](Scene& s) {
                              for (const Node& node : s.nodes)
                                  if (node.mesh >= 0 && which(node.parent_from_node))
                                      for (Primitive& p :
                                           s.meshes[static_cast<std::size_t>(node.mesh)].primitives)
                                          change(p);
                          }});
    };
    const auto isMirror = [](const glm::dmat4& node) { return glm::determinant(glm::dmat3(node)) < 0; };
    const auto isBehind = [](const glm::dmat4& node) { return node[2].z < 0; };
    mirrored("mirrored normals are not", isMirror, [](Primitive& p) {
        for (glm::vec3& n : p.normals) n = -n;
    });
    mirrored("mirrored bitangents are not", isMirror, [](Primitive& p) {
        for (glm::vec4& t : p.tangents) t.w *= -1;
    });
    mirrored("normals seen from behind are not turned", isBehind, [](Primitive& p) {
        for (glm::vec3& n : p.normals) n = -n;
    });
    const auto camera = [&](const char* what, Channel channel, void (*change)(Camera&)) {
        faults.push_back({what, channel, [change](Scene& s) {
                              for (Camera& c : s.cameras) change(c);
                          }});
    };
    camera("height in place of width", Channel::material_id, [](Camera& c) { c.ymag *= 1.5; });
    camera("perspective in place of parallels", Channel::position, [](Camera& c) { c.orthographic = false; });
}

// The same checks detect each fault in its channel, in a scene that differs from the file only by the
// fault.
TEST(MaterialNegativeControl, EveryFaultIsSeen) {
    std::vector<MaterialFault> faults;
    addSlotFaults(faults);
    addMaterialFaults(faults);
    addGeometryFaults(faults);
    CellCamera camera =
        *std::ranges::find(cellCameras(), std::string("OrthographicLandscape"), &CellCamera::name);
    camera.size = {132, 72};
    camera.ambient = 0;
    const auto evaluated = [&](const Scene& scene) {
        return againstClosedForm(materialReference(scene, camera), fewMaterialCells(), camera, exactDecode());
    };
    const ChannelChecks sound = evaluated(sceneOf(camera));
    EXPECT_FALSE(anyWrong(sound)) << describe(sound);
    for (const MaterialFault& fault : faults) {
        Scene scene = sceneOf(camera);
        fault.plant(scene);
        // Without lightmaps: a lit environment takes longest, and other channels show the same materials.
        if (fault.channel != Channel::lightmap)
            for (Material& m : scene.materials) m.lightmap_texture.texture = -1;
        const ChannelChecks judgement = evaluated(scene);
        EXPECT_GT(judgement.at(fault.channel).wrong, 3u) << fault.name << "\n" << describe(judgement);
    }
}

}  // namespace
}  // namespace diptych::tests
