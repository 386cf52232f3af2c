// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_resources.h"

#include "shared/image/file_bytes.h"
#include "shared/scene/gltf_limits.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace diptych::gltf {

namespace {

using Bytes = std::vector<unsigned char>;
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what);
}

constexpr std::string_view dataScheme = "data:";

// RFC 4648, 4; white space is skipped, as browsers do.
Bytes decodeBase64(std::string_view text) {
    static constexpr auto values = [] {
        std::array<std::int8_t, 256> table{};
        table.fill(-1);
        constexpr std::string_view alphabet =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = 0; i < alphabet.size(); ++i)
            table[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
        return table;
    }();
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;  // of bits waiting
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (std::isspace(c)) continue;
        if (c == '=') break;  // the rest is padding
        if (values[c] < 0) fail(fmt::format("its data is not base64 at character {}", i));
        bits = (bits << 6 | static_cast<std::uint32_t>(values[c])) & 0xffff;
        if ((count += 6) >= 8) bytes.push_back(static_cast<unsigned char>(bits >> (count -= 8)));
    }
    return bytes;
}

// RFC 2397: data:[type][;base64],data.
Bytes readData(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) fail("its data URI has no comma before the data");
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (head.ends_with(";base64")) return decodeBase64(data);
    const std::string text = percentDecoded(data);
    return {text.begin(), text.end()};
}

// A relative path without a scheme.
void checkRelative(const std::string& name) {
    if (name.empty()) fail("its uri is empty");
    if (name.find('\0') != name.npos) fail("its uri holds a null character");
    const std::size_t colon = name.find(':');
    if (colon != name.npos && colon > 0 &&
        std::all_of(name.begin(), name.begin() + static_cast<long>(colon),
                    [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; }))
        fail(oneLine(name) + ": only files beside the scene and data URIs are read");
    if (name[0] == '/' || name[0] == '\\')
        fail(oneLine(name) + ": an absolute path leaves the scene's folder");
}

}  // namespace

Resources::Resources(const fs::path& folder) {
    if (!folder.empty()) folder_ = fs::canonical(folder);
}

std::vector<unsigned char> Resources::read(const std::string& uri, std::uint64_t most) const {
    if (uri.starts_with(dataScheme)) return readData(uri);
    const std::string name = percentDecoded(uri);
    checkRelative(name);
    if (folder_.empty()) fail(oneLine(name) + ": only data URIs are read here");
    // The words first, so that nothing outside is even asked for; then where links lead.
    const auto inside = [&](const fs::path& path) {
        return std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first == folder_.end();
    };
    std::string slashes = name;
    std::ranges::replace(slashes, '\\', '/');
    if (!inside((folder_ / slashes).lexically_normal())) fail(oneLine(name) + ": leaves the scene's folder");
    std::error_code error;
    const fs::path target = fs::canonical(folder_ / name, error);
    if (error)
        fail(fmt::format("{}: {}", oneLine(name),
                         error == std::errc::no_such_file_or_directory ? "no such file" : error.message()));
    if (!inside(target)) fail(oneLine(name) + ": is a link that leaves the scene's folder");
    try {
        return firstBytesOf(target, MAX_FILE_BYTES, most);
    } catch (const std::runtime_error& e) {
        fail(fmt::format("{}: {}", oneLine(name), e.what()));
    }
}

std::string uriName(const std::string& uri) {
    return uri.starts_with(dataScheme) ? "" : oneLine(percentDecoded(uri));
}

std::string percentDecoded(std::string_view uri) {
    const auto isHex = [&](std::size_t i) {
        return i < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i]));
    };
    const auto digit = [&](std::size_t i) {
        return std::isdigit(static_cast<unsigned char>(uri[i]))
                   ? uri[i] - '0'
                   : std::tolower(static_cast<unsigned char>(uri[i])) - 'a' + 10;
    };
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && isHex(i + 1) && isHex(i + 2)) {
            result += static_cast<char>(digit(i + 1) * 16 + digit(i + 2));
            i += 2;
        } else {
            result += uri[i];
        }
    }
    return result;
}

}  // namespace diptych::gltf
