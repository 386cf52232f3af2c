// SPDX-License-Identifier: MIT
// glTF files with the buffer URIs that a test gives them.
#pragma once

#include "tests/support/gltf_builder.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace diptych {

// Loads the file with unchanged buffer URIs.
inline Scene loadAsIs(const GltfFile& f) {
    std::ofstream(testFolder() / "as_is.gltf") << f.declared().dump();
    return loadScene((testFolder() / "as_is.gltf").string());
}

inline std::string errorAsIs(const GltfFile& f) {
    try {
        loadAsIs(f);
    } catch (const std::runtime_error& e) {
        return std::string(e.what()).substr((testFolder() / "as_is.gltf: ").string().size());
    }
    return "";
}

inline void writeBeside(const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories((testFolder() / name).parent_path());
    std::ofstream(testFolder() / name, std::ios::binary) << bytes;
}

}  // namespace diptych
