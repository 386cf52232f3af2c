// SPDX-License-Identifier: MIT
// Relighting from channels: a path's own channels reproduce its lit.
#include "compare/render/channel_shading.h"
#include "compare/frames/frame_properties.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr Channel litTerms[] = {
    Channel::lit_diffuse,   Channel::lit_specular,    Channel::lit_ambient,       Channel::lit_haze,
    Channel::transmittance, Channel::lit_environment, Channel::shadow_visibility, Channel::local_visibility};

std::vector<Channel> shadedChannels() {
    std::vector<Channel> modes(surfaceChannels().begin(), surfaceChannels().end());
    modes.push_back(Channel::lit);
    modes.push_back(Channel::material_id);
    modes.push_back(Channel::lightmapped);
    for (const Channel term : litTerms) modes.push_back(term);
    return modes;
}

class ChannelShadingOf : public testing::TestWithParam<std::string> {};

TEST_P(ChannelShadingOf, OwnChannelsGiveOwnLit) {
    const Scene scene = loadScene(GetParam());
    Renderer renderer(device(), scene, pipelines());
    for (const GBufferEncoding encoding : {GBufferEncoding::full, GBufferEncoding::compact})
        for (const Path path : drawn_paths) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(path), nameOf(encoding)));
            Settings settings = smallImage(encoding);
            settings.path = path;
            settings.ambient = {0.1f, 0.2f, 0.3f};
            const Frame frame = drawnBy(path, renderer, settings, shadedChannels());
            SurfaceImages images(device(), settings.size);
            for (std::size_t i = 0; i < surfaceChannels().size(); ++i) images.set(0, i, frame);
            ChannelShading shading = renderer.shadeChannels(settings, images);
            const ChannelTerms own_terms = shading.terms(0);
            const Image shaded = shading.shade(0);
            const Image& own = frame.channels.at(Channel::lit);
            std::size_t differ = 0;
            for (std::size_t p = 0; p < own.pixels(); ++p)
                differ += !std::equal(own.pixel(p), own.pixel(p) + 3, shaded.pixel(p));
            const Image* const made[] = {&own_terms.diffuse,           &own_terms.specular,
                                         &own_terms.ambient,           &own_terms.haze,
                                         &own_terms.transmittance,     &own_terms.environment,
                                         &own_terms.shadow_visibility, &own_terms.local_visibility};
            for (std::size_t t = 0; t < std::size(litTerms); ++t) {
                const Image& theirs = frame.channels.at(litTerms[t]);
                for (std::size_t i = 0; i < theirs.data.size(); ++i)
                    differ += theirs.data[i] != std::as_const(made[t]->data)[i];
            }
            // On devices that are not bit-exact the two pipelines may round differently.
            EXPECT_EQ(device().profile().bit_exact ? differ : 0u, 0u) << "of " << own.pixels();
        }
    EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
}

INSTANTIATE_TEST_SUITE_P(Builtin, ChannelShadingOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:cutout",
                                         "builtin:glass", "builtin:dielectrics", "builtin:areas",
                                         "builtin:lightmaps"),
                         sceneName);

}  // namespace
}  // namespace diptych::tests
