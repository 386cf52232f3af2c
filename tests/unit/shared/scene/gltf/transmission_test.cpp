// SPDX-License-Identifier: MIT
// KHR_materials_transmission, _volume, _dispersion and _diffuse_transmission without effect.
#include "tests/support/gltf_material_builder.h"

#include <string>
#include <utility>
#include <vector>

using namespace diptych;
using Json = nlohmann::json;

namespace {

Json extended(std::vector<std::pair<const char*, Json>> extensions) {
    Json material{{"name", "pane"}};
    for (auto& [name, values] : extensions)
        material["extensions"][std::string("KHR_materials_") + name] = std::move(values);
    return material;
}

const Json half = {{"transmissionFactor", 0.5}}, thick = {{"thicknessFactor", 0.5}};

}  // namespace

TEST(GltfTransmission, ExtensionsWithoutEffectAreNoted) {
    const Json color = {{"diffuseTransmissionFactor", 1}}, disperse = {{"dispersion", 1}},
               none = {{"transmissionFactor", 0}};
    const std::string volume = "1 material (pane) with KHR_materials_volume, but without transmission",
                      dispersion = "1 material (pane) with KHR_materials_dispersion, but without",
                      scattering = "1 material (pane) with KHR_materials_diffuse_transmission and a volume",
                      unlit =
                          "1 material (pane) with KHR_materials_unlit: light that they transmit is left out";
    struct Case {
        std::vector<std::pair<const char*, Json>> extensions;
        std::vector<std::string> notes;
    };
    const Case cases[] = {
        {{{"volume", thick}}, {volume}},
        {{{"volume", thick}, {"transmission", half}}, {}},
        {{{"volume", Json::object()}, {"diffuse_transmission", color}}, {}},
        {{{"volume", thick}, {"diffuse_transmission", color}}, {scattering}},
        {{{"dispersion", disperse}, {"transmission", half}}, {dispersion}},
        {{{"dispersion", disperse}, {"volume", thick}}, {volume, dispersion}},
        {{{"dispersion", disperse}, {"volume", thick}, {"transmission", none}}, {volume, dispersion}},
        {{{"dispersion", disperse}, {"volume", thick}, {"transmission", half}}, {}},
        {{{"dispersion", disperse},
          {"volume", thick},
          {"transmission", half},
          {"diffuse_transmission", color},
          {"unlit", Json::object()}},
         {unlit}}};
    for (const auto& [extensions, notes] : cases) {
        const Scene scene = withMaterial(extended(extensions)).load();
        EXPECT_EQ(scene.notes.size(), notes.size()) << extended(extensions);
        for (const std::string& note : notes) EXPECT_TRUE(mentions(scene.notes, note)) << note;
    }
}
