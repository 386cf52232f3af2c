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

extern const unsigned char ltcFile[];  // made from ltc.exr by CMake
extern const std::size_t ltcFileSize;

namespace {

constexpr double last = gpu::LTC_CELLS - 1;

LtcTable readTable() {
    const PictureFile file =
        readExr(std::as_bytes(std::span(ltcFile, ltcFileSize)), "the table of linearly transformed cosines");
    LtcTable table;
    table.cells.resize(std::size_t{gpu::LTC_CELLS} * gpu::LTC_CELLS);
    for (const LtcLayer& layer : ltcLayers) {
        const auto found = std::ranges::find(file.layers, layer.name, &PictureLayer::name);
        if (found == file.layers.end() || found->image.data.size() != table.cells.size())
            throw std::runtime_error("ltc.exr: not the table that fit_ltc writes; run fit_ltc");
        for (std::size_t i = 0; i < table.cells.size(); ++i)
            table.cells[i].*layer.member = found->image.data[i];
    }
    return table;
}

}  // namespace

LtcCell LtcTable::at(double roughness, double n_dot_v) const {
    constexpr double least{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    const double x = std::clamp((roughness - least) / (1 - least), 0.0, 1.0) * last;
    const double y = (1 - std::sqrt(std::clamp(n_dot_v, 0.0, 1.0))) * last;
    const double i = std::min(std::floor(x), last - 1), j = std::min(std::floor(y), last - 1);
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    LtcCell result;
    for (const LtcLayer& layer : ltcLayers) {
        const auto value = [&](double di, double dj) {
            return cell(static_cast<std::size_t>(i + di), static_cast<std::size_t>(j + dj)).*layer.member;
        };
        result.*layer.member = (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) +
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
    texels.reserve(2 * table.cells.size());
    for (const LtcCell& c : table.cells)
        texels.push_back(glm::packHalf4x16({c.in_plane, c.across, c.unsheared, c.magnitude}));
    for (const LtcCell& c : table.cells) texels.push_back(glm::packHalf4x16({c.fresnel, 0, 0, 0}));
    return texels;
}

}  // namespace diptych
