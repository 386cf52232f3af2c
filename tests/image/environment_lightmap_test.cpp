// SPDX-License-Identifier: MIT
// Environment light beside lightmaps, in both paths and the reference.
#include "shared/contract/debug_mode.h"
#include "tests/image/skies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace diptych::tests {
namespace {

// Frames of builtin:lightmaps under a uniform sky alone. The first tile's material has no lightmap, the
// last one's is unlit. The wall's lightmap is set to black, which still counts as a lightmap.
constexpr float unmapped = 4, unlit = 8;
class LightmapsUnderSky {
public:
    LightmapsUnderSky() {
        scene.environment = constantSky(0.5f);
        scene.lights.clear();
        Material& wall = scene.materials[1];
        const auto image = static_cast<std::size_t>(
            scene.textures[static_cast<std::size_t>(wall.lightmap_texture.texture)].image);
        std::ranges::fill(scene.images[image].rgba32, 0.0f);
    }
    std::vector<Frame> paths(GBufferEncoding gbuffer) const {
        Settings settings = underSky({64, 36});
        settings.gbuffer = gbuffer;
        return bothPaths(scene, settings, shown);
    }
    Frame reference() const {
        Settings settings = underSky({64, 36});
        settings.path = Path::reference;
        return drawAll(scene, {settings}, untimed(shown)).front();
    }

    Scene scene = loadScene("builtin:lightmaps");
};

// A base lit by a lightmap gets no environment light; every other base does. In every encoding.
TEST(EnvironmentLight, BasesWithALightmapTakeNothingOfIt) {
    LightmapsUnderSky lightmaps;
    std::set<float> mapped;
    const auto check = [&](const std::vector<Frame>& frames, const std::string& what) {
        for (const Frame& frame : frames)
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 64; ++x) {
                    const float id = colorAt(frame, Channel::material_id, x, y).x;
                    if (id < 0 || id == unlit) continue;
                    ASSERT_GT(colorAt(frame, Channel::lit_specular, x, y).g, 1e-3f)
                        << frame.name << what << id;
                    if (id == unmapped)
                        ASSERT_GT(colorAt(frame, Channel::lit_diffuse, x, y).g, 0.1f) << frame.name << what;
                    else
                        ASSERT_EQ(colorAt(frame, Channel::lit_diffuse, x, y), glm::vec3(0))
                            << frame.name << what << id;
                    mapped.insert(id);
                }
    };
    for (const GBufferEncoding gbuffer : {GBufferEncoding::compact, GBufferEncoding::standard})
        check(lightmaps.paths(gbuffer), fmt::format(" {} ", nameOf(gbuffer)));
    const std::vector<Frame> full = lightmaps.paths(GBufferEncoding::full);
    check(full, " full ");
    EXPECT_EQ(mapped.size(), 8u);
    for (const Channel channel : shown)
        EXPECT_EQ(differingPixels(full[0], full[1], channel), 0u) << debugMode(channel).name;
    // The floor's lightmap exceeds the range of 9.9.9.e5.
    lightmaps.scene.materials[0].lightmap_intensity = 1e4f;
    check(lightmaps.paths(GBufferEncoding::standard), " wide ");
}

// The reference samples until its 95 % confidence interval is within 1 %. The worst of
// some thousand pixels may deviate by three times that (one deviated by 2.1 %).
TEST(EnvironmentLight, WithLightmapsIsTheReferences) {
    const LightmapsUnderSky lightmaps;
    const Frame truth = lightmaps.reference();
    for (const Frame& frame : lightmaps.paths(GBufferEncoding::full))
        for (const Channel channel :
             {Channel::lit_diffuse, Channel::lit_specular, Channel::lit_environment}) {
            double sum = 0, off = 0;
            for (std::size_t i = 0; i < truth.channels.at(channel).data.size(); ++i) {
                const double a = frame.channels.at(channel).data[i], b = truth.channels.at(channel).data[i];
                EXPECT_NEAR(a, b, 0.03 * b + 1e-6) << frame.name << debugMode(channel).name << i;
                sum += b;
                off += a - b;
            }
            EXPECT_GT(sum, 1) << debugMode(channel).name;
            EXPECT_LT(std::abs(off), 1e-3 * sum) << frame.name << debugMode(channel).name;
        }
}

}  // namespace
}  // namespace diptych::tests
