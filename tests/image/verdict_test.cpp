// SPDX-License-Identifier: MIT
// The verdict that users see: changing one constant in one path's scene fails the channel that shows it.
// That every built-in scene passes is in parity_test.cpp.
#include "shared/scene/load.h"
#include "tests/image/verdicts.h"

#include <ostream>
#include <set>

namespace diptych::tests {
namespace {

std::set<std::string> scenesIn(const std::filesystem::path& folder) {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            found.insert(std::filesystem::relative(entry.path(), folder).string());
    return found;
}

// A scene added to the folder must be rendered, too.
TEST(AssetScenes, AreAllThatThereAre) {
    if (!std::filesystem::exists(assets())) GTEST_SKIP() << "NO ASSETS at " << assets();
    EXPECT_EQ(scenesIn(assets()), std::set<std::string>(assetScenes().begin(), assetScenes().end()));
}

TEST(AssetScenes, AreAllLayeredOnesExceptOneThatIsRefused) {
    if (!std::filesystem::exists(layeredAssets())) GTEST_SKIP() << "NO ASSETS at " << layeredAssets();
    std::set<std::string> found = scenesIn(layeredAssets());
    const std::string refused = "AnisotropyBarnLampBasisU/AnisotropyBarnLamp.gltf";
    EXPECT_EQ(found.erase(refused), 1u);
    EXPECT_EQ(found, std::set<std::string>(layeredScenes().begin(), layeredScenes().end()));
    EXPECT_THROW(loadScene((layeredAssets() / refused).string()), std::runtime_error) << "KTX2 textures";
}

// A changed constant for each channel's tolerance.
struct NegativeControl {
    const char* channel;
    void (*change)(Scene&);
    Rgb ambient = {};
    const char* scene = "builtin:gallery";
    int shadows = -1;  // number of casting point and spot lights, besides the sun; below 0: none cast
    float haze = 0;    // density; 0: none
};

void PrintTo(const NegativeControl& control, std::ostream* out) {
    *out << control.channel;
}

class VerdictNegativeControl : public testing::TestWithParam<NegativeControl> {};

TEST_P(VerdictNegativeControl, Fails) {
    UploadedScene& scene = uploaded(GetParam().scene);
    Scene changed = scene.scene;
    GetParam().change(changed);
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.ambient = GetParam().ambient;
    if (GetParam().shadows >= 0) {
        settings.shadows = Shadows::pcf;
        settings.shadow_lights = GetParam().shadows;
    }
    settings.haze = GetParam().haze > 0;
    if (settings.haze) settings.haze_density = GetParam().haze;
    std::vector<Frame> frames = scene.bothPaths(settings);
    Renderer renderer(device(), changed, pipelines());
    frames[1] = drawnBy(Path::forward_plus, renderer, settings);
    const Report report = verdictOn(std::move(frames), scene.scene);
    EXPECT_FALSE(report.passed());
    bool failed = false;
    for (const ChannelDiff& channel : report.comparisons.at(0).channels)
        if (channel.mode->name == GetParam().channel) failed = channel.verdict == Verdict::fail;
    EXPECT_TRUE(failed) << GetParam().channel << " must fail; these did:\n" << failuresOf(report);
}

void nudge(Scene& scene) {
    for (Node& node : scene.nodes) node.parent_from_node[3].x += 1e-4;
}

// Every change is about twice the tolerance of the standard G-buffer.
const NegativeControl negativeControls[] = {
    {"lit", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }},
    {"albedo",
     [](Scene& s) {
         for (Material& m : s.materials) m.base_color.r = m.base_color.r * 0.98f - 0.001f;
     }},
    {"normals",
     [](Scene& s) {
         for (Mesh& mesh : s.meshes)
             for (Primitive& p : mesh.primitives)
                 for (auto& n : p.normals) n.x += 2e-4f;
     }},
    {"metallic",
     [](Scene& s) {
         for (Material& m : s.materials) m.metallic = std::abs(m.metallic - 0.004f);
     }},
    {"roughness",
     [](Scene& s) {
         for (Material& m : s.materials) m.roughness -= 0.0003f;
     }},
    {"emission",
     [](Scene& s) {
         for (Material& m : s.materials) m.emissive *= 1.005f;
     }},
    {"occlusion",
     [](Scene& s) {
         for (Material& m : s.materials) m.occlusion_strength *= 0.9f;
     }},
    {"specular",
     [](Scene& s) {
         for (Material& m : s.materials) m.ior += 0.1f;
     }},
    {"material_id",
     [](Scene& s) {
         for (Mesh& mesh : s.meshes)
             for (Primitive& p : mesh.primitives)
                 p.material = (p.material + 1) % static_cast<int>(s.materials.size());
     }},
    {"depth", nudge},
    {"position", nudge},
    {"geometric_normal",
     [](Scene& s) {
         for (Node& n : s.nodes) n.parent_from_node[0].y += 1e-3;
     }},
    {"lit_diffuse", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }},
    {"lit_specular", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }},
    {"lit_ambient",
     [](Scene& s) {
         for (Material& m : s.materials) m.base_color *= 0.97f;
     },
     {0.2f, 0.2f, 0.2f}},
    {"dielectric_f90",
     [](Scene& s) {
         for (Material& m : s.materials) m.specular *= 0.99f;
     }},
    {"dielectric_f0",
     [](Scene& s) {
         for (Material& m : s.materials) m.ior += 0.2f;
     }},
    {"lightmap",
     [](Scene& s) {
         for (Material& m : s.materials) m.lightmap_intensity *= 1.005f;
     },
     {},
     "builtin:lightmaps"},
    {"lightmapped",
     [](Scene& s) {
         for (Material& m : s.materials) m.lightmap_texture.texture = -1;
     },
     {},
     "builtin:lightmaps"},
    {"shadow_visibility",
     [](Scene& s) {
         for (Light& light : s.lights)
             light.direction = glm::normalize(light.direction + glm::dvec3(1e-3, 0, 0));
     },
     {},
     "builtin:suns",
     0},
    {"local_visibility",
     [](Scene& s) {
         for (Light& light : s.lights) light.position.x += 1e-3;
     },
     {},
     "builtin:points",
     1},
    {"lit_haze",
     [](Scene& s) {
         for (Light& light : s.lights) light.intensity *= 1.0001f;
     },
     {},
     "builtin:glass",
     -1,
     5},  // no sunlight passes through thicker air
    {"transmittance", nudge, {}, "builtin:suns", -1, 1000},
    {"lit_environment",
     [](Scene& s) {
         s.environment = Environment{"sky", Image(8, 4, 3, 1e-4f)};
     }},
    {"lit_clearcoat", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }, {}, "builtin:layers"},
    {"clearcoat",
     [](Scene& s) {
         for (Material& m : s.materials) m.clearcoat *= 0.999f;
     },
     {},
     "builtin:layers"},
    {"clearcoat_roughness",
     [](Scene& s) {
         for (Material& m : s.materials) m.clearcoat_roughness *= 0.999f;
     },
     {},
     "builtin:layers"},
    {"clearcoat_normal",
     [](Scene& s) {
         for (Mesh& mesh : s.meshes)
             for (Primitive& p : mesh.primitives)
                 for (auto& n : p.normals) n.x += 2e-4f;
     },
     {},
     "builtin:layers"},
    {"anisotropy",
     [](Scene& s) {
         for (Material& m : s.materials) m.anisotropy *= 0.999f;
     },
     {},
     "builtin:layers"},
    {"anisotropy_direction",
     [](Scene& s) {
         for (Material& m : s.materials) m.anisotropy_rotation += 3e-4f;
     },
     {},
     "builtin:layers"},
    {"lit_sheen", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }, {}, "builtin:layers"},
    {"sheen_color",
     [](Scene& s) {
         for (Material& m : s.materials) m.sheen_color *= 0.99f;
     },
     {},
     "builtin:layers"},
    {"sheen_roughness",
     [](Scene& s) {
         for (Material& m : s.materials) m.sheen_roughness *= 0.995f;
     },
     {},
     "builtin:layers"},
    {"iridescence",
     [](Scene& s) {
         for (Material& m : s.materials) m.iridescence *= 0.995f;
     },
     {},
     "builtin:layers"},
    {"iridescence_ior",
     [](Scene& s) {
         for (Material& m : s.materials) m.iridescence_ior += 0.01f;
     },
     {},
     "builtin:layers"},
    {"iridescence_thickness",
     [](Scene& s) {
         for (Material& m : s.materials) m.iridescence_thickness_max *= 1.002f;
     },
     {},
     "builtin:layers"},
    {"lit_transmission", [](Scene& s) { s.lights[0].intensity *= 1.0001f; }, {}, "builtin:transmission"},
    // Drawn by one shader over either path: their tolerance is 0.
    {"transmission",
     [](Scene& s) {
         for (Material& m : s.materials) m.transmission *= 0.9999f;
     },
     {},
     "builtin:transmission"},
    {"transmission_thickness",
     [](Scene& s) {
         for (Material& m : s.materials) m.thickness *= 0.9999f;
     },
     {},
     "builtin:transmission"},
    {"attenuation_color",
     [](Scene& s) {
         for (Material& m : s.materials) m.attenuation_color *= 0.9999f;
     },
     {},
     "builtin:transmission"},
    {"attenuation_distance",
     [](Scene& s) {
         for (Material& m : s.materials) m.attenuation_distance *= 1.0001f;
     },
     {},
     "builtin:transmission"},
    {"dispersion",
     [](Scene& s) {
         for (Material& m : s.materials) m.dispersion *= 1.0001f;
     },
     {},
     "builtin:transmission"},
    {"diffuse_transmission",
     [](Scene& s) {
         for (Material& m : s.materials) m.diffuse_transmission *= 0.99f;
     },
     {},
     "builtin:transmission"},
    {"diffuse_transmission_color",
     [](Scene& s) {
         for (Material& m : s.materials) m.diffuse_transmission_color *= 0.98f;
     },
     {},
     "builtin:transmission"},
};

INSTANTIATE_TEST_SUITE_P(Channels, VerdictNegativeControl, testing::ValuesIn(negativeControls),
                         [](const auto& control) { return std::string(control.param.channel); });

// Every channel that both paths support has a negative control here.
TEST(VerdictNegativeControls, CoverEverySharedChannel) {
    for (const DebugMode& mode : debugModes()) {
        const bool controlled =
            std::any_of(std::begin(negativeControls), std::end(negativeControls),
                        [&](const NegativeControl& control) { return control.channel == mode.name; });
        EXPECT_EQ(controlled, mode.supported_by == SupportedBy::both) << mode.name;
    }
}

// A lit that the capture does not reproduce, or that is not finite, fails regardless of the channels.
TEST(Verdict, AnUnreproducedLitFails) {
    const Scene scene = loadScene("builtin:triangle");
    std::vector<Frame> frames = bothPaths(scene, smallImage(GBufferEncoding::standard));
    EXPECT_TRUE(verdictOn(frames, scene).passed());
    frames[0].counters.unreproduced_pixels = 1;
    EXPECT_FALSE(verdictOn(frames, scene).passed());
}

}  // namespace
}  // namespace diptych::tests
