// SPDX-License-Identifier: MIT
#include "compare/report/values.h"

#include "compare/report/files.h"

#include <Imath/half.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace diptych {
namespace {

constexpr std::size_t mostExactBytes = std::size_t{1} << 20;

// The largest finite magnitude; 0 where there is none.
double largestOf(const Image& image) {
    float largest = 0;
    for (const float v : image.data)
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    return double{largest};
}

// 2^result x `largest` is in [2^14, 2^15): below the largest half, 65504.
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

// Deltas of rows, by bytes: what the page undoes.
class Planes {
public:
    Planes(int width, std::size_t pixels, int bits)
        : width_(static_cast<std::size_t>(width)),
          pixels_(pixels),
          bytes_(static_cast<std::size_t>(bits) / 8) {}

    // wordOf(i): the word of pixel i.
    template <class Word>
    void add(const Word& wordOf) {
        const std::size_t start = raw_.size();
        raw_.resize(start + pixels_ * bytes_);
        std::uint32_t left = 0;
        for (std::size_t i = 0; i < pixels_; ++i) {
            if (i % width_ == 0) left = 0;
            const std::uint32_t word = wordOf(i);
            for (std::size_t byte = 0; byte < bytes_; ++byte)
                raw_[start + byte * pixels_ + i] = static_cast<unsigned char>((word - left) >> (8 * byte));
            left = word;
        }
    }

    // Level 1: a report waits for dozens of these; level 4 takes half again as long to save a thirteenth.
    std::string deflated() const {
        uLongf size = compressBound(static_cast<uLong>(raw_.size()));
        std::string out(size, '\0');
        if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, raw_.data(),
                      static_cast<uLong>(raw_.size()), 1) != Z_OK)
            throw std::runtime_error("zlib: no memory for the values of a channel");
        out.resize(size);
        return out;
    }

private:
    std::size_t width_, pixels_, bytes_;
    std::vector<unsigned char> raw_;
};

// One word of a component; 32 bits are not scaled. A double holds every float times every scale exactly.
struct WordOf {
    int bits;
    double scale;
    std::uint32_t operator()(float value) const {
        return bits == 32 ? std::bit_cast<std::uint32_t>(value)
                          : std::uint32_t{halfBits(double{value} * scale)};
    }
};

}  // namespace

std::string valuesScript(const std::string& name, const ChannelValues& values) {
    const Image& first = *values.baseline;
    const int images = values.test ? 2 : 1;
    const bool small = first.data.size() * sizeof(float) * static_cast<std::size_t>(images) <= mostExactBytes;
    const int exponent = exponentFor(std::max(largestOf(first), values.test ? largestOf(*values.test) : 0.0));
    const bool halfIsExact =
        holdsExactly(first, exponent) && (!values.test || holdsExactly(*values.test, exponent));
    const WordOf word{small && !halfIsExact ? 32 : 16, std::exp2(exponent)};
    const double unit = word.bits == 16 && values.errors ? largestOf(*values.errors) : 1.0;

    Planes planes(first.width, first.pixels(), word.bits);
    const auto at = [](const Image& image, std::size_t pixel, int c) {
        return image.pixel(pixel)[static_cast<std::size_t>(c)];
    };
    for (int c = 0; c < first.components; ++c)
        planes.add([&](std::size_t i) { return word(at(first, i, c)); });
    for (int c = 0; values.test && c < first.components; ++c)
        planes.add([&](std::size_t i) { return word(at(*values.test, i, c)) - word(at(first, i, c)); });
    if (values.errors) {
        const WordOf unscaled{word.bits, 1};
        planes.add([&](std::size_t i) {
            const double e = values.errors->data[i];
            return unscaled(static_cast<float>(unit > 0 && std::isfinite(e) ? e / unit : e));
        });
    }
    const nlohmann::ordered_json head{{"width", first.width},
                                      {"height", first.height},
                                      {"components", first.components},
                                      {"images", images},
                                      {"errors", values.errors != nullptr},
                                      {"bits", word.bits},
                                      {"exact", word.bits == 32 || halfIsExact},
                                      {"exponent", word.bits == 32 ? 0 : exponent},
                                      {"errorUnit", unit > 0 ? unit : 1.0},
                                      {"data", base64(planes.deflated())}};
    return "diptychValues(" + nlohmann::json(name).dump() + "," + head.dump() + ");\n";
}

}  // namespace diptych
