// SPDX-License-Identifier: MIT
#include "shared/image/radiance.h"

#include "shared/image/atomic_file.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// ---- header ------------------------------------------------------------------------------------------

// The unread bytes.
class RadianceCursor {
public:
    explicit RadianceCursor(std::span<const std::byte> rest) : rest_(rest) {}

    std::size_t left() const { return rest_.size(); }
    std::uint8_t peek(std::size_t at) const {
        return at < rest_.size() ? std::to_integer<std::uint8_t>(rest_[at]) : 0;
    }
    std::uint8_t byte() {
        if (rest_.empty()) fail("is cut short");
        const auto value = std::to_integer<std::uint8_t>(rest_[0]);
        rest_ = rest_.subspan(1);
        return value;
    }
    Rgbe pixel() {
        Rgbe value;
        for (std::uint8_t& part : value) part = byte();
        return value;
    }
    std::string_view line() {
        const std::string_view text(reinterpret_cast<const char*>(rest_.data()), rest_.size());
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) fail("its header has no end");
        rest_ = rest_.subspan(end + 1);
        return text.substr(0, end > 0 && text[end - 1] == '\r' ? end - 1 : end);
    }

private:
    std::span<const std::byte> rest_;
};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

// Parses the next word completely as a T; `text` becomes the rest.
template <class T>
bool takeNumber(std::string_view& text, T& value) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    const char* end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && rest == end && !word.empty();
}

// Stored lines run along the second axis of the resolution line, and follow each other along the first.
struct Orientation {
    bool columns = false;  // a stored line is an image column
    bool right_to_left = false, bottom_to_top = false;
};

struct RadianceHeader {
    std::array<double, 3> scale{1, 1, 1};  // factor from stored values to radiance
    double aspect = 1;                     // of a pixel's sides; several PIXASPECTs multiply
    std::optional<Primaries> primaries{};
    Orientation orientation;
    int width = 0, height = 0;
};

void readVariable(std::string_view line, RadianceHeader& header) {
    const std::size_t equals = line.find('=');
    if (line.starts_with('#') || equals == std::string_view::npos) return;
    const std::string_view name = trimmed(line.substr(0, equals));
    std::string_view value = trimmed(line.substr(equals + 1));
    if (name == "FORMAT") {
        if (value == "32-bit_rle_xyze")
            fail("FORMAT 32-bit_rle_xyze (CIE XYZ) is not supported; use 32-bit_rle_rgbe");
        if (value != "32-bit_rle_rgbe")
            fail(fmt::format("FORMAT {} is not 32-bit_rle_rgbe", oneLine(value, 60)));
        return;
    }
    if (name == "PRIMARIES") {
        Primaries primaries{};
        if (!std::ranges::all_of(primaries, [&](double& part) { return takeNumber(value, part); }))
            fail(fmt::format("{} is not eight numbers", oneLine(line, 60)));
        header.primaries = primaries;
    }
    if (double aspect = 0; name == "PIXASPECT" && takeNumber(value, aspect)) header.aspect *= aspect;
    // Each line gives a factor that was applied to the radiance; all of them multiply.
    const std::size_t count = name == "EXPOSURE" ? 1 : name == "COLORCORR" ? 3 : 0;
    std::string_view rest = value;
    for (std::size_t c = 0; c < count; ++c) {
        double factor = 0;
        if (!takeNumber(rest, factor) || !(factor > 0) || !std::isfinite(factor))
            fail(fmt::format("{}={} is not {} above 0", name, oneLine(value, 60),
                             count == 1 ? "a number" : "three numbers"));
        for (std::size_t to = c; to < (count == 1 ? 3 : c + 1); ++to) header.scale[to] /= factor;
    }
}

// "-Y 480 +X 640" and the other seven orientations. Y points up, so -Y starts at the top.
void readResolution(std::string_view line, RadianceHeader& header) {
    const auto malformed = [&] {
        fail(fmt::format("resolution \"{}\" is not like -Y 480 +X 640", oneLine(line, 60)));
    };
    std::string_view rest = line;
    char axes[2]{};
    for (char& axis : axes) {
        rest = trimmed(rest);
        const char sign = rest.empty() ? '\0' : rest[0];
        axis = rest.size() < 2 ? '\0' : rest[1];
        if ((sign != '-' && sign != '+') || (axis != 'X' && axis != 'Y')) malformed();
        rest.remove_prefix(2);
        if (!takeNumber(rest, axis == 'X' ? header.width : header.height)) malformed();
        if (axis == 'X') header.orientation.right_to_left = sign == '-';
        if (axis == 'Y') header.orientation.bottom_to_top = sign == '+';
    }
    if (axes[0] == axes[1] || !trimmed(rest).empty()) malformed();
    header.orientation.columns = axes[0] == 'X';
}

RadianceHeader readHeader(RadianceCursor& in) {
    if (in.peek(0) != '#' || in.peek(1) != '?') fail("is not a Radiance picture: it does not begin with #?");
    RadianceHeader header;
    in.line();
    for (std::string_view line = in.line(); !line.empty(); line = in.line()) readVariable(line, header);
    readResolution(in.line(), header);
    return header;
}

// ---- pixels ------------------------------------------------------------------------------------------

// Line lengths for which run-length coding by component is defined; others are stored by pixel.
constexpr std::size_t shortest_run_line = 8, longest_run_line = 32767;

// Plain pixels, or 1, 1, 1, n: repeat the previous pixel n times. Counts of consecutive runs are digits of
// base 256, lowest first.
void readOldLine(RadianceCursor& in, std::span<Rgbe> line) {
    int shift = 0;
    for (std::size_t x = 0; x < line.size();) {
        const Rgbe pixel = in.pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        if (x == 0) fail("a line begins with a run");
        const std::size_t run = shift < 24 ? std::size_t{pixel[3]} << shift : 0;
        if (run > line.size() - x || shift >= 24) fail("a run is longer than its line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), run, line[x - 1]);
        x += run;
        shift += 8;
    }
}

// Each component: a count up to 128 and as many bytes, or 128 + count and a byte to repeat.
void readNewLine(RadianceCursor& in, std::span<Rgbe> line) {
    for (std::size_t component = 0; component < 4; ++component)
        for (std::size_t x = 0; x < line.size();) {
            const std::size_t code = in.byte();
            const std::size_t count = code > 128 ? code - 128 : code;
            if (count == 0 || count > line.size() - x) fail("a run is longer than its line");
            std::uint8_t value = 0;
            for (std::size_t i = 0; i < count; ++i) {
                if (i == 0 || code <= 128) value = in.byte();
                line[x++][component] = value;
            }
        }
}

void readLine(RadianceCursor& in, std::span<Rgbe> line) {
    const std::size_t length = line.size();
    if (length < shortest_run_line || length > longest_run_line || in.peek(0) != 2 || in.peek(1) != 2 ||
        in.peek(2) > 127)
        return readOldLine(in, line);
    const Rgbe mark = in.pixel();
    const std::size_t marked = std::size_t{mark[2]} << 8 | mark[3];
    if (marked != length) fail(fmt::format("a line has {} pixels instead of {}", marked, length));
    readNewLine(in, line);
}

// A mantissa decodes to the middle of its step, as in Radiance.
float decoded(std::uint8_t mantissa, std::uint8_t exponent, double scale) {
    if (exponent == 0) return 0;
    return static_cast<float>(std::ldexp(mantissa + 0.5, exponent - (128 + 8)) * scale);
}

HdrImage readImage(std::span<const std::byte> bytes, std::uint64_t max) {
    RadianceCursor in(bytes);
    const RadianceHeader header = readHeader(in);
    const Orientation& order = header.orientation;
    checkImageSize(header.width, header.height, 3 * sizeof(float), max);
    const int lines = order.columns ? header.width : header.height;
    const int length = order.columns ? header.height : header.width;
    constexpr std::size_t shortest_line = 4;  // for a line of one pixel; longer lines need more
    if (in.left() / shortest_line < static_cast<std::size_t>(lines))
        failToHold(header.width, header.height, bytes.size());
    constexpr double largest = std::numeric_limits<float>::max();
    for (const double scale : header.scale)
        if (!(scale > 0 && scale * std::ldexp(255.5, 255 - 136) <= largest))
            fail("EXPOSURE and COLORCORR scale its values beyond the range of float");

    std::vector<Rgbe> line(static_cast<std::size_t>(length));
    // A line may take as few as 12 bytes (old runs). Before much memory is allocated, a first pass checks
    // that all lines exist.
    constexpr std::size_t much = std::size_t{1} << 28;
    const auto bytesOfImage =
        3 * sizeof(float) * static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
    if (RadianceCursor ahead = in; bytesOfImage > much)
        for (int i = 0; i < lines; ++i) readLine(ahead, line);

    Image image(header.width, header.height, 3);
    for (int i = 0; i < lines; ++i) {
        readLine(in, line);
        for (int j = 0; j < length; ++j) {
            const int x = order.columns ? i : j, y = order.columns ? j : i;
            float* to = image.data.data() + image.offset(order.right_to_left ? header.width - 1 - x : x,
                                                         order.bottom_to_top ? header.height - 1 - y : y);
            const Rgbe& pixel = line[static_cast<std::size_t>(j)];
            for (std::size_t c = 0; c < 3; ++c) to[c] = decoded(pixel[c], pixel[3], header.scale[c]);
        }
    }
    HdrImage hdr{std::move(image)};
    if (header.scale != std::array<double, 3>{1, 1, 1})
        hdr.notes.lines.push_back(
            fmt::format("its values were multiplied by {:.6g} {:.6g} {:.6g} (its EXPOSURE and COLORCORR)",
                        header.scale[0], header.scale[1], header.scale[2]));
    noteAspect(header.aspect, hdr.notes);
    if (header.primaries)
        if (const auto matrix = matrixToRec709(*header.primaries, hdr.notes))
            convertColors(hdr.image, *matrix);
    return hdr;
}

// ---- writing -----------------------------------------------------------------------------------------

// Sets `fits` to false if RGBE cannot represent a component.
Rgbe encoded(const float* rgb, bool& fits) {
    constexpr float largest = 0x1.fep126f;  // mantissa 255 at exponent 255
    std::array<float, 3> held{};
    for (std::size_t c = 0; c < 3; ++c) {
        held[c] = rgb[c] > 0 ? std::min(rgb[c], largest) : 0.0f;
        if (held[c] != rgb[c]) fits = false;
    }
    const float peak = std::max({held[0], held[1], held[2]});
    constexpr float smallest = 0x1p-128f;  // mantissa 128 at exponent 1
    if (peak < smallest) {
        if (peak > 0) fits = false;
        return {0, 0, 0, 0};
    }
    int exponent = 0;
    std::frexp(peak, &exponent);
    Rgbe pixel{0, 0, 0, static_cast<std::uint8_t>(exponent + 128)};
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(std::ldexp(held[c], 8 - exponent));
    return pixel;
}

// Appends one component of a line: runs of at least four bytes, and the bytes between runs verbatim.
void appendRuns(std::vector<std::uint8_t>& out, const std::vector<Rgbe>& line, std::size_t component) {
    constexpr std::size_t shortest_run = 4, longest_run = 127, longest_dump = 128;
    const auto runAt = [&](std::size_t x) {
        std::size_t end = x + 1;
        while (end < line.size() && end - x < longest_run && line[end][component] == line[x][component])
            ++end;
        return end - x;
    };
    for (std::size_t x = 0; x < line.size();) {
        std::size_t run = runAt(x), end = x;
        if (run >= shortest_run) {
            out.push_back(static_cast<std::uint8_t>(128 + run));
            out.push_back(line[x][component]);
            x += run;
            continue;
        }
        while (end < line.size() && end - x < longest_dump && (run = runAt(end)) < shortest_run)
            end = std::min(end + run, x + longest_dump);
        out.push_back(static_cast<std::uint8_t>(end - x));
        for (; x < end; ++x) out.push_back(line[x][component]);
    }
}

}  // namespace

ImageSize hdrSize(std::span<const std::byte> bytes) {
    RadianceCursor in(bytes);
    const RadianceHeader header = readHeader(in);
    return {header.width, header.height, 3 * sizeof(float)};
}

HdrImage readHdr(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    return named(name, [&] { return readImage(bytes, max); });
}

std::size_t writeHdr(const std::filesystem::path& file, const Image& image) {
    if (image.width < 1 || image.height < 1 || image.components != 3 ||
        image.data.size() != 3 * image.pixels())
        throw std::runtime_error(fmt::format("{}: a Radiance picture is not {}x{}x{}", file.string(),
                                             image.width, image.height, image.components));
    const std::string header = fmt::format(
        "#?RADIANCE\nSOFTWARE=diptych\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
    std::vector<std::uint8_t> out(header.begin(), header.end());
    const auto width = static_cast<std::size_t>(image.width);
    const bool runs = width >= shortest_run_line && width <= longest_run_line;
    std::vector<Rgbe> line(width);
    std::size_t beyond = 0;
    AtomicFile to(file);
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            bool fits = true;
            line[x] = encoded(image.pixel(y * width + x), fits);
            beyond += fits ? 0 : 1;
        }
        if (runs) {
            out.insert(out.end(),
                       {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width & 255)});
            for (std::size_t component = 0; component < 4; ++component) appendRuns(out, line, component);
        } else {
            for (const Rgbe& pixel : line) out.insert(out.end(), pixel.begin(), pixel.end());
        }
        std::fwrite(out.data(), 1, out.size(), to.stream());
        out.clear();
    }
    to.commit();
    return beyond;
}

}  // namespace diptych
