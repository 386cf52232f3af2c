// SPDX-License-Identifier: MIT
// Source: "OpenEXR File Layout", the format's own description (openexr.com).
#include "shared/image/exr_header.h"

#include "shared/image/limits.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR files are little-endian");

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what);
}

// What has not been read yet, from the front.
class Cursor {
public:
    explicit Cursor(Bytes rest) : rest_(rest) {}

    std::size_t left() const { return rest_.size(); }
    Bytes take(std::size_t count) {
        if (count > rest_.size()) fail("its header is cut short");
        const Bytes taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    template <class T>
    T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    // Up to its null character.
    std::string name() {
        constexpr std::size_t longest = 255;  // the format's, with long names allowed
        const auto* text = reinterpret_cast<const char*>(rest_.data());
        const std::size_t size = std::string_view(text, std::min(rest_.size(), longest + 1)).find('\0');
        if (size == std::string_view::npos) fail("its header holds a name without an end");
        take(size + 1);
        return {text, size};
    }

private:
    Bytes rest_;
};

// The attributes that the pixels need. Others (previews, histories, manifests of any claimed size) are not
// handed on.
struct Kept {
    std::string_view name, type;
    std::size_t size;  // 0: any
    bool parts_only;   // means something only among several parts
};
constexpr std::array kept{
    Kept{"channels", "chlist", 0, false},
    Kept{"compression", "compression", 1, false},
    Kept{"dataWindow", "box2i", 16, false},
    Kept{"displayWindow", "box2i", 16, false},
    Kept{"lineOrder", "lineOrder", 1, false},
    Kept{"pixelAspectRatio", "float", 4, false},
    Kept{"screenWindowCenter", "v2f", 8, false},
    Kept{"screenWindowWidth", "float", 4, false},
    Kept{"tiles", "tiledesc", 9, false},
    Kept{"name", "string", 0, true},
    Kept{"type", "string", 0, true},
    Kept{"chunkCount", "int", 4, true},
};

// By the number in the attribute "compression": lines a chunk, and the most that one stored byte unfolds to.
struct Compressor {
    int lines;
    double ratio;
};
constexpr std::array compressors{
    Compressor{1, 1},                               // none
    Compressor{1, 64},                              // RLE: two bytes are up to 128
    Compressor{1, limits::deflate_ratio},           // ZIPS
    Compressor{16, limits::deflate_ratio},          // ZIP
    Compressor{32, 512},                            // PIZ: nine bits repeat a 16 bit value up to 255 times
    Compressor{16, limits::deflate_ratio * 4 / 3},  // PXR24: three of a float's bytes, deflated
    Compressor{32, 3},                              // B44: 14 bytes are 16 halves
    Compressor{32, 11},                             // B44A: or three bytes
    Compressor{32, limits::deflate_ratio * 64},     // DWAA: 8 x 8 floats are two coefficients, deflated
    Compressor{256, limits::deflate_ratio * 64},    // DWAB
};

struct Part {
    std::map<std::string, Bytes, std::less<>> attributes;  // the kept ones' values
    Bytes all;                                             // with the null character at the end
};

// Attributes up to the empty name that ends them; none at all at the end of several parts.
Part readPart(Cursor& in, Bytes from, bool several) {
    Part part;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        const std::string type = in.name();
        if (type.empty()) fail(fmt::format("attribute {}: has no type", oneLine(name)));
        const auto size = in.number<std::int32_t>();
        if (size < 0 || static_cast<std::size_t>(size) > in.left())
            fail(
                fmt::format("attribute {}: {} bytes of {} left in the file", oneLine(name), size, in.left()));
        const Bytes value = in.take(static_cast<std::size_t>(size));
        const auto known = std::ranges::find(kept, name, &Kept::name);
        if (known == kept.end() || (known->parts_only && !several)) continue;
        if (type != known->type || (known->size != 0 && value.size() != known->size))
            fail(fmt::format("attribute {}: {} of {} bytes where {} stands", name, oneLine(type), size,
                             known->type));
        if (!part.attributes.emplace(name, value).second)
            fail(fmt::format("attribute {}: stands twice", name));
    }
    part.all = from.first(from.size() - in.left());
    return part;
}

Cursor valueOf(const Part& part, std::string_view name) {
    const auto at = part.attributes.find(name);
    if (at == part.attributes.end()) fail(fmt::format("attribute {}: is missing", name));
    return Cursor(at->second);
}

ExrWindow windowOf(const Part& part, std::string_view name) {
    Cursor in = valueOf(part, name);
    ExrWindow window;
    for (std::int32_t* end : {&window.min_x, &window.min_y, &window.max_x, &window.max_y})
        *end = in.number<std::int32_t>();
    // OpenEXR's own limit, which keeps its sums inside 32 bits.
    constexpr std::int32_t farthest = 1 << 29;
    for (const std::int32_t end : {window.min_x, window.min_y, window.max_x, window.max_y})
        if (end < -farthest || end > farthest) fail(fmt::format("attribute {}: ends at {}", name, end));
    return window;
}

// Names and, of all together, bytes a pixel.
std::int64_t readChannels(const Part& part, std::vector<std::string>& names) {
    Cursor in = valueOf(part, "channels");
    std::int64_t bytes = 0;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        const auto type = in.number<std::int32_t>();
        in.take(4);  // pLinear and three reserved bytes
        const auto xSampling = in.number<std::int32_t>(), ySampling = in.number<std::int32_t>();
        if (type < 0 || type > 2) fail(fmt::format("channel {}: pixels of type {}", oneLine(name), type));
        if (xSampling != 1 || ySampling != 1)
            fail(fmt::format("channel {} is subsampled, which is not read", oneLine(name)));
        if (std::ranges::count(names, name) > 0) fail(fmt::format("channel {}: stands twice", oneLine(name)));
        names.push_back(name);
        if (std::ssize(names) > limits::image_channels)
            fail(fmt::format("has over {} channels", limits::image_channels));
        constexpr int half = 1;
        bytes += type == half ? 2 : 4;
    }
    if (in.left() > 0) fail("attribute channels: goes on behind its end");
    if (names.empty()) fail("has no channels");
    return bytes;
}

struct Tiles {
    std::int64_t width = 0, height = 0;  // 0: scan lines
};

Tiles tilesOf(const Part& part, bool tiled) {
    if (!tiled) return {};
    Cursor in = valueOf(part, "tiles");
    const auto width = in.number<std::uint32_t>(), height = in.number<std::uint32_t>();
    if (width < 1 || height < 1 || width > limits::image_side || height > limits::image_side)
        fail(fmt::format("tiles of {} x {} pixels: 1 to {} a side are read", width, height,
                         limits::image_side));
    return {width, height};
}

// Every chunk of a part has eight bytes in a table, which OpenEXR makes before it looks whether they are
// there.
std::uint64_t tableBytes(const ExrWindow& window, const Tiles& tiles, int lines) {
    const auto over = [](std::int64_t size, std::int64_t step) { return (size + step - 1) / step; };
    const std::int64_t chunks = tiles.width > 0
                                    ? over(window.width(), tiles.width) * over(window.height(), tiles.height)
                                    : over(window.height(), lines);
    return 8 * static_cast<std::uint64_t>(chunks);
}

// A display window is filled with zeros that stand in no file: so much of it is allowed around the pixels of
// a crop, and a whole frame of 8192 x 8192 float32 RGBA around the smallest.
std::uint64_t displayBytes(std::int64_t dataBytes, std::uint64_t most) {
    constexpr std::uint64_t around = 256, always = std::uint64_t{1} << 30;
    return std::min(most, std::max(around * static_cast<std::uint64_t>(dataBytes), always));
}

// The kept attributes and a filler in the room of the whole.
void append(std::vector<std::byte>& out, const Part& part) {
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
        const auto value = part.attributes.find(attribute.name);
        if (value == part.attributes.end()) continue;
        text(attribute.name);
        text(attribute.type);
        number(value->second.size());
        out.insert(out.end(), value->second.begin(), value->second.end());
    }
    // The shortest attribute that can have been left out, a name and a type of one letter, is as long as an
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

}  // namespace

ExrHeader readExrHeader(Bytes file, std::uint64_t most) {
    constexpr std::uint32_t magic = 20000630, version_bits = 0xff, tiled_bit = 0x200, deep_bit = 0x800,
                            parts_bit = 0x1000, known_bits = 0x1eff;
    Cursor in(file);
    if (file.size() < 8 || in.number<std::uint32_t>() != magic) fail("is not an EXR file");
    const auto flags = in.number<std::uint32_t>();
    if ((flags & version_bits) != 2) fail(fmt::format("EXR version {}, not 2", flags & version_bits));
    if ((flags & ~known_bits) != 0) fail(fmt::format("has the unknown flags {:#x}", flags & ~known_bits));
    const bool several = (flags & parts_bit) != 0;

    ExrHeader header;
    header.bytes.assign(file.begin(), file.begin() + 8);
    std::uint64_t tables = 0;
    for (bool first = true; first || several; first = false) {
        const Part part = readPart(in, file.last(in.left()), several);
        if (several && !first && part.all.size() == 1) {  // the empty header that ends them
            append(header.bytes, part);
            break;
        }
        const auto type = part.attributes.find("type");
        const std::string_view kind =
            type == part.attributes.end()
                ? std::string_view()
                : std::string_view(reinterpret_cast<const char*>(type->second.data()), type->second.size());
        const bool deep =
            kind == "deepscanline" || kind == "deeptile" || (!several && (flags & deep_bit) != 0);
        if (several && !deep && kind != "scanlineimage" && kind != "tiledimage")
            fail(fmt::format("a part is of type \"{}\"", oneLine(kind)));
        if (first && deep) fail("holds deep samples, which are not read");

        const auto compression = valueOf(part, "compression").number<std::uint8_t>();
        if (compression >= compressors.size()) fail(fmt::format("compression {} is not known", compression));
        const Compressor& compressor = compressors[compression];
        const Tiles tiles =
            tilesOf(part, several ? kind == "tiledimage" || kind == "deeptile" : (flags & tiled_bit) != 0);
        const ExrWindow window = windowOf(part, "dataWindow"), display = windowOf(part, "displayWindow");
        if (window.width() < 1 || window.height() < 1) fail("has no pixels");
        tables += tableBytes(window, tiles, compressor.lines);
        if (tables > file.size()) failToHold(window.width(), window.height(), file.size());
        append(header.bytes, part);
        if (!first) continue;

        header.data = window;
        header.display = display;
        const std::int64_t stored = readChannels(part, header.channels),
                           floats = 4 * std::ssize(header.channels);
        checkImageSize(window.width(), window.height(), floats, most);
        checkImageSize(display.width(), display.height(), floats,
                       displayBytes(window.width() * window.height() * floats, most));
        // OpenEXR decodes whole chunks: rows of tiles, or a compressor's block of lines.
        constexpr std::int64_t small_tile = 4096;
        if (tiles.width > std::max(window.width(), small_tile) ||
            tiles.height > std::max(window.height(), small_tile))
            fail(fmt::format("tiles of {} x {} pixels for {} x {}", tiles.width, tiles.height, window.width(),
                             window.height()));
        checkImageSize(std::max(window.width(), tiles.width),
                       tiles.width > 0 ? tiles.height : std::int64_t{compressor.lines}, floats, most);
        header.stored_bytes = static_cast<std::uint64_t>(window.width() * window.height() * stored);
        if (static_cast<double>(header.stored_bytes) > compressor.ratio * static_cast<double>(file.size()))
            failToHold(window.width(), window.height(), file.size());
    }
    return header;
}

}  // namespace diptych
