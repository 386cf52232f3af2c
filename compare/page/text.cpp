// SPDX-License-Identifier: MIT
#include "compare/page/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace diptych::page {
namespace {

// The code point that begins at text[at] and its length in bytes; U+FFFD and 1 where there is none.
std::pair<std::uint32_t, std::size_t> decodeUtf8(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    constexpr std::pair<std::uint32_t, std::size_t> none{0xfffd, 1};
    const std::uint32_t first = byte(at);
    if (first < 0x80) return {first, 1};
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || at + length > text.size()) return none;
    std::uint32_t code = first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return none;
        code = code << 6 | (byte(at + i) & 0x3f);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    return overlong || code > 0x10ffff ? none : std::pair{code, length};
}

bool isXmlCharacter(std::uint32_t c) {
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0xd800) || (c > 0xdfff && c < 0xfffe) ||
           c > 0xffff;
}

}  // namespace

std::string markup(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto [code, length] = decodeUtf8(text, i);
        if (code == '&')
            out += "&amp;";
        else if (code == '<')
            out += "&lt;";
        else if (code == '>')
            out += "&gt;";
        else if (code == '"')
            out += "&quot;";
        else if (code == '\'')
            out += "&#39;";
        else if (code == 0xfffd || !isXmlCharacter(code))
            out += "\xef\xbf\xbd";
        else
            out += text.substr(i, length);
        i += length;
    }
    return out;
}

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

std::string percent(double share) {
    return number(100 * share) + " %";
}

std::string bytes(std::uint64_t count) {
    if (count < 1024) return fmt::format("{} B", count);
    double value = static_cast<double>(count);
    std::size_t unit = 0;
    for (; value >= 1024 && unit < 4; ++unit) value /= 1024;
    return fmt::format("{:.4g} {}iB", value, " KMGT"[unit]);
}

std::string commonFolder(const std::vector<std::string>& paths) {
    const std::string* first = nullptr;
    std::size_t length = 0;
    for (const std::string& path : paths) {
        if (path.find(':') < path.find('/')) continue;
        const std::size_t folder = path.rfind('/') + 1;
        if (!first) length = folder;
        if (!first) first = &path;
        length = std::min(length, folder);
        while (length > 0 && path.compare(0, length, *first, 0, length) != 0)
            length = length < 2 ? 0 : path.rfind('/', length - 2) + 1;
    }
    return first ? first->substr(0, length) : "";
}

std::string inFolder(std::string_view path, std::string_view folder) {
    return std::string(path.starts_with(folder) ? path.substr(folder.size()) : path);
}

std::string breakable(std::string_view name) {
    std::string out;
    for (const char& c : markup(name)) {
        out += c;
        if (c == '_') out += "<wbr>";
    }
    return out;
}

const char* unitOf(const DebugMode& mode) {
    return mode.metric == Metric::angular ? "\u00b0" : "";
}

std::string cameraTitle(const Frame& frame) {
    if (!frame.camera.name.empty()) return frame.camera.name;
    return frame.settings.camera.empty() ? "default view" : frame.settings.camera;
}

std::string csvLine(const std::vector<std::string>& fields) {
    std::string out;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) out += ',';
        if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
            out += fields[i];
            continue;
        }
        out += '"';
        for (const char c : fields[i]) out += c == '"' ? "\"\"" : std::string(1, c);
        out += '"';
    }
    return out + "\r\n";
}

std::string numberCell(double value, std::string_view text) {
    return fmt::format("<td class=\"n\" data-value=\"{}\">{}</td>", std::isfinite(value) ? value : 1e300,
                       markup(text));
}

}  // namespace diptych::page
