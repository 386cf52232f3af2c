// SPDX-License-Identifier: MIT
// The table of linearly transformed cosines that area lights are shaded with, as fit/ made it.
#pragma once

#include "shared/contract/ltc.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// One lobe; shared/contract/ltc.h says what the first three are.
struct LtcCell {
    float in_plane = 1, across = 1, unsheared = 0;
    float magnitude = 1;  // directional albedo of the lobe where F = 1
    float fresnel = 0;    // the same with Schlick's weight (1 - v.h)^5 in place of F
    // The distance of the fit: the integral of |lobe / magnitude - cosine transformed| over all directions, 0
    // to 2. No light's reflection is off by more than half of it, relative to what a light all around would
    // give.
    float error = 0;
};

// The layers of ltc.exr: one channel Y each, column i, row j.
struct LtcLayer {
    const char* name;
    float LtcCell::*member;
};
inline constexpr LtcLayer ltcLayers[] = {
    {"in_plane", &LtcCell::in_plane},   {"across", &LtcCell::across},   {"unsheared", &LtcCell::unsheared},
    {"magnitude", &LtcCell::magnitude}, {"fresnel", &LtcCell::fresnel}, {"error", &LtcCell::error}};

// By its figure i of roughness and j of n.v: cell(i, j) = cells[j * LTC_CELLS + i].
struct LtcTable {
    std::vector<LtcCell> cells;

    const LtcCell& cell(std::size_t i, std::size_t j) const { return cells[j * gpu::LTC_CELLS + i]; }
    // As a bilinear filter reads it; both arguments are kept within the table.
    LtcCell at(double roughness, double n_dot_v) const;
};

// The stored table; read once.
const LtcTable& ltcTable();

// As the shaders read it, four half floats a texel, LTC_CELLS x 2 LTC_CELLS: in_plane, across, unsheared,
// magnitude; under these fresnel, 0, 0, 0.
std::vector<std::uint64_t> ltcTexels(const LtcTable& table);

}  // namespace diptych
