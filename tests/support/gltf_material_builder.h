// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/gltf_builder.h"

#include <string>
#include <utility>
#include <vector>

namespace diptych {

// A file with one material and `images` two-pixel PNGs as textures 0 and up.
inline GltfFile withMaterial(nlohmann::json material, int images = 1) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["material"] = 0;
    for (int i = 0; i < images; ++i) {
        f.json["images"].push_back({{"uri", twoPixels}});
        f.json["textures"].push_back({{"source", i}});
    }
    f.json["materials"] = nlohmann::json::array({std::move(material)});
    return f;
}

// KHR_animation_pointer to a property of material 0, with linear keys at 0 s and 1 s.
inline void animate(GltfFile& f, const std::string& property, const std::vector<float>& values) {
    const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::size_t width = values.size() / 2;
    nlohmann::json& animation = f.json["animations"][0];
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()},
         {"target",
          {{"path", "pointer"},
           {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/" + property}}}}}}}});
    animation["samplers"].push_back({{"input", f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1)},
                                     {"output", f.accessor(values, FLOAT, types[width], width)}});
}

inline Material materialOf(nlohmann::json material) {
    return withMaterial(std::move(material)).load().materials.at(0);
}

}  // namespace diptych
