// SPDX-License-Identifier: MIT
#include "shared/scene/image/mipmap.h"

#include "shared/image/srgb.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace diptych {

namespace {

// Linear value of each component code.
template <class Code>
const std::vector<float>& linearValues(bool srgb) {
    const auto make = [](bool encoded) {
        constexpr std::size_t codes = std::size_t{std::numeric_limits<Code>::max()} + 1;
        std::vector<float> values(codes);
        for (std::size_t c = 0; c < codes; ++c) {
            const double x = static_cast<double>(c) / static_cast<double>(codes - 1);
            values[c] = static_cast<float>(encoded ? linearFromSrgb(x) : x);
        }
        return values;
    };
    static const std::vector<float> colors = make(true), numbers = make(false);
    return srgb ? colors : numbers;
}

// Rounds linear values to 8-bit sRGB by table lookup: code c covers threshold[c] to threshold[c + 1]. The
// initial guess, tabulated in steps of 1/4096, is at most one code too low: the steepest part of the
// curve, 12.92 x 255 codes over 0 to 1, passes 0.8 codes in 1/4096.
class SrgbEncoder {
public:
    SrgbEncoder() {
        for (int c = 0; c < 256; ++c)
            threshold_[static_cast<std::size_t>(c)] =
                static_cast<float>(linearFromSrgb(std::max(c - 0.5, 0.0) / 255.0));
        threshold_[256] = 2.0f;
        std::size_t code = 0;
        for (std::size_t i = 0; i < guess_.size(); ++i) {
            while (threshold_[code + 1] <= static_cast<float>(i) / 4096.0f) ++code;
            guess_[i] = static_cast<std::uint8_t>(code);
        }
    }

    // `linear` is within 0 to 1, up to rounding errors.
    std::uint8_t operator()(float linear) const {
        const std::size_t code = guess_[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * 4096.0f)];
        return static_cast<std::uint8_t>(code + (linear >= threshold_[code + 1] ? 1 : 0));
    }

private:
    std::array<float, 257> threshold_;
    std::array<std::uint8_t, 4097> guess_;
};

template <class Code>
Code rounded(float linear) {
    constexpr auto top = static_cast<float>(std::numeric_limits<Code>::max());
    return static_cast<Code>(static_cast<int>(std::clamp(linear, 0.0f, 1.0f) * top + 0.5f));
}

// Encodes a row of `count` components in the device's format.
void encodeRow(const float* linear, std::size_t count, Texels texels, std::byte* out) {
    static const SrgbEncoder srgb;
    const auto each = [&]<class Code>(Code, const auto& encode) {
        auto* codes = reinterpret_cast<Code*>(out);
        for (std::size_t i = 0; i < count; ++i) codes[i] = encode(linear[i]);
    };
    switch (texels) {
        case Texels::srgb8: {
            auto* codes = reinterpret_cast<std::uint8_t*>(out);
            for (std::size_t i = 0; i < count; i += 4) {
                for (std::size_t c = 0; c < 3; ++c) codes[i + c] = srgb(linear[i + c]);
                codes[i + 3] = rounded<std::uint8_t>(linear[i + 3]);
            }
            return;
        }
        case Texels::linear8:
            return each(std::uint8_t{}, rounded<std::uint8_t>);
        case Texels::linear16:
            return each(std::uint16_t{}, rounded<std::uint16_t>);
        case Texels::float16:
            return each(std::uint16_t{}, [](float x) { return glm::packHalf1x16(std::min(x, 65504.0f)); });
        case Texels::float32:
            std::memcpy(out, linear, count * sizeof(float));
    }
}

// The texels of one level that average to one texel of the next, and their weights: two of equal weight
// for an even size. An odd size 2n + 1 needs three: texel i covers i (2 + 1/n) to (i + 1)(2 + 1/n).
struct Taps {
    std::size_t first, count;
    std::array<float, 3> weight;
};

std::vector<Taps> tapsOf(std::size_t from, std::size_t to) {
    std::vector<Taps> taps(to);
    for (std::size_t i = 0; i < to; ++i) {
        if (from == to)
            taps[i] = {i, 1, {1, 0, 0}};
        else if (from == 2 * to)
            taps[i] = {2 * i, 2, {0.5f, 0.5f, 0}};
        else
            taps[i] = {2 * i,
                       3,
                       {static_cast<float>(static_cast<double>(to - i) / static_cast<double>(from)),
                        static_cast<float>(static_cast<double>(to) / static_cast<double>(from)),
                        static_cast<float>(static_cast<double>(i + 1) / static_cast<double>(from))}};
    }
    return taps;
}

struct Level {
    std::size_t width, height;
    std::vector<float> linear;  // four floats per texel
};

// The level after one of width x height. `row(y, scratch)` returns row y of the previous level in linear
// light, either in place or written to `scratch`. One thread sums each texel in a fixed order, so the
// result does not depend on the number of cores.
template <class Row>
Level halved(std::size_t width, std::size_t height, const Row& row, Texels texels,
             std::vector<std::byte>& encoded) {
    Level level{std::max<std::size_t>(width / 2, 1), std::max<std::size_t>(height / 2, 1), {}};
    level.linear.resize(4 * level.width * level.height);
    encoded.resize(level.width * level.height * bytesPerTexel(texels));
    const std::vector<Taps> columns = tapsOf(width, level.width), rows = tapsOf(height, level.height);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, level.height, 16), [&](const auto& range) {
        std::vector<float> scratch(4 * width), sum(4 * width);
        for (std::size_t y = range.begin(); y < range.end(); ++y) {
            for (std::size_t j = 0; j < rows[y].count; ++j) {
                const float* from = row(rows[y].first + j, scratch.data());
                const float weight = rows[y].weight[j];
                if (j == 0)
                    for (std::size_t i = 0; i < 4 * width; ++i) sum[i] = from[i] * weight;
                else
                    for (std::size_t i = 0; i < 4 * width; ++i) sum[i] += from[i] * weight;
            }
            float* out = level.linear.data() + 4 * level.width * y;
            for (std::size_t x = 0; x < level.width; ++x) {
                const Taps& taps = columns[x];
                const float* from = sum.data() + 4 * taps.first;
                for (std::size_t c = 0; c < 4; ++c) out[4 * x + c] = from[c] * taps.weight[0];
                for (std::size_t i = 1; i < taps.count; ++i)
                    for (std::size_t c = 0; c < 4; ++c) out[4 * x + c] += from[4 * i + c] * taps.weight[i];
            }
            encodeRow(out, 4 * level.width, texels, encoded.data() + level.width * y * bytesPerTexel(texels));
        }
    });
    return level;
}

// Rows of level 0 in linear light.
template <class Code>
auto decodedRows(const std::vector<Code>& codes, std::size_t width, bool srgb) {
    const float* color = linearValues<Code>(srgb).data();
    const float* number = linearValues<Code>(false).data();
    return [=, codes = codes.data()](std::size_t y, float* scratch) {
        const Code* row = codes + 4 * width * y;
        for (std::size_t i = 0; i < 4 * width; i += 4) {
            for (std::size_t c = 0; c < 3; ++c) scratch[i + c] = color[row[i + c]];
            scratch[i + 3] = number[row[i + 3]];
        }
        return static_cast<const float*>(scratch);
    };
}

}  // namespace

std::size_t bytesPerTexel(Texels texels) {
    return texels == Texels::srgb8 || texels == Texels::linear8 ? 4 : texels == Texels::float32 ? 16 : 8;
}

int MipChain::width(std::size_t level) const {
    return std::max(width_ >> level, 1);
}
int MipChain::height(std::size_t level) const {
    return std::max(height_ >> level, 1);
}

MipChain::MipChain(const TextureImage& image, bool srgb, Texels texels)
    : name_(image.name), texels_(texels), width_(image.width), height_(image.height), levels_(1) {
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    const bool deep = image.deep(), floats = !image.rgba32.empty();
    const bool eight = bytesPerTexel(texels) == 4;
    if ((deep && eight) || (floats && texels == Texels::linear16) ||
        image.components() != 4 * width * height || width * height == 0)
        throw std::logic_error("MipChain: " + name_ + " has not the texels that are asked for");

    const auto rowsOfTop = [&](const auto& use) {
        if (floats)
            use([&](std::size_t y, float*) { return image.rgba32.data() + 4 * width * y; });
        else
            deep ? use(decodedRows(image.rgba16, width, srgb)) : use(decodedRows(image.rgba, width, srgb));
    };
    image_ = floats ? std::as_bytes(std::span(image.rgba32))
             : deep ? std::as_bytes(std::span(image.rgba16))
                    : std::as_bytes(std::span(image.rgba));
    const bool as_it_is = floats ? texels == Texels::float32 : deep ? texels == Texels::linear16 : eight;
    if (!as_it_is) {
        levels_[0].resize(width * height * bytesPerTexel(texels));
        rowsOfTop([&](const auto& row) {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, height, 16), [&](const auto& range) {
                std::vector<float> scratch(4 * width);
                for (std::size_t y = range.begin(); y < range.end(); ++y)
                    encodeRow(row(y, scratch.data()), 4 * width, texels,
                              levels_[0].data() + width * y * bytesPerTexel(texels));
            });
        });
    }

    Level last{width, height, {}};
    const auto rowOfLast = [&](std::size_t y, float*) { return last.linear.data() + 4 * last.width * y; };
    while (last.width > 1 || last.height > 1) {
        std::vector<std::byte>& encoded = levels_.emplace_back();
        Level next;
        if (levels_.size() == 2)
            rowsOfTop([&](const auto& row) { next = halved(width, height, row, texels, encoded); });
        else
            next = halved(last.width, last.height, rowOfLast, texels, encoded);
        last = std::move(next);
    }
}

namespace {

// The two texels that a linear filter reads for texel i when it magnifies `from` texels to `to`, and the
// weight of the second.
struct Between {
    std::size_t first, second;
    float fraction;
};
Between between(std::size_t i, std::size_t from, std::size_t to, bool repeat) {
    const double at =
        (static_cast<double>(i) + 0.5) * static_cast<double>(from) / static_cast<double>(to) - 0.5;
    const auto n = static_cast<std::ptrdiff_t>(from), first = static_cast<std::ptrdiff_t>(std::floor(at));
    const auto inside = [&](std::ptrdiff_t j) {
        return static_cast<std::size_t>(repeat ? (j + n) % n : std::clamp(j, std::ptrdiff_t{0}, n - 1));
    };
    return {inside(first), inside(first + 1), static_cast<float>(at - static_cast<double>(first))};
}

}  // namespace

void MipChain::own() {
    if (levels_[0].empty()) levels_[0].assign(image_.begin(), image_.end());
}

void MipChain::replaceAlpha(const MipChain& from, std::size_t component, bool repeat_x, bool repeat_y) {
    const std::size_t above = count() - std::min(count(), from.count());
    if (bytesPerTexel(texels_) != 4 || bytesPerTexel(from.texels_) != 4 || count() != above + from.count() ||
        width(above) != from.width() || height(above) != from.height())
        throw std::logic_error("MipChain: " + from.name_ + " has not the sizes of levels of " + name_);
    own();
    for (std::size_t k = 0; k < count(); ++k) {
        const std::span<const std::byte> texels = from.level(k < above ? 0 : k - above);
        const auto columns = static_cast<std::size_t>(width(k)), rows = static_cast<std::size_t>(height(k)),
                   stride = static_cast<std::size_t>(from.width());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows, 16), [&](const auto& range) {
            for (std::size_t y = range.begin(); y < range.end(); ++y)
                for (std::size_t x = 0; x < columns; ++x) {
                    std::byte& alpha = levels_[k][4 * (y * columns + x) + 3];
                    if (k >= above) {
                        alpha = texels[4 * (y * columns + x) + component];
                        continue;
                    }
                    const Between u = between(x, stride, columns, repeat_x),
                                  v = between(y, static_cast<std::size_t>(from.height()), rows, repeat_y);
                    const auto code = [&](std::size_t i, std::size_t j) {
                        return static_cast<float>(texels[4 * (j * stride + i) + component]);
                    };
                    const auto row = [&](std::size_t j) {
                        return code(u.first, j) * (1 - u.fraction) + code(u.second, j) * u.fraction;
                    };
                    alpha = static_cast<std::byte>(row(v.first) * (1 - v.fraction) +
                                                   row(v.second) * v.fraction + 0.5f);
                }
        });
    }
}

}  // namespace diptych
