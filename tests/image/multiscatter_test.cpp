// SPDX-License-Identifier: MIT
// Multiple scattering between microfacets in both paths: the white furnace, and the reference.
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"

#include <map>

namespace diptych::tests {
namespace {

constexpr std::array compensations{Multiscatter::off, Multiscatter::energy, Multiscatter::fdez};

Settings inFurnace(Multiscatter multiscatter) {
    Settings settings = with(smallImage(GBufferEncoding::full), "size 240x60 ambient 1,1,1");
    settings.multiscatter = multiscatter;
    return settings;
}

// builtin:furnace: white spheres, dielectrics below and metals above, at roughness 0, 0.1 ... 1, seen from
// every angle, under uniform radiance 1.
TEST(MultiscatterFurnace, MetalsVanishAndDielectricsConserve) {
    UploadedScene& scene = uploaded("builtin:furnace");
    for (const Multiscatter each : compensations)
        for (const Frame& frame :
             bothPaths(scene.renderer, inFurnace(each),
                       {Channel::lit_ambient, Channel::metallic, Channel::material_id})) {
            const std::string name = frame.name + " " + std::string(nameOf(each));
            float min = 2, max = 0, dielectric = 0;
            const Image &radiance = frame.channels.at(Channel::lit_ambient),
                        &id = frame.channels.at(Channel::material_id);
            for (std::size_t i = 0; i < id.data.size(); ++i) {
                if (id.data[i] < 0) continue;
                const float value = radiance.data[3 * i];
                if (frame.channels.at(Channel::metallic).data[i] == 0) {
                    dielectric = std::max(dielectric, value);
                    if (each != Multiscatter::off) {
                        EXPECT_NEAR(value, 1, 2e-3) << name << " " << i;
                    }
                    continue;
                }
                min = std::min(min, value), max = std::max(max, value);
            }
            if (each == Multiscatter::off) {
                EXPECT_LE(max, 1.0f) << name;
                EXPECT_LT(min, 0.5f) << name << ": a rough metal keeps over half of it";
                EXPECT_GT(dielectric, 1.2f) << name << ": appendix B has come to conserve energy";
            } else {
                EXPECT_NEAR(min, 1, 2e-3) << name;
                EXPECT_NEAR(max, 1, 2e-3) << name;
            }
        }
}

// The table also exists for direct light alone.
TEST(MultiscatterDirect, NeedsNoAmbientLight) {
    UploadedScene& scene = uploaded("builtin:normals");
    const auto drawn = [&](Multiscatter multiscatter, float radiance) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.multiscatter = multiscatter;
        settings.ambient = {radiance, radiance, radiance};
        return bothPaths(scene.renderer, settings, {Channel::lit_specular});
    };
    const std::vector<Frame> off = drawn(Multiscatter::off, 0);
    for (const Multiscatter each : {Multiscatter::energy, Multiscatter::fdez}) {
        const std::vector<Frame> without = drawn(each, 0), with = drawn(each, 0.5f);
        for (std::size_t path = 0; path < without.size(); ++path) {
            const Image& direct = without[path].channels.at(Channel::lit_specular);
            EXPECT_EQ(differingPixels(direct, with[path].channels.at(Channel::lit_specular)), 0u)
                << nameOf(each);
            EXPECT_GT(differingPixels(direct, off[path].channels.at(Channel::lit_specular)), 100u)
                << nameOf(each);
        }
    }
}

// Every channel of light against the reference's own integrals, in scenes with mixed materials, coloured
// layers and textures. The table's E is within 2e-5 of the integral. For a smooth metal's compensation,
// and for a base under a layer that reflects nearly everything, that is up to 5e-3 of 1 - E.
class MultiscatterReference : public testing::TestWithParam<std::tuple<const char*, Multiscatter>> {};

TEST_P(MultiscatterReference, BothPathsAreTheReference) {
    const auto [name, multiscatter] = GetParam();
    const bool gallery = std::string(name) == "builtin:gallery";
    UploadedScene& scene = uploaded(name);
    Settings settings = with(smallImage(GBufferEncoding::full), "shadows off size 96x54 ambient 0.3,0.4,0.5");
    settings.multiscatter = multiscatter;
    Settings asked = settings;
    asked.path = Path::reference;
    const RenderOptions options =
        untimed({Channel::lit_ambient, Channel::lit_specular, Channel::lit_diffuse, Channel::material_id});
    const Frame reference = scene.renderer.draw(asked, options);
    for (const Frame& path : bothPaths(scene.renderer, settings, options.channels)) {
        const Coverage covered = coverage(reference, path);
        for (const Channel channel : {Channel::lit_ambient, Channel::lit_specular, Channel::lit_diffuse}) {
            const DebugMode& mode = debugMode(channel);
            const ChannelStats stats =
                channelStats(mode.error_kind, mode.kind, reference.channels.at(channel),
                             path.channels.at(channel), covered);
            EXPECT_LE(stats.p99, channel == Channel::lit_ambient || gallery ? 1e-4 : 1.2e-3)
                << path.name << " " << mode.name << ", max " << stats.max;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, MultiscatterReference,
                         testing::Combine(testing::Values("builtin:gallery", "builtin:dielectrics",
                                                          "builtin:normals"),
                                          testing::Values(Multiscatter::energy, Multiscatter::fdez)),
                         [](const auto& test) {
                             return testName(std::string(nameOf(std::get<1>(test.param)))) + "_" +
                                    testName(std::string(std::get<0>(test.param)).substr(8));
                         });

}  // namespace
}  // namespace diptych::tests
