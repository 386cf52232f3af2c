// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/limits.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// Access to what a scene's URIs may refer to: data inside the URI, and files in the scene's folder or below
// it. Symbolic links are followed, but their target must be there as well.
class Resources {
public:
    // `folder` empty: only data URIs are read.
    explicit Resources(const std::filesystem::path& folder);

    // At most the first `most` bytes. Throws std::runtime_error: "a.bin: no such file"; neither it nor the
    // notes name the object that refers to the uri. A note says if another file was taken than the uri
    // names.
    std::vector<unsigned char> read(const std::string& uri, std::uint64_t most,
                                    std::vector<std::string>& notes) const;

private:
    std::filesystem::path find(const std::string& uri, std::vector<std::string>& notes) const;

    std::filesystem::path folder_;  // canonical
};

// The uri as messages show it: data URIs without their data.
std::string uriName(const std::string& uri);

// RFC 3986, 2.1.
std::string percentDecoded(std::string_view uri);

}  // namespace diptych::gltf
