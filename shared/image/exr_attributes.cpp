// SPDX-License-Identifier: MIT
#include "shared/image/exr_attributes.h"

#include "shared/image/limits.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace diptych::exr {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR files are little-endian");

struct Kept {
    std::string_view name, type;
    std::size_t size;             // 0: any
    bool parts_only = false;      // only meaningful in multi-part files
    std::string_view value = {};  // replaces the file's value in every part
};
constexpr std::array meant{Kept{"chromaticities", "chromaticities", 32}, Kept{"whiteLuminance", "float", 4}};
constexpr std::string_view no_window("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 16),
    square_pixels("\0\0\x80\x3f", 4);
constexpr std::array kept{
    Kept{"channels", "chlist", 0},        Kept{"compression", "compression", 1},
    Kept{"dataWindow", "box2i", 16},      Kept{"displayWindow", "box2i", 16, false, no_window},
    Kept{"lineOrder", "lineOrder", 1},    Kept{"pixelAspectRatio", "float", 4, false, square_pixels},
    Kept{"screenWindowCenter", "v2f", 8}, Kept{"screenWindowWidth", "float", 4},
    Kept{"tiles", "tiledesc", 9},         Kept{"name", "string", 0, true},
    Kept{"type", "string", 0, true},      Kept{"chunkCount", "int", 4, true},
};

std::string_view textIn(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void addString(Attributes& part, const std::string& name, Bytes value) {
    part.strings.emplace(name, textIn(value));
    if (std::ssize(part.strings) > limits::image_attributes)
        fail(fmt::format("has over {} string attributes", limits::image_attributes));
}

}  // namespace

Bytes Cursor::take(std::size_t count) {
    if (count > rest_.size()) fail("its header is cut short");
    const Bytes taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
}

std::string Cursor::name() {
    constexpr std::size_t longest = 255;  // the format's limit, with long names
    const std::string_view text = textIn(rest_).substr(0, longest + 1);
    const std::size_t size = text.find('\0');
    if (size == std::string_view::npos) fail("its header holds a name without an end");
    take(size + 1);
    return std::string(text.substr(0, size));
}

Cursor Attributes::valueOf(std::string_view name) const {
    const auto at = needed.find(name);
    if (at == needed.end()) fail(fmt::format("has no attribute {}", name));
    return Cursor(at->second);
}

std::string_view Attributes::textOf(std::string_view name) const {
    const auto at = needed.find(name);
    if (at != needed.end()) return textIn(at->second);
    const auto other = strings.find(name);
    return other == strings.end() ? std::string_view() : other->second;
}

Attributes readAttributes(Cursor& in, Bytes from, bool several) {
    Attributes part;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        const std::string type = in.name();
        if (type.empty()) fail(fmt::format("attribute {}: has no type", oneLine(name)));
        const auto size = in.number<std::int32_t>();
        if (size < 0 || static_cast<std::size_t>(size) > in.left())
            fail(fmt::format("attribute {}: claims {} bytes, but the file has only {} left", oneLine(name),
                             size, in.left()));
        const Bytes value = in.take(static_cast<std::size_t>(size));
        const auto meaning = std::ranges::find(meant, name, &Kept::name);
        if (meaning != meant.end() && type == meaning->type && value.size() == meaning->size)
            part.meaning.emplace(name, value);
        const auto known = std::ranges::find(kept, name, &Kept::name);
        if (known == kept.end() || (known->parts_only && !several)) {
            if (type == "string") addString(part, name, value);
            continue;
        }
        if (type != known->type || (known->size != 0 && value.size() != known->size))
            fail(fmt::format("attribute {}: is a {} of {} bytes instead of a valid {}", name, oneLine(type),
                             size, known->type));
        if (!part.needed.emplace(name, value).second) fail(fmt::format("attribute {}: appears twice", name));
    }
    part.all = from.first(from.size() - in.left());
    return part;
}

void append(std::vector<std::byte>& out, const Attributes& part) {
    const std::size_t end = out.size() + part.all.size();
    const auto text = [&](std::string_view word) {
        for (const char c : word) out.push_back(static_cast<std::byte>(c));
        out.push_back(std::byte{0});
    };
    const auto number = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8)
            out.push_back(static_cast<std::byte>(value >> shift & 0xff));
    };
    for (const Kept& attribute : kept) {
        const auto found = part.needed.find(attribute.name);
        if (found == part.needed.end()) continue;
        const Bytes value =
            attribute.value.empty() ? found->second : std::as_bytes(std::span(attribute.value));
        text(attribute.name);
        text(attribute.type);
        number(value.size());
        out.insert(out.end(), value.begin(), value.end());
    }
    // The shortest attribute that can be omitted has a name and a type of one letter each, as long as an
    // empty filler.
    constexpr std::size_t empty_filler = 2 + 2 + 4;
    if (end - out.size() > empty_filler) {
        const std::size_t size = end - out.size() - empty_filler - 1;
        text("_");
        text("_");
        number(size);
        out.resize(out.size() + size);
    }
    out.push_back(std::byte{0});
}

}  // namespace diptych::exr
