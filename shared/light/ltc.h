// SPDX-License-Identifier: MIT
// The table of linearly transformed cosines that area lights are shaded with, as fit/ made it.
#pragma once

#include "shared/contract/ltc.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// One lobe; shared/contract/ltc.h says what the first four are.
struct LtcLobe {
    float in_plane = 1, across = 1, unsheared = 0, tilt = 0;
    // The distance of the fit: the integral of |lobe / its own integral - cosine transformed| over all
    // directions, 0 to 2. No light's share of the lobe is off by more than half of it.
    float error = 0;
};

struct LtcCell {
    LtcLobe even, layer;
    float magnitude = 1;  // directional albedo of the lobe where F = 1
    float fresnel = 0;    // the same with Schlick's weight (1 - v.h)^5 in place of F

    // What a lobe with F from f0 to f90 reflects of a light all around.
    double reflected(double f0, double f90) const {
        return f0 * double{magnitude} + (f90 - f0) * double{fresnel};
    }
    // The parameters of such a lobe, between both by what F0 has of all that is reflected; `error` too, which
    // is an estimate then.
    LtcLobe lobe(double f0, double f90) const;
};

// The layers of ltc.exr: one channel Y each, column i, row j.
struct LtcLayer {
    const char* name;
    float& (*of)(LtcCell&);
    float from(LtcCell cell) const { return of(cell); }
};
inline constexpr LtcLayer ltcLayers[] = {
    {"even_in_plane", [](LtcCell& c) -> float& { return c.even.in_plane; }},
    {"even_across", [](LtcCell& c) -> float& { return c.even.across; }},
    {"even_unsheared", [](LtcCell& c) -> float& { return c.even.unsheared; }},
    {"even_tilt", [](LtcCell& c) -> float& { return c.even.tilt; }},
    {"even_error", [](LtcCell& c) -> float& { return c.even.error; }},
    {"layer_in_plane", [](LtcCell& c) -> float& { return c.layer.in_plane; }},
    {"layer_across", [](LtcCell& c) -> float& { return c.layer.across; }},
    {"layer_unsheared", [](LtcCell& c) -> float& { return c.layer.unsheared; }},
    {"layer_tilt", [](LtcCell& c) -> float& { return c.layer.tilt; }},
    {"layer_error", [](LtcCell& c) -> float& { return c.layer.error; }},
    {"magnitude", [](LtcCell& c) -> float& { return c.magnitude; }},
    {"fresnel", [](LtcCell& c) -> float& { return c.fresnel; }}};

// By its figure i of roughness and j of n.v: cell(i, j) = cells[j * LTC_CELLS + i].
struct LtcTable {
    std::vector<LtcCell> cells;

    const LtcCell& cell(std::size_t i, std::size_t j) const { return cells[j * gpu::LTC_CELLS + i]; }
    // As a bilinear filter reads it; both arguments are kept within the table.
    LtcCell at(double roughness, double n_dot_v) const;
};

// The stored table; read once.
const LtcTable& ltcTable();

// As the shaders read it, four half floats a texel, LTC_CELLS x LTC_BLOCKS LTC_CELLS.
std::vector<std::uint64_t> ltcTexels(const LtcTable& table);

}  // namespace diptych
