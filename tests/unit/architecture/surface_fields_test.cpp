// SPDX-License-Identifier: MIT
// A lit channel of a packed G-buffer is evaluated by the surface fields that lighting reads. So each field
// needs an evaluated channel, and the two forward+ variants may differ only in the decoded surface.
#include "compare/verdict/encoding_bits.h"
#include "shared/contract/gbuffer.h"
#include "shared/frame/debug_modes.h"
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace diptych {
namespace {

std::set<std::string> fieldsOf(const std::string& source) {
    const std::size_t begin = source.find("struct Surface {"), end = source.find("};", begin);
    std::set<std::string> fields;
    const std::regex declared(R"(\n\s+\w+ (\w+);)");
    const std::string body = source.substr(begin, end - begin);
    for (std::sregex_iterator i(body.begin(), body.end(), declared), none; i != none; ++i)
        fields.insert((*i)[1]);
#define FIELD(type, name) fields.insert(#name);
#define FIELDS(layer, packed, values) values(FIELD)
    STORED_LAYERS(FIELDS)
#undef FIELDS
#undef FIELD
    return fields;
}

const std::string& shader(const std::string& name) {
    return sources().at("shaders/lib/" + name);
}

TEST(SurfaceFields, AllThatLightingReadsIsEvaluated) {
    // Fields whose channel has another name.
    const std::map<std::string, std::string> names{{"normal", "normals"},
                                                   {"anisotropy_turn", "anisotropy_direction"}};
    const std::string panes = "draws of surfaces with transmission alone, which both paths share";
    // Fields that lighting of G-buffer surfaces does not read.
    const std::map<std::string, std::string> unread{
        {"triangle_normal", "shown as geometric_normal"},
        {"material_id", "shown alone"},
        {"texcoord", "shown alone"},
        {"tangent", "shown alone"},
        {"handedness", "shown alone"},
        {"tangent_normal", "shown alone"},
        {"transmission", panes},
        {"ior", panes},
        {"thickness", panes},
        {"attenuation_color", panes},
        {"attenuation_distance", panes},
        {"dispersion", panes},
        {"coverage", panes},
        {"object_irradiance", "--assign per_object, which deferred does not have"}};
    const std::set<std::string> fields = fieldsOf(shader("surface/surface.glsl"));
    EXPECT_GE(fields.size(), 25u);
    for (const std::string& field : fields) {
        if (unread.contains(field)) continue;
        const auto renamed = names.find(field);
        const std::string& channel = renamed == names.end() ? field : renamed->second;
        EXPECT_TRUE(std::ranges::any_of(lightingFields(),
                                        [&](Channel mode) { return debugMode(mode).name == channel; }))
            << field << " has no channel that judges it with lit: add it to lightingFields()";
    }
    for (const auto& [field, reason] : unread) {
        EXPECT_TRUE(fields.contains(field)) << field << " is gone: strike it here";
        if (reason != "shown alone" && reason != "shown as geometric_normal") continue;
        for (const char* name :
             {"shading/shade.glsl", "shading/brdf.glsl", "shading/multiscatter.glsl",
              "shading/clearcoat.glsl", "shading/sheen.glsl", "environment/environment.glsl",
              "shading/ambient.glsl", "shadows/sun_shadow.glsl", "shadows/receiver_plane.glsl",
              "shadows/pcss.glsl", "shadows/local_shadow.glsl", "lights/ltc.glsl", "lights/area.glsl",
              "lights/area_point.glsl", "lights/punctual_lights.glsl", "lights/object_lights.glsl",
              "environment/haze.glsl", "shading/radiance.glsl"})
            EXPECT_FALSE(std::regex_search(shader(name), std::regex("\\bs\\." + field + "\\b")))
                << name << " reads " << field;
    }
}

TEST(SurfaceFields, TheEncodingChangesNothingButTheSurface) {
    std::set<std::string> readers;
    for (const auto& [file, text] : sources())
        if (file.starts_with("shaders/") && text.find("feature_encoded_surface") != std::string::npos)
            readers.insert(file);
    EXPECT_EQ(readers, std::set<std::string>{"shaders/lib/surface/forward.glsl"});
}

}  // namespace
}  // namespace diptych
