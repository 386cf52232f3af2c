// SPDX-License-Identifier: MIT
#include "shared/light/ltc.h"

#include "shared/contract/constants.h"
#include "shared/image/exr.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace diptych {

extern const unsigned char ltcFile[];  // generated from ltc.exr by CMake
extern const std::size_t ltcFileSize;

namespace {

constexpr double last_cell = gpu::LTC_CELLS - 1;

LtcTable readTable() {
    const ImageFile file =
        readExr(std::as_bytes(std::span(ltcFile, ltcFileSize)), "the table of linearly transformed cosines");
    LtcTable table;
    table.cells.resize(std::size_t{gpu::LTC_CELLS} * gpu::LTC_CELLS);
    for (const LtcLayer& layer : ltcLayers) {
        const auto found = std::ranges::find(file.layers, layer.name, &ImageLayer::name);
        if (found == file.layers.end() || found->image.data.size() != table.cells.size())
            throw std::runtime_error("ltc.exr: is not a table of fit_ltc; run fit_ltc");
        for (std::size_t i = 0; i < table.cells.size(); ++i) layer.of(table.cells[i]) = found->image.data[i];
    }
    return table;
}

}  // namespace

LtcLobe LtcCell::lobe(double f0, double f90) const {
    const auto evenFraction = [&](double from, double to) {
        const double all = reflected(from, std::max(to, from));
        return all > 0 ? from * double{magnitude} / all : 0;
    };
    const double min = evenFraction(double{gpu::LTC_LAYER_F0}, 1);
    const auto t =
        static_cast<float>(std::clamp((evenFraction(f0, f90) - min) / std::max(1 - min, 1e-6), 0.0, 1.0));
    return {.in_plane = std::lerp(layer.in_plane, even.in_plane, t),
            .across = std::lerp(layer.across, even.across, t),
            .unsheared = std::lerp(layer.unsheared, even.unsheared, t),
            .tilt = std::lerp(layer.tilt, even.tilt, t),
            .error = std::lerp(layer.error, even.error, t)};
}

LtcCell LtcTable::at(double roughness, double n_dot_v) const {
    constexpr double min{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    const double x = std::clamp((roughness - min) / (1 - min), 0.0, 1.0) * last_cell;
    const double y = (1 - std::sqrt(std::clamp(n_dot_v, 0.0, 1.0))) * last_cell;
    const double i = std::min(std::floor(x), last_cell - 1), j = std::min(std::floor(y), last_cell - 1);
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    LtcCell result;
    for (const LtcLayer& layer : ltcLayers) {
        const auto value = [&](double di, double dj) {
            return layer.from(cell(static_cast<std::size_t>(i + di), static_cast<std::size_t>(j + dj)));
        };
        layer.of(result) = (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) +
                           v * ((1 - u) * value(0, 1) + u * value(1, 1));
    }
    return result;
}

const LtcTable& ltcTable() {
    static const LtcTable table = readTable();
    return table;
}

std::vector<std::uint64_t> ltcTexels(const LtcTable& table) {
    std::vector<std::uint64_t> texels;
    texels.reserve(gpu::LTC_BLOCKS * table.cells.size());
    const auto push = [&](const LtcLobe& l) {
        texels.push_back(glm::packHalf4x16({l.in_plane, l.across, l.unsheared, l.tilt}));
    };
    for (const LtcCell& c : table.cells) push(c.even);
    for (const LtcCell& c : table.cells) push(c.layer);
    for (const LtcCell& c : table.cells) texels.push_back(glm::packHalf4x16({c.magnitude, c.fresnel, 0, 0}));
    return texels;
}

}  // namespace diptych
