// SPDX-License-Identifier: MIT
#include "compare/page/text.h"

#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace diptych::page {

std::string markup(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const auto [code, size] = characterAt(text);
        const bool shown = code == '\t' || code == '\n' || code == '\r' || !isControl(code);
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
        else if (size == 0 || !shown || code == 0xfffe || code == 0xffff)
            out += "\ufffd";
        else
            out += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

std::string isolated(std::string_view text) {
    return "<bdi>" + markup(text) + "</bdi>";
}

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

std::string percent(double fraction) {
    return number(100 * fraction) + " %";
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
    return isAngle(mode.error_kind) ? "\u00b0" : "";
}

std::string cameraTitle(const Frame& frame) {
    if (!frame.camera.name.empty()) return frame.camera.name;
    return frame.settings.camera.empty() ? "default view" : frame.settings.camera;
}

}  // namespace diptych::page
