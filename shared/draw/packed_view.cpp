// SPDX-License-Identifier: MIT
#include "shared/draw/packed_view.h"

#include <bit>

namespace diptych {

namespace {

namespace lane {
constexpr unsigned x = 0, y = 1, z = 2, w = 3;
}
#define DIPTYCH_LANE(texel, at, ...) 4 * texel + lane::at,
constexpr unsigned lanes[] = {PACKED_VIEW(DIPTYCH_LANE, DIPTYCH_LANE)
                                  PACKED_GRID(DIPTYCH_LANE, DIPTYCH_LANE, DIPTYCH_LANE)};
#undef DIPTYCH_LANE
static_assert(eachLaneOnce(lanes));

}  // namespace

PackedView packedView(const gpu::View& view, const gpu::LightGrid& grid) {
    PackedView packed;
#define VIEW_FLOAT(texel, lane, member) packed[texel].lane = std::bit_cast<gpu::uint>(view.member);
#define VIEW_UINT(texel, lane, member) packed[texel].lane = view.member;
#define GRID_FLOAT(texel, lane, member) packed[texel].lane = std::bit_cast<gpu::uint>(grid.member);
#define GRID_SHORTS(texel, lane, low, high) packed[texel].lane = grid.low | (grid.high << 16);
#define GRID_BYTES(texel, lane, low, middle, high) \
    packed[texel].lane = grid.low | (grid.middle << 8) | (grid.high << 16);
    PACKED_VIEW(VIEW_FLOAT, VIEW_UINT)
    PACKED_GRID(GRID_FLOAT, GRID_SHORTS, GRID_BYTES)
#undef VIEW_FLOAT
#undef VIEW_UINT
#undef GRID_FLOAT
#undef GRID_SHORTS
#undef GRID_BYTES
    return packed;
}

}  // namespace diptych
