// SPDX-License-Identifier: MIT
// Source: "OpenEXR File Layout" (openexr.com).
#include "shared/image/exr_header.h"

#include "shared/image/exr_attributes.h"
#include "shared/image/limits.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace diptych {
namespace {

using exr::Attributes;
using exr::Cursor;

// By value of "compression": lines per chunk, and the largest expansion of one stored byte.
struct Compressor {
    int lines;
    double ratio;
};
constexpr std::array compressors{
    Compressor{1, 1},                               // none
    Compressor{1, 64},                              // RLE: two bytes expand to up to 128
    Compressor{1, limits::deflate_ratio},           // ZIPS
    Compressor{16, limits::deflate_ratio},          // ZIP
    Compressor{32, 512},                            // PIZ: nine bits repeat a 16-bit value up to 255 times
    Compressor{16, limits::deflate_ratio * 4 / 3},  // PXR24: three of a float's four bytes, deflated
    Compressor{32, 3},                              // B44: 14 bytes for 16 halves
    Compressor{32, 11},                             // B44A: or three bytes
    Compressor{32, limits::deflate_ratio * 64},     // DWAA: two coefficients for 8 x 8 floats, deflated
    Compressor{256, limits::deflate_ratio * 64},    // DWAB
};

const Compressor& compressorOf(const Attributes& part) {
    const auto compression = part.valueOf("compression").number<std::uint8_t>();
    if (compression >= compressors.size()) fail(fmt::format("unknown compression {}", compression));
    return compressors[compression];
}

ExrWindow windowOf(const Attributes& part, std::string_view name) {
    Cursor in = part.valueOf(name);
    ExrWindow window;
    for (std::int32_t* end : {&window.min_x, &window.min_y, &window.max_x, &window.max_y})
        *end = in.number<std::int32_t>();
    // OpenEXR's own limit, so that sums of coordinates fit into 32 bits.
    constexpr std::int32_t farthest = 1 << 29;
    for (const std::int32_t end : {window.min_x, window.min_y, window.max_x, window.max_y})
        if (end < -farthest || end > farthest)
            fail(fmt::format("attribute {}: coordinate {} is out of range", name, end));
    return window;
}

// OpenEXR's RgbaFile writes luminance, Y, at full size and two colour differences at a quarter of it.
[[noreturn]] void failToSample(const std::string& name) {
    const std::string component = name.substr(name.rfind('.') + 1);
    fail(fmt::format("channel {} is subsampled, which is not supported{}", oneLine(name),
                     component == "RY" || component == "BY"
                         ? ": the file has luminance and chroma (Y, RY, BY) instead of R, G, B"
                         : ""));
}

// Rejects subsampled channels if the part is `wanted`.
std::vector<ExrChannel> channelsOf(const Attributes& part, bool wanted) {
    Cursor in = part.valueOf("channels");
    std::vector<ExrChannel> channels;
    std::set<std::string> names;
    std::string subsampled;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        if (name.find('\n') != name.npos)
            fail(fmt::format("channel {}: has a line break in its name", oneLine(name)));
        const auto type = in.number<std::int32_t>();
        in.take(4);  // pLinear and three reserved bytes
        const auto xSampling = in.number<std::int32_t>(), ySampling = in.number<std::int32_t>();
        if (type < 0 || type > 2) fail(fmt::format("channel {}: unknown pixel type {}", oneLine(name), type));
        if ((xSampling != 1 || ySampling != 1) && subsampled.empty()) subsampled = name;
        if (!names.insert(name).second) fail(fmt::format("channel {}: appears twice", oneLine(name)));
        channels.push_back({name, static_cast<ExrSample>(type)});
        if (std::ssize(channels) > limits::image_channels)
            fail(fmt::format("has over {} channels", limits::image_channels));
    }
    if (in.left() > 0) fail("attribute channels: has data after its end");
    if (channels.empty()) fail("has no channels");
    if (wanted && !subsampled.empty()) failToSample(subsampled);
    return channels;
}

struct Tiles {
    std::int64_t width = 0, height = 0;  // 0: scan lines
    int levels = 0;                      // mip levels: 1 halves both sides together, 2 separately
};

Tiles tilesOf(const Attributes& part, bool tiled) {
    if (!tiled) return {};
    Cursor in = part.valueOf("tiles");
    const auto width = in.number<std::uint32_t>(), height = in.number<std::uint32_t>();
    if (width < 1 || height < 1 || width > limits::image_side || height > limits::image_side)
        fail(fmt::format("tiles of {} x {} pixels: each side must be 1 to {}", width, height,
                         limits::image_side));
    const int levels = in.number<std::uint8_t>() & 0x0f;
    if (levels > 2) fail(fmt::format("unknown level mode {} of tiles", levels));
    return {width, height, levels};
}

// OpenEXR allocates a table of eight bytes per chunk before it checks the file's size.
std::uint64_t tableBytes(const ExrWindow& window, const Tiles& tiles, int lines) {
    const auto over = [](std::int64_t size, std::int64_t step) { return (size + step - 1) / step; };
    const std::int64_t chunks = tiles.width > 0
                                    ? over(window.width(), tiles.width) * over(window.height(), tiles.height)
                                    : over(window.height(), lines);
    return 8 * static_cast<std::uint64_t>(chunks);
}

// The display window is padded with zeros that are not in the file. So a small crop could claim much
// memory. The window may need at most 256 times the bytes of the pixels, or 1 GiB (8192 x 8192 float32
// RGBA), whichever is more.
std::uint64_t displayBytes(std::uint64_t dataBytes, std::uint64_t max) {
    constexpr std::uint64_t around = 256, always = std::uint64_t{1} << 30;
    return std::min(max, std::max(around * dataBytes, always));
}

// Sums over the parts read so far.
struct Claims {
    // Bytes of chunk tables, of decoded pixels, and of display windows.
    std::uint64_t tables = 0, data = 0, display = 0;
    double min_file = 0;  // least bytes of the pixels in the file, at the best compression
};

std::int64_t storedBytes(const std::vector<ExrChannel>& channels) {
    std::int64_t bytes = 0;
    for (const ExrChannel& channel : channels) bytes += channel.sample == ExrSample::half ? 2 : 4;
    return bytes;
}
// 4 bytes for float32, and another 4 for each uint32 channel.
std::int64_t decodedBytes(const std::vector<ExrChannel>& channels) {
    return 4 * (std::ssize(channels) + std::ranges::count(channels, ExrSample::uint, &ExrChannel::sample));
}

// Reads colour space and pixel aspect.
std::optional<glm::dmat3> meaningOf(const Attributes& part, FileNotes& notes) {
    if (part.needed.contains("pixelAspectRatio"))
        noteAspect(part.valueOf("pixelAspectRatio").number<float>(), notes);
    if (const auto white = part.meaning.find("whiteLuminance"); white != part.meaning.end())
        notes.not_applied.push_back(fmt::format("its white luminance of {:.6g} cd/m2 is not applied",
                                                Cursor(white->second).number<float>()));
    const auto chromaticities = part.meaning.find("chromaticities");
    if (chromaticities == part.meaning.end()) return {};
    Cursor in(chromaticities->second);
    Primaries primaries{};
    for (double& part_of : primaries) part_of = in.number<float>();
    return matrixToRec709(primaries, notes);
}

struct Reader {
    std::span<const std::byte> file;
    std::uint64_t max;
    std::string_view asked;
    std::uint32_t flags;
    ExrHeader header{};
    Claims claims{};

    bool several() const { return (flags & 0x1000) != 0; }
    bool isDeep(std::string_view kind) const {
        return kind == "deepscanline" || kind == "deeptile" || (!several() && (flags & 0x800) != 0);
    }
    bool isTiled(std::string_view kind) const {
        return several() ? kind == "tiledimage" || kind == "deeptile" : (flags & 0x200) != 0;
    }
    void readPart(const Attributes& attributes, int number);
    void checkClaims(const ExrPart& part, const ExrWindow& display, const Tiles& tiles,
                     const Compressor& compressor);
    void take(const Attributes& attributes, ExrPart part, const Tiles& tiles, const Compressor& compressor);
};

void Reader::readPart(const Attributes& attributes, int number) {
    const std::string_view kind = several() ? attributes.textOf("type") : std::string_view();
    const std::string_view name = attributes.textOf("name");
    if (name.find('\n') != name.npos) fail("has a line break in its name");
    const bool deep = isDeep(kind),
               wanted = asked.empty() || asked == name || asked == std::to_string(number);
    if (several() && !deep && kind != "scanlineimage" && kind != "tiledimage")
        fail(fmt::format("has the unknown type \"{}\"", oneLine(kind)));
    if (wanted && deep) fail("holds deep samples, which are not supported");
    const Compressor& compressor = compressorOf(attributes);
    const Tiles tiles = tilesOf(attributes, isTiled(kind));
    const ExrWindow window = windowOf(attributes, "dataWindow");
    if (window.width() < 1 || window.height() < 1) fail("has no pixels");
    claims.tables += tableBytes(window, tiles, compressor.lines);
    if (claims.tables > file.size()) failToHold(window.width(), window.height(), file.size());
    std::vector<ExrChannel> channels = channelsOf(attributes, wanted);
    if (!wanted) return;
    const std::int64_t pixel = storedBytes(channels), chunk = tiles.width > 0
                                                                  ? tiles.width * tiles.height
                                                                  : window.width() * compressor.lines;
    take(attributes,
         {number, several() && asked.empty() ? std::string(name) : "", window, std::move(channels),
          static_cast<std::uint64_t>(window.width() * window.height() * pixel),
          static_cast<std::uint64_t>(chunk * pixel)},
         tiles, compressor);
}

void Reader::checkClaims(const ExrPart& part, const ExrWindow& display, const Tiles& tiles,
                         const Compressor& compressor) {
    const ExrWindow& window = part.data;
    const std::int64_t pixel = decodedBytes(part.channels);
    checkImageSize(window.width(), window.height(), pixel, max);
    const auto data = static_cast<std::uint64_t>(window.width() * window.height() * pixel);
    checkImageSize(display.width(), display.height(), pixel, displayBytes(data, max));
    // OpenEXR decodes whole chunks (rows of tiles or blocks of lines), which may exceed the image.
    constexpr std::int64_t small_tile = 4096;
    if (tiles.width > std::max(window.width(), small_tile) ||
        tiles.height > std::max(window.height(), small_tile))
        fail(fmt::format("tiles of {} x {} pixels are larger than the image of {} x {}", tiles.width,
                         tiles.height, window.width(), window.height()));
    checkImageSize(std::max(window.width(), tiles.width),
                   tiles.width > 0 ? tiles.height : std::int64_t{compressor.lines}, pixel, max);
    claims.min_file += static_cast<double>(part.stored_bytes) / compressor.ratio;
    if (claims.min_file > static_cast<double>(file.size()))
        failToHold(window.width(), window.height(), file.size());
    claims.data += data;
    claims.display += static_cast<std::uint64_t>(display.width() * display.height() * pixel);
    const std::uint64_t allowed = displayBytes(claims.data, max);
    if (claims.data > max || claims.display > allowed)
        fail(fmt::format("this part and the parts before it claim {} MiB; the limit is {} MiB",
                         std::max(claims.data, claims.display) >> 20, allowed >> 20));
}

void Reader::take(const Attributes& attributes, ExrPart part, const Tiles& tiles,
                  const Compressor& compressor) {
    const ExrWindow display = windowOf(attributes, "displayWindow");
    checkClaims(part, display, tiles, compressor);
    if (header.parts.empty()) header.display = display;
    if (display != header.display)
        fail(fmt::format(
            "its display window is {} x {} at {}, {}, but {} x {} at {}, {} in the parts before it; read one "
            "part, for example FILE.exr?part={}",
            display.width(), display.height(), display.min_x, display.min_y, header.display.width(),
            header.display.height(), header.display.min_x, header.display.min_y, part.index));
    FileNotes notes;
    if (tiles.levels > 0)
        notes.in_part.push_back(
            fmt::format("is {}-mapped; only its largest level is read", tiles.levels == 1 ? "mip" : "rip"));
    part.to_rec709 = meaningOf(attributes, notes);
    const std::string who = part.name.empty() ? "" : fmt::format("part \"{}\": ", oneLine(part.name, 60));
    for (const auto& [from, to] : {std::pair{&notes.lines, &header.notes.lines},
                                   {&notes.not_applied, &header.notes.not_applied},
                                   {&notes.in_part, &header.notes.in_part}})
        for (const std::string& line : *from) to->push_back(who + line);
    for (const auto& [name, value] : attributes.strings) header.attributes.emplace(name, std::string(value));
    header.parts.push_back(std::move(part));
}

}  // namespace

ExrHeader readExrHeader(std::span<const std::byte> file, std::uint64_t max, std::string_view asked) {
    constexpr std::uint32_t magic = 20000630, version_bits = 0xff, known_bits = 0x1eff;
    Cursor in(file);
    if (file.size() < 8 || in.number<std::uint32_t>() != magic) fail("is not an EXR file");
    const auto flags = in.number<std::uint32_t>();
    if ((flags & version_bits) != 2) fail(fmt::format("EXR version {}, not 2", flags & version_bits));
    if ((flags & ~known_bits) != 0) fail(fmt::format("has the unknown flags {:#x}", flags & ~known_bits));

    Reader reader{file, max, asked, flags};
    ExrHeader& header = reader.header;
    header.bytes.assign(file.begin(), file.begin() + 8);
    for (int number = 0; number == 0 || reader.several(); ++number) {
        const Attributes part = exr::readAttributes(in, file.last(in.left()), reader.several());
        exr::append(header.bytes, part);
        if (reader.several() && number > 0 && part.all.size() == 1) break;  // the empty header at the end
        if (number >= limits::image_parts) fail(fmt::format("has over {} parts", limits::image_parts));
        if (reader.several())
            named(fmt::format("part \"{}\"", oneLine(part.textOf("name"), 60)),
                  [&] { reader.readPart(part, number); });
        else
            reader.readPart(part, number);
    }
    if (header.parts.empty()) fail(fmt::format("has no part \"{}\"", oneLine(asked)));
    return std::move(header);
}

}  // namespace diptych
