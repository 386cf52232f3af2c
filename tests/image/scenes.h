// SPDX-License-Identifier: MIT
// Scenes and the device for the image tests.
#pragma once

#include "compare/metrics/channel.h"
#include "compare/render/renderer.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/load.h"
#include "shared/vulkan/device/device.h"
#include "tests/support/campaign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <list>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace diptych::tests {

// With the Khronos validation layers: everything a test renders is validated, and no pipeline is compiled
// twice. validation_test.cpp fails a process that got a message. DIPTYCH_VALIDATE=0 disables the layers,
// as ctest does for some suites (CMakeLists.txt).
inline Device& device() {
    const char* const asked = std::getenv("DIPTYCH_VALIDATE");
    const bool validate = isCampaign() || asked == nullptr || std::string_view(asked) != "0";
    // Never destroyed: at exit the validation layers' own statics may be gone.
    static Device& theDevice = *new Device(DeviceOptions{.choice = "", .validate = validate});
    return theDevice;
}

// Compiled once for everything rendered on device(): on lavapipe compilation takes far longer than a small
// image.
inline std::shared_ptr<PipelineSet> pipelines() {
    static const auto& set = *new std::shared_ptr<PipelineSet>(makePipelineSet(device()));
    return set;
}

inline std::vector<std::string> builtinScenes() {
    std::vector<std::string> names;
    for (const BuiltinName& row : builtinNames()) names.push_back("builtin:" + row.name);
    return names;
}

// Real scenes in a folder beside the repository; tests that need a missing one are skipped.
inline const std::vector<std::string>& assetScenes() {
    static const std::vector<std::string> names{
        "cesium_man/CesiumMan.gltf",
        "circuit_board_lights/DepthOfFieldExample.glb",
        "dutch_ship/dutch_ship_medium_1k.gltf",
        "flight_helmet/FlightHelmet.gltf",
        "living_room/living_room.glb",
        "low_poly_terrain/terrain.glb",
        "morph_stress_test/morph_stress_test.glb",
        "normal_tangent_test/NormalTangentTest.glb",
        "pbr_spheres/PBR_Spheres.glb",
        "sponza/Sponza.gltf",
        "tree/scene.gltf",
        "features/alpha_blend/01_alpha_blend.gltf",
        "features/alpha_mask/01_alpha_mask.gltf",
        "features/box/Box.glb",
        "features/emission_strength/14_emission_strength.gltf",
        "features/glass_table/glass_table.glb",
        "features/interpolation_test/InterpolationTest.gltf",
        "features/lights_punctual/Lights.glb",
        "features/multi_uv_test/MultiUVTest.gltf",
        "features/node_hierarchy/02_node_hierarchy.gltf",
        "features/single_vs_double_sided/01_single_vs_double_sided.gltf",
        "features/sparse_accessor/SimpleSparseAccessor.gltf",
        "features/texture_transform_test/TextureTransformTest.gltf",
        "features/triangle/Triangle.gltf",
        "features/triangle_without_indices/TriangleWithoutIndices.gltf",
        "features/unlit_test/UnlitTest.gltf",
        "features/vertex_color_test/VertexColorTest.gltf"};
    return names;
}

inline std::filesystem::path assets() {
    return std::filesystem::path(DIPTYCH_SOURCE_DIR) / ".." / "shared" / "assets" / "scenes";
}

// Real scenes with material extensions, in a folder beside the others.
inline const std::vector<std::string>& layeredScenes() {
    static const std::vector<std::string> names{
        "AnisotropyBarnLamp/AnisotropyBarnLamp.gltf",
        "AnisotropyRotationTest/AnisotropyRotationTest.glb",
        "AnisotropyStrengthTest/AnisotropyStrengthTest.glb",
        "AttenuationTest/AttenuationTest.glb",
        "ClearCoatCarPaint/ClearCoatCarPaint.glb",
        "ClearCoatTest/ClearCoatTest.glb",
        "DiffuseTransmissionTeacup/DiffuseTransmissionTeacup.gltf",
        "DispersionTest/dispersion-test.glb",
        "GlassHurricaneCandleHolder/GlassHurricaneCandleHolder.gltf",
        "IridescenceLamp/IridescenceLamp.gltf",
        "IridescenceMetallicSpheres/IridescenceMetallicSpheres.gltf",
        "MaterialsVariantsShoe/MaterialsVariantsShoe.gltf",
        "PotOfCoals/glTFPotOfCoals.gltf",
        "SheenChair/SheenChair.gltf",
        "SheenTestGrid/SheenTestGrid.glb",
        "SpecGlossVsMetalRough/SpecGlossVsMetalRough.gltf",
        "SpecularTest/SpecularTest.glb",
        "ToyCar/ToyCar.gltf",
        "TransmissionRoughnessTest/TransmissionRoughnessTest.glb",
        "TransmissionThinwallTestGrid/TransmissionThinwallTestGrid.glb",
        "WebpBoxTextured/box-textured-separate.gltf"};
    return names;
}

inline std::filesystem::path layeredAssets() {
    return assets().parent_path() / "layered";
}

// A name that GoogleTest accepts: letters and digits, the rest as _.
inline std::string testName(const std::string& text) {
    std::string name = text;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

// A TEST for each scene of a table: a built-in one, or a file of assets() or layeredAssets().
class SceneTest : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        if (!isBuiltin() && !std::filesystem::exists(name()))
            GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no " << name() << "; the built-in scenes prove it";
    }
    static bool isBuiltin() { return GetParam().starts_with("builtin:"); }
    // As loadScene() takes it.
    static std::string name() {
        if (isBuiltin()) return GetParam();
        const std::filesystem::path layered = layeredAssets() / GetParam();
        return (std::filesystem::exists(layered) ? layered : assets() / GetParam()).string();
    }
};

// Its name: builtin:NAME without the prefix, or a file's stem.
inline std::string sceneName(const testing::TestParamInfo<std::string>& scene) {
    const std::string& name = scene.param;
    return testName(name.starts_with("builtin:") ? name.substr(8)
                                                 : std::filesystem::path(name).stem().string());
}

inline std::vector<Channel> allChannels() {
    std::vector<Channel> modes;
    for (const DebugMode& mode : debugModes()) modes.push_back(mode.channel);
    return modes;
}

inline RenderOptions untimed(std::vector<Channel> channels = {Channel::lit}) {
    RenderOptions options;
    options.channels = std::move(channels);
    options.runs = 0;
    return options;
}

// One Frame per Settings, in order, on device().
inline std::vector<Frame> drawAll(const Scene& scene, const std::vector<Settings>& settings,
                                  const RenderOptions& options) {
    Renderer renderer(device(), scene, pipelines());
    std::vector<Frame> frames;
    for (const Settings& each : settings) frames.push_back(renderer.draw(each, options));
    return frames;
}

// The Frame of one path, untimed. Fewer channels need fewer pipelines.
inline Frame drawnBy(Path path, Renderer& renderer, Settings settings,
                     const std::vector<Channel>& channels = allChannels()) {
    RenderOptions options = untimed(channels);
    options.through_gbuffer = true;
    settings.path = path;
    return renderer.draw(settings, options);
}

// The Frames of deferred and of forward+.
inline std::vector<Frame> bothPaths(Renderer& renderer, const Settings& settings,
                                    const std::vector<Channel>& channels = allChannels()) {
    std::vector<Frame> frames;
    for (const Path path : {Path::deferred, Path::forward_plus})
        frames.push_back(drawnBy(path, renderer, settings, channels));
    return frames;
}
inline std::vector<Frame> bothPaths(const Scene& scene, const Settings& settings,
                                    const std::vector<Channel>& channels = allChannels()) {
    Renderer renderer(device(), scene, pipelines());
    return bothPaths(renderer, settings, channels);
}

// A scene on device(), uploaded once for all tests, with cached Frames of both paths.
class UploadedScene {
public:
    explicit UploadedScene(const std::string& name)
        : scene(loadScene(name)), renderer(device(), scene, pipelines()) {}

    // As bothPaths() above; rendered once for equal Settings.
    const std::vector<Frame>& bothPaths(const Settings& settings) {
        for (const auto& [drawn, frames] : frames_)
            if (drawn == settings) return frames;
        return frames_.emplace_back(settings, tests::bothPaths(renderer, settings)).second;
    }

    const Scene scene;
    Renderer renderer;

private:
    std::deque<std::pair<Settings, std::vector<Frame>>> frames_;
};

// The scene of a name or a file, in a cache of the most recently requested.
inline UploadedScene& uploaded(const std::string& name) {
    constexpr std::size_t max = 12;
    pipelines();  // created first, with the device, because they must outlive the scenes
    static auto& scenes =
        *new std::list<std::pair<std::string, UploadedScene>>;  // most recently requested first
    const auto found = std::ranges::find(scenes, name, [](const auto& entry) { return entry.first; });
    if (found != scenes.end()) {
        scenes.splice(scenes.begin(), scenes, found);
    } else {
        if (scenes.size() == max) scenes.pop_back();
        scenes.emplace_front(std::piecewise_construct, std::forward_as_tuple(name),
                             std::forward_as_tuple(name));
    }
    return scenes.front().second;
}

// A sun whose light travels along `direction`.
inline Light sunAlong(const glm::dvec3& direction, float intensity = Light().intensity) {
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = direction;
    sun.intensity = intensity;
    return sun;
}

// Default settings of tests: shadows would take a third more time where they are not the subject.
inline Settings unshadowed() {
    Settings settings;
    settings.shadows = Shadows::off;
    return settings;
}

// Common settings for asset scenes, so that the suites share Frames.
inline Settings assetImage(GBufferEncoding gbuffer) {
    Settings settings = unshadowed();
    settings.gbuffer = gbuffer;
    settings.size = {320, 180};
    settings.lights = "point:12,spot:4";
    return settings;
}

// `settings` with `options` and their values: "shadows evsm shadow-size 256".
inline Settings with(Settings settings, const std::string& options) {
    std::istringstream words(options);
    for (std::string option, value; words >> option >> value;) settings.set(option, value);
    return settings;
}

inline Settings smallImage(GBufferEncoding gbuffer) {
    Settings settings = unshadowed();
    settings.gbuffer = gbuffer;
    settings.size = {160, 90};
    return settings;
}

// Number of differing pixels: bitwise on a CPU device. A GPU's compiler may contract two shaders
// differently: there, values within 16 ULP of the pixel's largest component are equal.
inline std::size_t differingPixels(const Image& a, const Image& b, bool bits = device().profile().bit_exact) {
    if (a.width != b.width || a.height != b.height || a.components != b.components) return a.pixels() + 1;
    return unequalPixels(a, b, bits ? 0 : gpuUlps);
}

inline std::size_t differingPixels(const Frame& a, const Frame& b, Channel channel,
                                   bool bits = device().profile().bit_exact) {
    return differingPixels(a.channels.at(channel), b.channels.at(channel), bits);
}

// Every common channel must be the same, and there must be at least `min` of them.
inline void expectSameChannels(const Frame& a, const Frame& b, std::size_t min = 14) {
    std::size_t compared = 0;
    for (const auto& [mode, image] : a.channels) {
        const Image* const other = findChannel(b, mode);
        if (!other) continue;
        ++compared;
        EXPECT_EQ(differingPixels(image, *other), 0u) << "channel " << debugMode(mode).name;
    }
    EXPECT_GE(compared, min);
}

inline std::size_t coveredPixels(const Frame& frame) {
    const Image& ids = frame.channels.at(Channel::material_id);
    return static_cast<std::size_t>(
        std::count_if(ids.data.begin(), ids.data.end(), [](float id) { return id >= 0; }));
}

}  // namespace diptych::tests
