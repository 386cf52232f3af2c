// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/limits.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// What a scene's URIs may name: data inside the URI, and files in the scene's folder or below it. Symbolic
// links are followed, but what they lead to must be there as well.
class Resources {
public:
    // Empty: there is no folder, only data URIs are read.
    explicit Resources(const std::filesystem::path& folder);

    // The first `most` bytes, or all that there are. Throws std::runtime_error: "a.bin: no such file",
    // without the name of who asks; so are the notes on what the uri was taken for.
    std::vector<unsigned char> read(const std::string& uri, std::uint64_t most,
                                    std::vector<std::string>& notes) const;

private:
    std::filesystem::path find(const std::string& uri, std::vector<std::string>& notes) const;

    std::filesystem::path folder_;  // canonical
};

// How a line names it: a data URI without its data.
std::string uriName(const std::string& uri);

// RFC 3986, 2.1.
std::string percentDecoded(std::string_view uri);

}  // namespace diptych::gltf
