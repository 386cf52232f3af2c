// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/limits.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// Access to what a scene's URIs may refer to: embedded data, and files in or below the scene's folder.
// Symbolic links are followed, but their targets must be there, too.
class Resources {
public:
    // `folder` empty: reads only data URIs.
    explicit Resources(const std::filesystem::path& folder);

    // Reads at most the first `max` bytes. Throws std::runtime_error: "a.bin: no such file". Messages and
    // notes do not name the object that has the uri. A note says if another file than the uri's was read.
    std::vector<unsigned char> read(const std::string& uri, std::uint64_t max,
                                    std::vector<std::string>& notes) const;

private:
    std::filesystem::path find(const std::string& uri, std::vector<std::string>& notes) const;

    std::filesystem::path folder_;  // canonical
};

// The uri for messages; data URIs without their data.
std::string uriName(const std::string& uri);

// RFC 3986, 2.1.
std::string percentDecoded(std::string_view uri);

}  // namespace diptych::gltf
