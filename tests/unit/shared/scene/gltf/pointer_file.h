// SPDX-License-Identifier: MIT
// A file for KHR_animation_pointer.
#pragma once

#include "tests/support/gltf_builder.h"
#include "tests/support/layer_table.h"

#include <string>
#include <vector>

namespace diptych {

inline constexpr const char* pointedPixel =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5E"
    "rkJggg==";

// A morphed triangle with a textured material, a spot light, a sun, and both camera types.
struct PointerFile : GltfFile {
    using Json = nlohmann::json;

    PointerFile() : GltfFile(triangle()) {
        const int up = accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, FLOAT, "VEC3", 3);
        primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", up}}};
        primitive()["attributes"]["TEXCOORD_0"] = accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC2", 2);
        primitive()["material"] = 0;
        json["meshes"][0]["weights"] = {0.5, 0.25};
        const Json texture = {{"index", 0}};
        json["materials"] = {
            {{"pbrMetallicRoughness", {{"baseColorTexture", texture}, {"metallicRoughnessTexture", texture}}},
             {"normalTexture", texture},
             {"occlusionTexture", texture},
             {"emissiveTexture", texture},
             {"extensions",
              {{"KHR_materials_specular",
                {{"specularTexture", texture}, {"specularColorTexture", texture}}}}}}};
        for (const TestedLayer& layer : testedLayers())
            for (const LayerTexture& t : layer.textures)
                json["materials"][0]["extensions"][std::string("KHR_materials_") + t.extension][t.key] =
                    texture;
        json["images"] = {{{"uri", pointedPixel}}};
        json["textures"] = {{{"source", 0}}};
        json["cameras"] = {{{"type", "perspective"},
                            {"perspective", {{"yfov", 1}, {"aspectRatio", 1}, {"znear", 0.5}, {"zfar", 10}}}},
                           {{"type", "orthographic"},
                            {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.5}, {"zfar", 10}}}}};
        json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"}, {"range", 5}, {"spot", {{"innerConeAngle", 0.125}, {"outerConeAngle", 0.5}}}},
            {{"type", "directional"}}};
        const auto light = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
        json["nodes"][0]["extensions"] = light(0);
        json["nodes"].push_back({{"camera", 0}, {"extensions", light(1)}});
        json["nodes"].push_back({{"camera", 1}, {"extensions", light(0)}});
        json["scenes"] = {{{"nodes", {0, 1, 2}}}};
        json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_specular"};
    }
    // Keys at 0 s and 1 s.
    PointerFile& channel(const std::string& pointer, const std::vector<float>& values,
                         const char* interpolation = "LINEAR") {
        const std::size_t width = values.size() / (std::string(interpolation) == "CUBICSPLINE" ? 6 : 2);
        const bool array = pointer.ends_with("/weights");
        const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return channelTo(pointer, accessor(values, FLOAT, array ? "SCALAR" : types[width], array ? 1 : width),
                         interpolation);
    }
    PointerFile& channelTo(const std::string& pointer, int output, const char* interpolation = "LINEAR") {
        Json& a = json["animations"][0];
        a["samplers"].push_back({{"input", accessor<float>({0, 1}, FLOAT, "SCALAR", 1)},
                                 {"output", output},
                                 {"interpolation", interpolation}});
        a["channels"].push_back(
            {{"sampler", a["samplers"].size() - 1},
             {"target",
              {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
        return *this;
    }
};

}  // namespace diptych
