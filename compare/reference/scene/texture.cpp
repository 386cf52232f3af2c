// SPDX-License-Identifier: MIT
#include "compare/reference/scene/texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace diptych::reference {
namespace {

// sRGB decoding, IEC 61966-2-1.
double linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double decoded(std::uint8_t code, bool srgb) {
    static const std::array<double, 256> colors = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < 256; ++i) values[i] = linear(static_cast<double>(i) / 255);
        return values;
    }();
    return srgb ? colors[code] : code / 255.0;
}

// The texel used for a coordinate beyond the edge; glTF 2.0, 3.8.4.
int wrapped(int i, int size, Wrap wrap) {
    if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, size - 1);
    const int period = wrap == Wrap::repeat ? size : 2 * size;
    const int within = (i % period + period) % period;
    return within < size ? within : period - 1 - within;
}

glm::dvec4 bilinear(const Pyramid& pyramid, int level, const Sampler& sampler, const glm::dvec2& uv) {
    const int width = pyramid.width(level), height = pyramid.height(level);
    const double x = uv.x * width - 0.5, y = uv.y * height - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    const auto texel = [&](int dx, int dy) {
        return pyramid.texel(level, wrapped(static_cast<int>(x0) + dx, width, sampler.wrap_s),
                             wrapped(static_cast<int>(y0) + dy, height, sampler.wrap_t));
    };
    return (texel(0, 0) * (1 - fx) + texel(1, 0) * fx) * (1 - fy) +
           (texel(0, 1) * (1 - fx) + texel(1, 1) * fx) * fy;
}

glm::dvec4 nearestTexel(const Pyramid& pyramid, const Sampler& sampler, const glm::dvec2& uv) {
    const int width = pyramid.width(0), height = pyramid.height(0);
    return pyramid.texel(0, wrapped(static_cast<int>(std::floor(uv.x * width)), width, sampler.wrap_s),
                         wrapped(static_cast<int>(std::floor(uv.y * height)), height, sampler.wrap_t));
}

// Clamps coordinates so large that they have no fractional part; the image repeats, so any texel is as
// good.
glm::dvec2 bounded(const glm::dvec2& uv) {
    return glm::clamp(uv, glm::dvec2(-1e8), glm::dvec2(1e8));
}

}  // namespace

Pyramid::Pyramid(const TextureImage& image, bool srgb) : image_(image), srgb_(srgb) {
    while (width(levels() - 1) > 1 || height(levels() - 1) > 1) {
        const int below = levels() - 1, w = width(below), h = height(below);
        Level level{std::max((w + 1) / 2, 1), std::max((h + 1) / 2, 1), {}};
        level.rgba.reserve(std::size_t{4} * static_cast<std::size_t>(level.width) *
                           static_cast<std::size_t>(level.height));
        // Texel x of this level (width w from W texels) covers the texels x W / w to (x + 1) W / w of the
        // level below.
        const auto fractions = [](int i, int from, int to) {
            const double begin = static_cast<double>(i) * from / to,
                         end = static_cast<double>(i + 1) * from / to;
            std::vector<std::pair<int, double>> taps;
            for (int k = static_cast<int>(begin); k < std::min<double>(std::ceil(end - 1e-9), from); ++k)
                taps.emplace_back(
                    k, (std::min<double>(k + 1, end) - std::max<double>(k, begin)) / (end - begin));
            return taps;
        };
        std::vector<std::vector<std::pair<int, double>>> columns;
        for (int x = 0; x < level.width; ++x) columns.push_back(fractions(x, w, level.width));
        for (int y = 0; y < level.height; ++y) {
            const auto rows = fractions(y, h, level.height);
            for (int x = 0; x < level.width; ++x) {
                glm::dvec4 sum(0);
                for (const auto& [row, down] : rows)
                    for (const auto& [column, across] : columns[static_cast<std::size_t>(x)])
                        sum += texel(below, column, row) * (down * across);
                for (int c = 0; c < 4; ++c) level.rgba.push_back(static_cast<float>(sum[c]));
            }
        }
        levels_.push_back(std::move(level));
    }
}

int Pyramid::width(int level) const {
    return level == 0 ? image_.width : levels_[static_cast<std::size_t>(level) - 1].width;
}
int Pyramid::height(int level) const {
    return level == 0 ? image_.height : levels_[static_cast<std::size_t>(level) - 1].height;
}

glm::dvec4 Pyramid::texel(int level, int x, int y) const {
    const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width(level)) +
                                static_cast<std::size_t>(x));
    glm::dvec4 result;
    if (level > 0) {
        const std::vector<float>& rgba = levels_[static_cast<std::size_t>(level) - 1].rgba;
        for (int c = 0; c < 4; ++c) result[c] = double{rgba[at + static_cast<std::size_t>(c)]};
        return result;
    }
    for (int c = 0; c < 4; ++c) {
        const std::size_t i = at + static_cast<std::size_t>(c);
        const bool encoded = srgb_ && c < 3;
        if (!image_.rgba32.empty())
            result[c] = double{image_.rgba32[i]};
        else if (image_.rgba16.empty())
            result[c] = decoded(image_.rgba[i], encoded);
        else
            result[c] = encoded ? linear(image_.rgba16[i] / 65535.0) : image_.rgba16[i] / 65535.0;
    }
    return result;
}

const Pyramid& Textures::pyramid(int image, bool srgb) const {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Pyramid>& made = pyramids_[{image, srgb}];
    if (!made) made = std::make_unique<Pyramid>(scene_.images[static_cast<std::size_t>(image)], srgb);
    return *made;
}

glm::dvec4 Textures::operator()(const Texture& texture, bool srgb, const Footprint& footprint) const {
    const Pyramid& levels = pyramid(texture.image, srgb);
    const glm::dvec2 size(levels.width(0), levels.height(0)), uv = bounded(footprint.uv);
    const glm::dvec2 dx = bounded(footprint.dx), dy = bounded(footprint.dy), x = dx * size, y = dy * size;
    const double longest = std::max(glm::length(x), glm::length(y));
    const Sampler& sampler = texture.sampler;
    if (!(longest > 1))
        return sampler.magnify_linear ? bilinear(levels, 0, sampler, uv) : nearestTexel(levels, sampler, uv);
    // Spaces the points equally along both sides, with at least eight on each. A footprint at a grazing
    // angle is long and narrow and must not be blurred across its short side.
    constexpr double min = 8, max = 64;
    const double across = std::abs(x.x * y.y - x.y * y.x) / longest;
    // Spacing of the points, in texels of level 0.
    const double spacing = std::max(across / min, longest / max);
    const auto points = [&](const glm::dvec2& side) {
        return static_cast<int>(std::clamp(std::ceil(glm::length(side) / spacing), min, max));
    };
    const int along_x = points(x), along_y = points(y);
    const double exact = std::clamp(std::log2(std::max(spacing, 1.0)), 0.0, levels.levels() - 1.0);
    const int level = static_cast<int>(exact);
    glm::dvec4 sum(0);
    for (int j = 0; j < along_y; ++j)
        for (int i = 0; i < along_x; ++i) {
            const glm::dvec2 at =
                bounded(uv + dx * ((i + 0.5) / along_x - 0.5) + dy * ((j + 0.5) / along_y - 0.5));
            if (level == 0 && !sampler.minify_linear)
                sum += nearestTexel(levels, sampler, at);
            else
                sum += bilinear(levels, level, sampler, at);
        }
    return sum / (double{1} * along_x * along_y);
}

}  // namespace diptych::reference
