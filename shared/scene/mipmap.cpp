// SPDX-License-Identifier: MIT
#include "shared/scene/mipmap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych {

namespace {

// IEC 61966-2-1, in double: encoded 0 to 1 -> linear 0 to 1.
double linearFromSrgb(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Rounding to 8 bits is a search: code c stands for every linear value from threshold[c] up to
// threshold[c + 1]. The guess, one per 1/4096, lies at most a step below the answer: the steepest part of
// the curve, 12.92 x 255 codes over 0 to 1, passes 0.8 codes in 1/4096.
class Codec {
public:
    explicit Codec(bool srgb) {
        const auto decode = [&](double encoded) { return srgb ? linearFromSrgb(encoded) : encoded; };
        for (int c = 0; c < 256; ++c) {
            linear_[static_cast<std::size_t>(c)] = static_cast<float>(decode(c / 255.0));
            threshold_[static_cast<std::size_t>(c)] =
                static_cast<float>(decode(std::max(c - 0.5, 0.0) / 255.0));
        }
        threshold_[256] = 2.0f;
        std::size_t code = 0;
        for (std::size_t i = 0; i < guess_.size(); ++i) {
            while (threshold_[code + 1] <= static_cast<float>(i) / 4096.0f) ++code;
            guess_[i] = static_cast<std::uint8_t>(code);
        }
    }

    float decode(std::uint8_t code) const { return linear_[code]; }

    // `linear` from 0 to 1 and a rounding error beyond.
    std::uint8_t encode(float linear) const {
        std::size_t code = guess_[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * 4096.0f)];
        while (linear >= threshold_[code + 1]) ++code;
        return static_cast<std::uint8_t>(code);
    }

private:
    std::array<float, 256> linear_;
    std::array<float, 257> threshold_;
    std::array<std::uint8_t, 4097> guess_;
};

// The texels below one texel of the next level and the share of its area that each covers: two equal ones
// of an even size, three of an odd size 2n + 1 (texel i reaches from i (2 + 1/n) to (i + 1)(2 + 1/n)).
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
    std::vector<glm::vec4> texels;  // linear
};

// Each texel is summed by one thread in one order: the result is the same on any number of cores.
// `texel(index)` gives a linear texel of the level above.
template <class Texel>
Level halved(std::size_t width, std::size_t height, const Texel& texel) {
    Level level{std::max<std::size_t>(width / 2, 1), std::max<std::size_t>(height / 2, 1), {}};
    level.texels.resize(level.width * level.height);
    const std::vector<Taps> columns = tapsOf(width, level.width), rows = tapsOf(height, level.height);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, level.height, 16), [&](const auto& range) {
        for (std::size_t y = range.begin(); y < range.end(); ++y) {
            for (std::size_t x = 0; x < level.width; ++x) {
                glm::vec4 sum(0);
                for (std::size_t j = 0; j < rows[y].count; ++j) {
                    const std::size_t row = (rows[y].first + j) * width + columns[x].first;
                    glm::vec4 rowSum(0);
                    for (std::size_t i = 0; i < columns[x].count; ++i)
                        rowSum += texel(row + i) * columns[x].weight[i];
                    sum += rowSum * rows[y].weight[j];
                }
                level.texels[y * level.width + x] = sum;
            }
        }
    });
    return level;
}

}  // namespace

// Every level is averaged from the one before it unrounded: rounding happens once, on the way out.
std::vector<TextureImage> makeMipmaps(const TextureImage& image, bool srgb) {
    static const Codec srgbCodec(true), linearCodec(false);
    const Codec& color = srgb ? srgbCodec : linearCodec;

    std::vector<TextureImage> chain{image};
    if (image.width < 1 || image.height < 1) return chain;

    Level level{static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height), {}};
    const auto stored = [&](std::size_t i) {
        const std::uint8_t* p = image.rgba.data() + 4 * i;
        return glm::vec4(color.decode(p[0]), color.decode(p[1]), color.decode(p[2]),
                         linearCodec.decode(p[3]));
    };
    const auto previous = [&](std::size_t i) { return level.texels[i]; };

    while (level.width > 1 || level.height > 1) {
        Level next = chain.size() == 1 ? halved(level.width, level.height, stored)
                                       : halved(level.width, level.height, previous);
        level = std::move(next);
        TextureImage& out = chain.emplace_back();
        out.name = image.name;
        out.width = static_cast<int>(level.width);
        out.height = static_cast<int>(level.height);
        out.rgba.resize(4 * level.texels.size());
        for (std::size_t i = 0; i < level.texels.size(); ++i) {
            const glm::vec4& t = level.texels[i];
            out.rgba[4 * i + 0] = color.encode(t.r);
            out.rgba[4 * i + 1] = color.encode(t.g);
            out.rgba[4 * i + 2] = color.encode(t.b);
            out.rgba[4 * i + 3] = linearCodec.encode(t.a);
        }
    }
    return chain;
}

}  // namespace diptych
