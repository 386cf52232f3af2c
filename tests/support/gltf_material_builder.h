// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/gltf_builder.h"

#include <utility>

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

inline Material materialOf(nlohmann::json material) {
    return withMaterial(std::move(material)).load().materials.at(0);
}

}  // namespace diptych
