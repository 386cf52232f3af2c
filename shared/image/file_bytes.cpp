// SPDX-License-Identifier: MIT
#include "shared/image/file_bytes.h"

#include "shared/image/limits.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace diptych {

namespace fs = std::filesystem;

std::vector<unsigned char> firstBytesOf(const fs::path& file, std::uint64_t limit, std::uint64_t most) {
    const auto fail = [](const std::string& what) { throw std::runtime_error(what); };
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found) fail("no such file");
    if (!fs::exists(status)) fail("cannot be read: " + error.message());
    if (fs::is_directory(status)) fail("is a folder");
    if (!fs::is_regular_file(status)) fail("is not a regular file");
    const std::uint64_t size = fs::file_size(file, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > limit) fail(fmt::format("is {} bytes: at most {} are read", size, limit));

    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("cannot be read: " + std::generic_category().message(errno));
    std::vector<unsigned char> bytes(std::min(size, most));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) fail("cannot be read to its end");
    return bytes;
}

std::vector<unsigned char> bytesOf(const fs::path& file) {
    return named(file.string(), [&] { return firstBytesOf(file, limits::imageBytes()); });
}

}  // namespace diptych
