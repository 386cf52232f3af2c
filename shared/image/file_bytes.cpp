// SPDX-License-Identifier: MIT
#include "shared/image/file_bytes.h"

#include "shared/image/limits.h"
#include "shared/text/input_file.h"
#include "shared/text/named.h"

#include <algorithm>
#include <span>

namespace diptych {

namespace fs = std::filesystem;

std::vector<unsigned char> firstBytesOf(const fs::path& path, std::uint64_t limit, std::uint64_t max) {
    InputFile file(path, limit);
    std::vector<unsigned char> bytes(std::min(file.size(), max));
    file.read(std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

std::vector<unsigned char> bytesOf(const fs::path& file) {
    return named(file.string(), [&] { return firstBytesOf(file, limits::imageBytes()); });
}

}  // namespace diptych
