// SPDX-License-Identifier: MIT
#include "shared/image/pfm.h"

#include "shared/image/atomic_file.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

static_assert(std::endian::native == std::endian::little, "a scale below 0 says little-endian");

constexpr std::string_view blanks = " \t\n\v\f\r";

// Returns the next word, without leading blanks; `rest` begins after the one blank that ends it.
std::string_view takeWord(std::string_view& rest) {
    constexpr std::size_t longest = 64;  // longer than any number
    const std::size_t begin = rest.find_first_not_of(blanks);
    if (begin == rest.npos) fail("its header is cut short");
    const std::string_view from = rest.substr(begin);
    const std::size_t size = from.substr(0, longest + 1).find_first_of(blanks);
    if (size == from.npos)
        fail(from.size() > longest
                 ? fmt::format("\"{}\" in its header is too long", oneLine(from.substr(0, longest), 40))
                 : "its header is cut short");
    rest = from.substr(size + 1);
    return from.substr(0, size);
}

template <class T>
T numberIn(std::string_view word, const char* what) {
    T value{};
    const char *begin = word.data() + (word.starts_with('+') ? 1 : 0), *end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || rest != end)
        fail(fmt::format("its {} is \"{}\", not a number", what, oneLine(word, 40)));
    return value;
}

struct PfmHeader {
    int width = 0, height = 0, components = 0;
    float scale = 1;  // < 0: the pixels are little-endian
};

// Afterwards, `rest` begins at the first pixel.
PfmHeader readHeader(std::string_view& rest) {
    const std::string_view kind = takeWord(rest);
    if (kind != "PF" && kind != "Pf")
        fail(fmt::format("is not a PFM: it begins with \"{}\", not PF or Pf", oneLine(kind, 40)));
    PfmHeader header;
    header.components = kind == "PF" ? 3 : 1;
    header.width = numberIn<int>(takeWord(rest), "width");
    header.height = numberIn<int>(takeWord(rest), "height");
    const std::string_view scale = takeWord(rest);
    header.scale = numberIn<float>(scale, "scale");
    if (!std::isnormal(header.scale))
        fail(fmt::format("its scale is {}, not a normal number", oneLine(scale, 40)));
    return header;
}

float swapped(float value) {
    return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
}

// Rows are stored from bottom to top.
void readPixels(Image& image, std::string_view stored, float scale) {
    const std::size_t row =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.components);
    for (int y = 0; y < image.height; ++y) {
        float* to = image.data.data() + image.offset(0, image.height - 1 - y);
        std::memcpy(to, stored.data() + sizeof(float) * row * static_cast<std::size_t>(y),
                    sizeof(float) * row);
        if (scale > 0)
            for (std::size_t i = 0; i < row; ++i) to[i] = swapped(to[i]);
        if (std::abs(scale) != 1)
            for (std::size_t i = 0; i < row; ++i) to[i] *= std::abs(scale);
    }
}

}  // namespace

ImageSize pfmSize(std::span<const std::byte> bytes) {
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const PfmHeader header = readHeader(rest);
    return {header.width, header.height, std::int64_t{sizeof(float)} * header.components};
}

PfmImage readPfm(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max) {
    return named(name, [&] {
        std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const PfmHeader header = readHeader(rest);
        const std::int64_t pixel = std::int64_t{sizeof(float)} * header.components;
        checkImageSize(header.width, header.height, pixel, max);
        const auto size = static_cast<std::size_t>(pixel * header.width * header.height);
        // One blank ends the header. CR LF counts as one if the file is long enough; otherwise LF belongs
        // to a pixel.
        if (rest.size() == size + 1 && rest.data()[-1] == '\r' && rest.front() == '\n') rest.remove_prefix(1);
        if (rest.size() < size)
            fail(fmt::format("is cut short: {} x {} pixels need {} bytes, but it has {}", header.width,
                             header.height, size, rest.size()));
        PfmImage image{Image(header.width, header.height, header.components), rest.size() - size,
                       std::abs(header.scale)};
        readPixels(image.image, rest, header.scale);
        return image;
    });
}

void writePfm(const std::filesystem::path& file, const Image& image) {
    if (image.width < 1 || image.height < 1 || (image.components != 1 && image.components != 3) ||
        image.data.size() != image.pixels() * static_cast<std::size_t>(image.components))
        throw std::runtime_error(fmt::format("{}: a PFM is not {}x{}x{}", file.string(), image.width,
                                             image.height, image.components));
    AtomicFile out(file);
    fmt::print(out.stream(), "{}\n{} {}\n-1.0\n", image.components == 3 ? "PF" : "Pf", image.width,
               image.height);
    const std::size_t row =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.components);
    for (int y = image.height - 1; y >= 0; --y)
        std::fwrite(image.data.data() + image.offset(0, y), sizeof(float), row, out.stream());
    out.commit();
}

}  // namespace diptych
