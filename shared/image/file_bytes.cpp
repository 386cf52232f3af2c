// SPDX-License-Identifier: MIT
#include "shared/image/file_bytes.h"

#include "shared/image/limits.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace diptych {

namespace fs = std::filesystem;

std::vector<std::byte> bytesOf(const fs::path& file) {
    const auto fail = [&](const std::string& what) { throw std::runtime_error(file.string() + ": " + what); };
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail("no such file");
    if (fs::is_directory(status)) fail("is a folder");
    if (!fs::is_regular_file(status)) fail("is not a regular file");
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) fail(error.message());
    if (size > limits::imageBytes()) fail(fmt::format("is larger than {} MiB", limits::imageBytes() >> 20));

    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream) fail("cannot be read");
    return bytes;
}

}  // namespace diptych
