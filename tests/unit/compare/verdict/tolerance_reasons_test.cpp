// SPDX-License-Identifier: MIT
// The reason of each channel's tolerance, whole.
#include "one_pixel_pair.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

namespace diptych {
namespace {

// Reasons of a pair's tolerances, each with its channels.
std::map<std::string, std::string> reasonsOf(const FramePair& pair) {
    std::map<std::string, std::string> reasons;
    for (const DebugMode& mode : debugModes())
        if (pair.baseline.channels.contains(mode.channel) && pair.test.channels.contains(mode.channel))
            reasons[derivedTolerance(mode, pair).because] += std::string(mode.name) + " ";
    return reasons;
}
using Reasons = std::map<std::string, std::string>;

TEST(ToleranceReasons, EachChannelHasItsReason) {
    OnePixelPair p;
    p.needs.surface_layers = ~0u;
    p.needs.emission = p.needs.lightmap = p.needs.dielectric_specular = true;
    p.needs.min_emission = p.needs.max_emission = p.needs.max_lightmap = 1;
    EXPECT_EQ(
        reasonsOf(p.encoding(GBufferEncoding::standard).pair()),
        (Reasons{
            {"(n - 1) / (n + 1) in 9 bits: half a step, 0.5 / 510, of the largest index n, 0.5",
             "iridescence_ior "},
            {"both paths use one list, chosen by the same function of pixel and depth",
             "light_count list_overflow "},
            {"forward+ was not rendered through this G-buffer's encoding, so it explains no difference",
             "lit lit_diffuse lit_specular lit_ambient lit_environment lit_clearcoat lit_sheen "
             "lit_transmission "},
            {"half a step of 12 bits, 0.5 / 4095", "roughness clearcoat clearcoat_roughness anisotropy "},
            {"half a step of 8 bits, 0.5 / 255",
             "metallic occlusion dielectric_f90 sheen_roughness iridescence diffuse_transmission "},
            {"half a step of a 9-bit mantissa whose top bit is set, 0.5 / 256", "emission lightmap "},
            {"half a step of a half's 10-bit mantissa, 2^-11", "iridescence_thickness "},
            {"it is stored exactly", "lightmapped "},
            {"its plane turns with the octahedral normal in 16+16 bits; across that, half a step of an angle "
             "in 16 bits, 180 / 2^17; degrees",
             "anisotropy_direction "},
            {"mixed from albedo and F0 (sqrt in 8 bits, 0.00392) by metallic (half a step, 0.00196)",
             "specular "},
            {"octahedral in 16+16 bits: half a step in both at a face's centre, degrees",
             "normals geometric_normal clearcoat_normal "},
            {"square root in 8 bits: 2h - h^2 with half a step h = 0.5 / 255",
             "albedo dielectric_f0 sheen_color diffuse_transmission_color "},
            {"surfaces with transmission are drawn after either path, by the same shader",
             "transmission transmission_thickness attenuation_color attenuation_distance dispersion "},
            {"the index is stored exactly", "material_id "},
            {"the same function of pixel and depth in both paths", "depth position lit_haze transmittance "},
            {"the same maps, read at the same positions along the same normals",
             "shadow_visibility cascade page_residency local_visibility "}}));
    p.needs.max_emission = p.needs.max_lightmap = 1e6f;
    EXPECT_EQ(p.of(Channel::emission).because, "float32: the scene's emission exceeds the range of 9.9.9.e5");
    EXPECT_EQ(p.of(Channel::lightmap).because, "float32: the scene's lightmaps exceed the range of 9.9.9.e5");
    p.needs = {};
    EXPECT_EQ(
        reasonsOf(p.encoding(GBufferEncoding::compact).pair()),
        (Reasons{
            {"both paths use one list, chosen by the same function of pixel and depth",
             "light_count list_overflow "},
            {"every dielectric has F0 = 0.04: nothing is stored", "dielectric_f0 "},
            {"every dielectric has F90 = 1: nothing is stored", "dielectric_f90 "},
            {"forward+ was not rendered through this G-buffer's encoding, so it explains no difference",
             "lit lit_diffuse lit_specular lit_ambient lit_environment lit_clearcoat lit_sheen "
             "lit_transmission "},
            {"half a step of 6 bits, 0.5 / 63", "metallic "},
            {"half a step of 8 bits, 0.5 / 255", "roughness occlusion "},
            {"it is stored exactly", "lightmapped "},
            {"mixed from albedo (sqrt in 8 bits, 0.00392) by metallic (half a step, 0.00794)", "specular "},
            {"nothing in the scene emits", "emission "},
            {"nothing in the scene has a clear coat", "clearcoat clearcoat_roughness clearcoat_normal "},
            {"nothing in the scene has a lightmap", "lightmap "},
            {"nothing in the scene has a sheen", "sheen_color sheen_roughness "},
            {"nothing in the scene has a thin film", "iridescence iridescence_ior iridescence_thickness "},
            {"nothing in the scene is anisotropic", "anisotropy anisotropy_direction "},
            {"nothing in the scene transmits light diffusely",
             "diffuse_transmission diffuse_transmission_color "},
            {"octahedral in 12+12 bits: half a step in both at a face's centre, degrees", "normals "},
            {"octahedral in 8+8 bits: half a step in both at a face's centre, degrees", "geometric_normal "},
            {"square root in 8 bits: 2h - h^2 with half a step h = 0.5 / 255", "albedo "},
            {"surfaces with transmission are drawn after either path, by the same shader",
             "transmission transmission_thickness attenuation_color attenuation_distance dispersion "},
            {"the index is stored exactly", "material_id "},
            {"the same function of pixel and depth in both paths", "depth position lit_haze transmittance "},
            {"the same maps, read at the same positions along the same normals",
             "shadow_visibility cascade page_residency local_visibility "}}));
    p.encoding(GBufferEncoding::full);
    for (const DebugMode& mode : debugModes()) {
        if (mode.supported_by == SupportedBy::forward_only || mode.supported_by == SupportedBy::deferred_only)
            continue;
        p.cpu = true;
        const std::string exact = "the full G-buffer stores float32 exactly";
        EXPECT_EQ(derivedTolerance(mode, p.pair()).because, exact);
        p.cpu = false;
        p.forward.settings.prepass = Switch::on;
        EXPECT_EQ(derivedTolerance(mode, p.pair()).because,
                  mode.error_kind == ErrorKind::exact
                      ? exact
                      : exact + "; plus 16 ULP of the pixel's largest component on a GPU");
    }
    const FramePair twice{p.forward, p.forward, p.needs, p.covered};
    EXPECT_EQ(derivedTolerance(debugMode(Channel::albedo), twice).because,
              "one path twice: the same function of the same inputs");
    p.deferred.origin.external = true;
    EXPECT_EQ(p.of(Channel::albedo).because,
              "an external renderer's image has no derived tolerance: give rules (--tolerances)");
}

TEST(ToleranceReasons, AgainstTheReferenceEachChannelHasItsReason) {
    OnePixelPair p;
    p.encoding(GBufferEncoding::full);
    Frame reference = p.forward;
    reference.name = "reference";
    reference.settings.path = Path::reference;
    const auto reasons = [&] { return reasonsOf({reference, p.forward, p.needs, p.covered}); };
    EXPECT_EQ(
        reasons(),
        (Reasons{{"farther than the filter radius and one texel from a shadow boundary, visibility is 0 or 1",
                  "shadow_visibility "},
                 {"float32 against double, 1e-4; plus the image's change within two pixels and one code of a "
                  "texture, because the reference traces these surfaces itself",
                  "transmission transmission_thickness attenuation_color attenuation_distance dispersion "},
                 {"float32 against quadrature in double, 1e-4", "lit_haze "},
                 {"float32 against quadrature in double, 1e-6", "transmittance "},
                 {"float32 shading against double, 1e-4",
                  "lit lit_diffuse lit_specular lit_ambient lit_environment lit_clearcoat lit_sheen "
                  "lit_transmission "},
                 {"float32 weights against double, 1e-4; farther than the filter radius and one texel from a "
                  "shadow boundary, a light's visibility is 0 or 1",
                  "local_visibility "},
                 {"float32, nothing is packed",
                  "albedo normals metallic roughness emission occlusion specular material_id texcoords depth "
                  "position geometric_normal light_count list_overflow cascade page_residency dielectric_f90 "
                  "lightmap tangent handedness tangent_normal dielectric_f0 lightmapped clearcoat "
                  "clearcoat_roughness clearcoat_normal anisotropy anisotropy_direction sheen_color "
                  "sheen_roughness iridescence iridescence_ior iridescence_thickness diffuse_transmission "
                  "diffuse_transmission_color "}}));
    p.encoding(GBufferEncoding::compact).forward.through_gbuffer[Channel::lit] = Image(1, 1, 3);
    const FramePair encoded{p.deferred, reference, p.needs, p.covered, true, &p.forward};
    EXPECT_EQ(derivedTolerance(debugMode(Channel::lit), encoded).because,
              "float32 shading against double, 1e-4; on the surfaces that the compact G-buffer decodes, as "
              "forward_plus shades them");
    EXPECT_EQ(derivedTolerance(debugMode(Channel::metallic), encoded).because,
              "half a step of 6 bits, 0.5 / 63");
    reference.rounding = Image(1, 1, 4);
    reference.uncertainty = Image(1, 1, 1);
    reference.environment_costs = Image(1, 1, 9);
    reference.shadow_edge = Image(1, 1, 2);
    reference.blended = Image(1, 1, 3, 0.5f);
    p.forward.shadow_filter_radii = {{10, 0.1}};
    p.forward.settings.haze = true;
    p.forward.settings.haze_march_steps = 16;
    for (const auto& [channel, because] :
         {std::pair{
              Channel::lit,
              "float32 shading against double, 1e-4 or, where light grazes, nears its range or meets a sharp "
              "lobe, what float32 positions err by; plus a shadow-casting light's contribution where its "
              "shadow boundary lies within the filter radius and one texel; plus the error of irradiance by "
              "harmonics of order 2 and the base's mean share of it, the split sum, the spread of its maps' "
              "samples and 8 % at each pixel, as the reference integrates it; plus the image's change within "
              "two pixels where fragments are blended or glass stands, because the reference traces its own "
              "rays; plus any error of light through rough or refracting glass, which a path takes from its "
              "own picture; plus the reference's uncertainty at each pixel, at 99.9 % confidence; plus the "
              "error of 16 steps through haze, 0.62 % of its light"},
          {Channel::lit_haze,
           "float32 against quadrature in double, 1e-4; plus the error of 16 steps through haze, 0.62 % of "
           "its light"},
          {Channel::lit_ambient,
           "float32 shading against double, 1e-4 or, where light grazes, nears its range or meets a sharp "
           "lobe, what float32 positions err by; plus a shadow-casting light's contribution where its shadow "
           "boundary lies within the filter radius and one texel; plus the reference's uncertainty at each "
           "pixel, at 99.9 % confidence"}})
        EXPECT_EQ(derivedTolerance(debugMode(channel), {reference, p.forward, p.needs, p.covered}).because,
                  because);
}

}  // namespace
}  // namespace diptych
