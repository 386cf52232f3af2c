// SPDX-License-Identifier: MIT
#include "tests/image/material_checker.h"

#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace diptych::tests {
namespace {

// Minimum distance, in pixels, from the centre of a checked pixel to the edge of a texel or cell. Half a
// pixel plus the rasterizer's grid of 1/256 and float rounding of coordinates.
constexpr double evaluatedMargin = 0.51;

constexpr unsigned slotBit(gpu::uint slot) {
    return 1u << slot;
}

// Bit mask of the slots that may affect a channel of a cell.
unsigned slotsOf(Channel channel, const Cell& cell) {
    constexpr unsigned base = slotBit(gpu::SLOT_base_color);
    const unsigned glossy = cell.specular_glossiness ? slotBit(gpu::SLOT_specular_color) : 0,
                   rough = slotBit(gpu::SLOT_metallic_roughness) | glossy;
    switch (channel) {
        case Channel::albedo:
            return base | glossy;
        case Channel::material_id:
        case Channel::depth:
        case Channel::position:
        case Channel::geometric_normal:
        case Channel::texcoords:
        case Channel::tangent:
        case Channel::handedness:
            return base;
        case Channel::normals:
        case Channel::tangent_normal:
            return base | slotBit(gpu::SLOT_normal);
        case Channel::metallic:
        case Channel::roughness:
            return base | rough;
        case Channel::emission:
            return base | slotBit(gpu::SLOT_emissive);
        case Channel::occlusion:
            return base | slotBit(gpu::SLOT_occlusion);
        case Channel::specular:
            return base | rough | slotBit(gpu::SLOT_specular) | slotBit(gpu::SLOT_specular_color);
        case Channel::dielectric_f90:
            return base | slotBit(gpu::SLOT_specular);
        case Channel::dielectric_f0:
            return base | slotBit(gpu::SLOT_specular) | slotBit(gpu::SLOT_specular_color);
        case Channel::lightmapped:
            return base;
        case Channel::lightmap:
            return base | slotBit(gpu::SLOT_lightmap);
        default:
            return ~0u;
    }
}

// The pixel's position on the wall, and a bit mask of the slots whose texture shows a single texel there.
// Nothing at a cell's edge.
struct EvaluatedPixel {
    CellPosition place;
    unsigned slots = 0;

    bool shows(unsigned wanted) const { return (slots & wanted) == wanted; }
};
std::optional<EvaluatedPixel> evaluatedPixel(const std::vector<Cell>& cells, const CellCamera& camera, int x,
                                             int y) {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    EvaluatedPixel pixel{cellPosition(cells, camera, centre), ~0u};
    if (pixel.place.cell < 0) return {};
    const Cell& cell = cells[static_cast<std::size_t>(pixel.place.cell)];
    for (const glm::dvec2 side :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const CellPosition near = cellPosition(cells, camera, centre + side * evaluatedMargin);
        if (near.cell != pixel.place.cell) return {};
        for (std::size_t slot = 0; slot < cell.textures.size(); ++slot)
            if (cell.textures[slot].image >= 0 &&
                texelAt(cell, slot, near.at) != texelAt(cell, slot, pixel.place.at))
                pixel.slots &= ~(1u << slot);
    }
    return pixel;
}

double largestIn(const std::vector<double>& values) {
    double largest = 0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    return largest;
}

// Tolerance of every component of a channel's value at a pixel.
//
// A material value is a product of at most four floats: factor, texel, vertex colour and mixture. A texel,
// a decoded value and each product round by at most 2^-24: 2^-21 in all, relative. A normal's texel errs
// by 2^-24, is doubled, scaled by up to 1.6 and mixed with unit vectors: 4e-7, and as much again for its
// length.
double roundingOf(Channel channel, const std::vector<double>& expected) {
    const double largest = largestIn(expected);
    switch (channel) {
        case Channel::material_id:
            return 0;
        case Channel::normals:
        case Channel::geometric_normal:
        case Channel::tangent:
        case Channel::tangent_normal:
            return 1e-6;
        case Channel::texcoords:
            return 1e-6;
        case Channel::depth:
        case Channel::position:
            return 2e-6 * largest;
        default:
            return largest * 0x1p-21;
    }
}

// The rasterizer snaps vertices to a grid of 1/256 pixel. A point between two vertices is off by up to
// 1/128 of the way to the next pixel.
constexpr double cornerGrid = 1.0 / 128;

// Effect of that: on texture coordinates anywhere, on everything else if the wall is tilted.
double movedBy(Channel channel, const std::vector<Cell>& cells, const CellCamera& camera, int x, int y) {
    const CellPosition here = cellPosition(cells, camera, {x + 0.5, y + 0.5});
    double deeper = 0, aside = 0;
    for (const glm::dvec2 side : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
        const CellPosition next = cellPosition(cells, camera, glm::dvec2(x + 0.5, y + 0.5) + side);
        deeper += std::abs(next.depth - here.depth);
        aside = std::max({aside, std::abs(next.position.x - here.position.x),
                          std::abs(next.position.y - here.position.y)});
    }
    switch (channel) {
        case Channel::depth:
        case Channel::position:
            return deeper * cornerGrid;
        case Channel::texcoords:
            return aside * cornerGrid;
        case Channel::geometric_normal:
            // Over a cell of some 16 pixels, a snapped vertex tilts the triangle. The normal is also built
            // from position differences of neighbouring pixels, which float32 rounds.
            return deeper > 1e-9 ? deeper / aside * cornerGrid / 16 + 2 * here.depth * 0x1p-23 / aside : 0;
        default:
            return 0;
    }
}

void evaluate(CheckedValues& evaluated, const float* got, const std::vector<double>& expected, double allowed,
              const std::string& where) {
    for (std::size_t c = 0; c < expected.size(); ++c) {
        ++evaluated.values;
        const double error = std::abs(double{got[c]} - expected[c]);
        const double ratio = error == 0 ? 0 : error / std::max(allowed, 1e-12);
        if (!(ratio <= 1)) ++evaluated.wrong;
        if (ratio <= evaluated.worst) continue;
        evaluated.worst = ratio;
        evaluated.worst_at = fmt::format("{}, component {}: {}, not {}", where, c, got[c], expected[c]);
    }
}

std::string placeName(const std::vector<Cell>& cells, const CellPosition& place, int x, int y) {
    return fmt::format("\"{}\" at {}, {}", cells[static_cast<std::size_t>(place.cell)].name, x, y);
}

// Tolerance of light: float32 rounding through some hundred operations, relative to the largest component.
// Ambient light adds the error of the paths' table of its integral (tests/image/ambient_test.cpp).
constexpr double litRounding = 1e-5, ambientTable = 6e-5;

std::vector<double> valuesAt(const Frame& frame, Channel channel, int x, int y) {
    const Image& image = frame.channels.at(channel);
    const float* p = image.pixel(static_cast<std::size_t>(y * image.width + x));
    return {p, p + image.components};
}

// Effect of vertex snapping on light if the wall is tilted: that fraction of the differences to neighbours
// with the same texels. A surface at another depth is off the wall's plane, which changes the lamp's light
// by up to 2/3 per metre at 3 m distance. Nothing if there is no such neighbour in one direction.
std::optional<double> litMovedBy(const std::vector<Cell>& cells, const CellCamera& camera,
                                 const Frame& reference, Channel channel, const EvaluatedPixel& pixel, int x,
                                 int y) {
    if (camera.tilt == glm::dvec2(0)) return 0.0;
    const Cell& cell = cells[static_cast<std::size_t>(pixel.place.cell)];
    const auto alike = [&](const glm::ivec2& at) {
        if (at.x < 0 || at.y < 0 || at.x >= camera.size.x || at.y >= camera.size.y) return false;
        const CellPosition place = cellPosition(cells, camera, glm::dvec2(at) + 0.5);
        if (place.cell != pixel.place.cell) return false;
        for (std::size_t slot = 0; slot < cell.textures.size(); ++slot)
            if (texelAt(cell, slot, place.at) != texelAt(cell, slot, pixel.place.at)) return false;
        return true;
    };
    const std::vector<double> here = valuesAt(reference, channel, x, y);
    double moved = largestIn(here) * movedBy(Channel::depth, cells, camera, x, y) * 2 / 3;
    for (const glm::ivec2 along : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const glm::ivec2 next(glm::ivec2(x, y) + along), last(glm::ivec2(x, y) - along);
        if (!alike(next) && !alike(last)) return {};
        std::vector<double> differences = here;
        const std::vector<double> beside = alike(next) ? valuesAt(reference, channel, next.x, next.y)
                                                       : valuesAt(reference, channel, last.x, last.y);
        for (std::size_t c = 0; c < here.size(); ++c) differences[c] -= beside[c];
        moved += largestIn(differences) * cornerGrid;
    }
    return moved;
}

// Tolerance of a path's channel against the reference; nothing if it is not checked.
std::optional<double> allowedBeside(const std::vector<Cell>& cells, const CellCamera& camera,
                                    const Frame& reference, Channel channel, const EvaluatedPixel& pixel,
                                    int x, int y) {
    const std::vector<double> expected = valuesAt(reference, channel, x, y);
    if (!isLit(channel)) return roundingOf(channel, expected) + movedBy(channel, cells, camera, x, y);
    const auto moved = litMovedBy(cells, camera, reference, channel, pixel, x, y);
    if (!moved) return {};
    const double ambient = largestIn(valuesAt(reference, Channel::lit_ambient, x, y));
    const bool has = channel == Channel::lit || channel == Channel::lit_ambient;
    return litRounding * largestIn(expected) + (has ? ambientTable * ambient : 0) + *moved;
}

}  // namespace

bool anyWrong(const ChannelChecks& judgement) {
    return std::ranges::any_of(judgement, [](const auto& entry) { return entry.second.wrong > 0; });
}

std::string describe(const ChannelChecks& judgement) {
    std::string text;
    for (const auto& [channel, evaluated] : judgement)
        text +=
            fmt::format("{}: {} of {} wrong, worst {:.3g} of what is allowed, {}\n", debugMode(channel).name,
                        evaluated.wrong, evaluated.values, evaluated.worst, evaluated.worst_at);
    return text;
}

ChannelChecks againstClosedForm(const Frame& frame, const std::vector<Cell>& cells, const CellCamera& camera,
                                const CellDecode& decode) {
    ChannelChecks judgement;
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * camera.size.x + x); };
    for (int y = 0; y < camera.size.y; ++y)
        for (int x = 0; x < camera.size.x; ++x) {
            const std::optional<EvaluatedPixel> pixel = evaluatedPixel(cells, camera, x, y);
            if (!pixel) continue;
            const Cell& cell = cells[static_cast<std::size_t>(pixel->place.cell)];
            if (!pixel->shows(slotsOf(Channel::material_id, cell))) continue;
            const auto values = cellValues(cell, pixel->place, decode);
            const std::string where = placeName(cells, pixel->place, x, y);
            if (!values) {
                evaluate(judgement[Channel::material_id],
                         frame.channels.at(Channel::material_id).pixel(at(x, y)), {-1}, 0, where);
                continue;
            }
            for (const auto& [channel, expected] : *values) {
                if (!frame.channels.contains(channel) || !pixel->shows(slotsOf(channel, cell))) continue;
                const double allowed = roundingOf(channel, expected) + movedBy(channel, cells, camera, x, y);
                evaluate(judgement[channel], frame.channels.at(channel).pixel(at(x, y)), expected, allowed,
                         where);
            }
        }
    return judgement;
}

ChannelChecks againstReference(const Frame& frame, const Frame& reference, const std::vector<Cell>& cells,
                               const CellCamera& camera) {
    ChannelChecks judgement;
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * camera.size.x + x); };
    for (int y = 0; y < camera.size.y; ++y)
        for (int x = 0; x < camera.size.x; ++x) {
            const std::optional<EvaluatedPixel> pixel = evaluatedPixel(cells, camera, x, y);
            if (!pixel) continue;
            const Cell& cell = cells[static_cast<std::size_t>(pixel->place.cell)];
            const std::string where = placeName(cells, pixel->place, x, y);
            for (const auto& [channel, image] : frame.channels) {
                if (!reference.channels.contains(channel) || !pixel->shows(slotsOf(channel, cell))) continue;
                const auto allowed = allowedBeside(cells, camera, reference, channel, *pixel, x, y);
                if (!allowed) continue;
                evaluate(judgement[channel], image.pixel(at(x, y)), valuesAt(reference, channel, x, y),
                         *allowed, where);
            }
        }
    return judgement;
}

}  // namespace diptych::tests
