// SPDX-License-Identifier: MIT
// Names of capabilities that the layer can hide from the program: every row of DEVICE_FEATURES, every use
// of a format, every limit and extension. The layer reads one from the environment, DIPTYCH_HIDE; tests
// iterate over all.
//   "feature shaderInt64"  "format R16G16_SNORM drawn"  "limit maxColorAttachments"
//   "extension VK_EXT_..."
// A limit is lowered to the minimum that Vulkan requires; "limit maxTexelBufferElements 2048" lowers it to
// 2048.
#pragma once

#include "shared/vulkan/instance/device_support.h"

#include <string>
#include <vector>

namespace diptych {

// All optional capabilities: not the format uses that Vulkan guarantees.
inline std::vector<std::string> everythingToHide() {
    std::vector<std::string> all;
#define DIPTYCH_HIDE_FEATURE(version, name, need, what) all.emplace_back("feature " #name);
    DEVICE_FEATURES(DIPTYCH_HIDE_FEATURE)
#undef DIPTYCH_HIDE_FEATURE
    using namespace format_use;
    const auto format = [&](const std::string& name, std::uint32_t left) {
#define DIPTYCH_HIDE_USE(use, features, bit, word) \
    if ((left & format_use::use) != 0) all.push_back("format " + name + " " #use);
        DEVICE_FORMAT_USES(DIPTYCH_HIDE_USE)
#undef DIPTYCH_HIDE_USE
        if ((left & multisampled) != 0) all.push_back("format " + name + " multisampled");
    };
#define DIPTYCH_HIDE_FORMAT(name, promised, left, helps) format(#name, left);
    DEVICE_FORMATS(DIPTYCH_HIDE_FORMAT)
#undef DIPTYCH_HIDE_FORMAT
#define DIPTYCH_HIDE_LIMIT(name, min, needed, what) all.emplace_back("limit " #name);
    DEVICE_LIMITS(DIPTYCH_HIDE_LIMIT)
#undef DIPTYCH_HIDE_LIMIT
#define DIPTYCH_HIDE_EXTENSION(name, what) all.emplace_back("extension " #name);
    DEVICE_EXTENSIONS(DIPTYCH_HIDE_EXTENSION)
#undef DIPTYCH_HIDE_EXTENSION
    return all;
}

}  // namespace diptych
