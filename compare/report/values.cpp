// SPDX-License-Identifier: MIT
#include "compare/report/values.h"

#include <Imath/half.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace diptych {
namespace {

constexpr std::size_t maxExactBytes = std::size_t{1} << 20;

// The largest finite magnitude; 0 if there is none.
double largestOf(const Image& image) {
    float largest = 0;
    for (const float v : image.data)
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    return double{largest};
}

// 2^result x `largest` is in [2^14, 2^15), below the largest half, 65504.
int exponentFor(double largest) {
    return largest > 0 ? 14 - std::ilogb(largest) : 0;
}

std::uint16_t halfBits(double value) {
    return imath_float_to_half(static_cast<float>(value));
}

bool holdsExactly(const Image& image, int exponent) {
    return std::ranges::all_of(image.data, [scale = std::exp2(exponent)](float v) {
        const double scaled = double{v} * scale;
        return !std::isfinite(v) || double{imath_half_to_float(halfBits(scaled))} == scaled;
    });
}

using Write = std::function<void(std::string_view)>;

char base91Letter(unsigned digit) {
    return static_cast<char>('#' + digit + ('#' + digit >= '\\'));  // skips the backslash
}

// 13 bytes encode to whole characters, so groups of 13 bytes can be encoded separately.
constexpr std::size_t base91Group = 13;
std::string base91(std::string_view bytes) {
    std::string out;
    out.reserve((bytes.size() + 1) * 16 / 13);
    unsigned held = 0, bits = 0;
    const auto put = [&] {
        const unsigned word = held & 0x1fff;
        out += base91Letter(word / 91);
        out += base91Letter(word % 91);
        held >>= 13;
    };
    for (const char byte : bytes) {
        held |= static_cast<unsigned>(static_cast<unsigned char>(byte)) << bits;
        bits += 8;
        if (bits < 13) continue;
        put();
        bits -= 13;
    }
    if (bits > 6)
        put();
    else if (bits > 0)
        out += base91Letter(held);
    return out;
}

// Writes planes split into bytes, each deflated separately and in base 91; the page reverses this.
class Planes {
public:
    Planes(int width, std::size_t pixels, int bits, const Write& write)
        : width_(static_cast<std::size_t>(width)),
          plane_(pixels * static_cast<std::size_t>(bits) / 8),
          pixels_(pixels),
          write_(write),
          compressor_(libdeflate_alloc_compressor(level), libdeflate_free_compressor) {
        if (!compressor_) throw std::bad_alloc();
        deflated_.resize(libdeflate_zlib_compress_bound(compressor_.get(), plane_.size()));
    }

    // wordOf(i): the word of pixel i. `smooth`: stores differences of neighbours; noisy data such as
    // errors compresses better without.
    template <class Word>
    void add(bool smooth, const Word& wordOf) {
        std::uint32_t left = 0, any = 0;
        for (std::size_t i = 0; i < pixels_; ++i) {
            if (!smooth || i % width_ == 0) left = 0;
            const std::uint32_t word = wordOf(i);
            any |= word - left;
            for (std::size_t byte = 0; byte * pixels_ < plane_.size(); ++byte)
                plane_[byte * pixels_ + i] = static_cast<unsigned char>((word - left) >> (8 * byte));
            left = word;
        }
        write_(first_ ? "\"" : ",\"");
        first_ = false;
        if (any != 0) deflate();
        write_("\"");
    }

private:
    // Level 6 takes a quarter longer than level 4 and saves a twentieth; zlib's level 6 takes three times
    // as long for the same size.
    static constexpr int level = 6;

    void deflate() {
        const std::size_t bytes = libdeflate_zlib_compress(compressor_.get(), plane_.data(), plane_.size(),
                                                           deflated_.data(), deflated_.size());
        // Written in pieces, so that the whole text, which is larger, is never in memory.
        constexpr std::size_t piece = base91Group << 13;
        const std::string_view all(deflated_.data(), bytes);
        for (std::size_t at = 0; at < bytes; at += piece) write_(base91(all.substr(at, piece)));
    }

    std::size_t width_;
    std::vector<unsigned char> plane_;
    std::size_t pixels_;
    const Write& write_;
    std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
    std::vector<char> deflated_;
    bool first_ = true;
};

// One word of a component; 32 bits are not scaled. A double stores every scaled float exactly.
struct WordOf {
    int bits;
    double scale;
    std::uint32_t operator()(float value) const {
        return bits == 32 ? std::bit_cast<std::uint32_t>(value)
                          : std::uint32_t{halfBits(double{value} * scale)};
    }
};

}  // namespace

void valuesScript(const std::string& name, const ChannelValues& values, const Write& write) {
    const Image& first = *values.baseline;
    const int images = values.test ? 2 : 1;
    const bool small = first.data.size() * sizeof(float) * static_cast<std::size_t>(images) <= maxExactBytes;
    const int exponent = exponentFor(std::max(largestOf(first), values.test ? largestOf(*values.test) : 0.0));
    const bool halfIsExact =
        holdsExactly(first, exponent) && (!values.test || holdsExactly(*values.test, exponent));
    const WordOf word{small && !halfIsExact ? 32 : 16, std::exp2(exponent)};
    const double unit = word.bits == 16 && values.errors ? largestOf(*values.errors) : 1.0;

    const nlohmann::ordered_json head{{"width", first.width},
                                      {"height", first.height},
                                      {"components", first.components},
                                      {"images", images},
                                      {"errors", values.errors != nullptr},
                                      {"bits", word.bits},
                                      {"exact", word.bits == 32 || halfIsExact},
                                      {"exponent", word.bits == 32 ? 0 : exponent},
                                      {"errorUnit", unit > 0 ? unit : 1.0}};
    std::string begin = "diptychValues(" + nlohmann::json(name).dump() + "," + head.dump();
    begin.pop_back();  // the brace: `data` follows
    write(begin + ",\"data\":[");

    Planes planes(first.width, first.pixels(), word.bits, write);
    const auto at = [](const Image& image, std::size_t pixel, int c) {
        return image.pixel(pixel)[static_cast<std::size_t>(c)];
    };
    for (int c = 0; c < first.components; ++c)
        planes.add(true, [&](std::size_t i) { return word(at(first, i, c)); });
    for (int c = 0; values.test && c < first.components; ++c)
        planes.add(false,
                   [&](std::size_t i) { return word(at(*values.test, i, c)) - word(at(first, i, c)); });
    if (values.errors) {
        const WordOf unscaled{word.bits, 1};
        planes.add(false, [&](std::size_t i) {
            const double e = values.errors->data[i];
            return unscaled(static_cast<float>(unit > 0 && std::isfinite(e) ? e / unit : e));
        });
    }
    write("]});\n");
}

}  // namespace diptych
