// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/resources.h"

#include "shared/image/file_bytes.h"
#include "shared/scene/gltf/limits.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <system_error>

namespace diptych::gltf {

namespace {

using Bytes = std::vector<unsigned char>;
namespace fs = std::filesystem;

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool equalInAnyCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

// RFC 3986, 3.1: schemes are case-insensitive.
bool isData(std::string_view uri) {
    constexpr std::string_view scheme = "data:";
    return equalInAnyCase(uri.substr(0, scheme.size()), scheme);
}

// RFC 4648, 4; skips white space, as browsers do.
Bytes decodeBase64(std::string_view text, std::vector<std::string>& notes) {
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
    int count = 0;  // bits not yet output
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (std::isspace(c)) continue;
        if (c == '=') {  // the rest is padding
            const std::size_t more = text.find_first_not_of("= \t\r\n", i);
            if (more != text.npos)
                notes.push_back(
                    fmt::format("its base64 continues after its end, at character {}: ignored", more));
            break;
        }
        if (values[c] < 0) fail(fmt::format("its data is not base64 at character {}", i));
        bits = (bits << 6 | static_cast<std::uint32_t>(values[c])) & 0xffff;
        if ((count += 6) >= 8) bytes.push_back(static_cast<unsigned char>(bits >> (count -= 8)));
    }
    return bytes;
}

// RFC 2397: data:[type][;base64],data. Base64 text may be percent-encoded, too.
Bytes readData(std::string_view uri, std::vector<std::string>& notes) {
    constexpr std::string_view base64 = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) fail("its data URI has no comma before the data");
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    // Quotes are not allowed in a URI (RFC 3986, 2), so it is unclear whether this comma begins the data.
    if (std::ranges::count(head, '"') % 2 != 0)
        fail("its data URI has a comma in quotes before the data; write it as %2C");
    const bool encoded =
        head.size() >= base64.size() && equalInAnyCase(head.substr(head.size() - base64.size()), base64);
    if (encoded && data.find('%') == data.npos) return decodeBase64(data, notes);
    const std::string text = percentDecoded(data);
    if (encoded) return decodeBase64(text, notes);
    return {text.begin(), text.end()};
}

// Throws unless the name is a relative path without a scheme.
void checkRelative(const std::string& name) {
    if (name.empty()) fail("its uri is empty");
    if (name.find('\0') != name.npos) fail("its uri contains a null character");
    const std::size_t colon = name.find(':');
    if (colon != name.npos && colon > 0 &&
        std::all_of(name.begin(), name.begin() + static_cast<long>(colon),
                    [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; }))
        fail(oneLine(name) + ": only files in the scene's folder and data URIs are read");
    if (name[0] == '/' || name[0] == '\\')
        fail(oneLine(name) + ": an absolute path leaves the scene's folder");
}

// Candidate files for a uri, most likely first, each with the note to add if it is used.
struct Candidate {
    std::string name, note;
};

std::string withSlashes(std::string name) {
    std::ranges::replace(name, '\\', '/');
    return name;
}

std::vector<Candidate> candidates(const std::string& uri) {
    const std::string decoded = percentDecoded(uri);
    std::vector<Candidate> all{{decoded, ""}};
    if (uri != decoded) all.push_back({uri, "its uri is read without percent-decoding"});
    for (std::size_t i = 0, count = all.size(); i < count; ++i)
        if (const std::string name = withSlashes(all[i].name); name != all[i].name)
            all.push_back({name, "a backslash in its uri is read as /"});
    return all;
}

}  // namespace

Resources::Resources(const fs::path& folder) {
    if (!folder.empty()) folder_ = fs::canonical(folder);
}

std::filesystem::path Resources::find(const std::string& uri, std::vector<std::string>& notes) const {
    const std::vector<Candidate> all = candidates(uri);
    const std::string shown = oneLine(all.front().name);
    for (const Candidate& c : all) checkRelative(c.name);
    if (folder_.empty()) fail(shown + ": only data URIs are read here");
    // Checks the path's text first, so that no file outside is even looked up; then the target of links.
    const auto inside = [&](const fs::path& path) {
        return std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first == folder_.end();
    };
    for (const Candidate& c : all)
        if (!inside((folder_ / withSlashes(c.name)).lexically_normal()))
            fail(shown + ": leaves the scene's folder");
    std::error_code first;
    for (const Candidate& c : all) {
        std::error_code error;
        const fs::path target = fs::canonical(folder_ / c.name, error);
        if (!first) first = error;
        if (error) continue;
        if (!inside(target)) fail(oneLine(c.name) + ": is a link that leaves the scene's folder");
        if (!c.note.empty()) notes.push_back(fmt::format("{}: {}", oneLine(c.name), c.note));
        return target;
    }
    fail(fmt::format("{}: {}", shown,
                     first == std::errc::no_such_file_or_directory ? "no such file" : first.message()));
}

std::vector<unsigned char> Resources::read(const std::string& uri, std::uint64_t max,
                                           std::vector<std::string>& notes) const {
    if (isData(uri)) return readData(uri, notes);
    const fs::path file = find(uri, notes);
    try {
        return firstBytesOf(file, MAX_FILE_BYTES, max);
    } catch (const std::runtime_error& e) {
        fail(fmt::format("{}: {}", oneLine(percentDecoded(uri)), e.what()));
    }
}

std::string uriName(const std::string& uri) {
    return isData(uri) ? "" : oneLine(percentDecoded(uri));
}

std::string percentDecoded(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::string_view digits = uri.substr(i + 1, 2);
        std::uint8_t byte = 0;
        if (uri[i] == '%' && digits.size() == 2 &&
            std::from_chars(digits.data(), digits.data() + 2, byte, 16).ptr == digits.data() + 2) {
            result += static_cast<char>(byte);
            i += 2;
        } else {
            result += uri[i];
        }
    }
    return result;
}

}  // namespace diptych::gltf
