// SPDX-License-Identifier: MIT
// Members of View and LightGrid that fragments read, packed into texels by PACKED_VIEW and PACKED_GRID.
#pragma once

#include "shared/contract/light_list.h"
#include "shared/contract/view.h"

#include <array>
#include <cstddef>
#include <span>

namespace diptych {

using PackedView = std::array<glm::uvec4, gpu::PACKED_VIEW_TEXELS>;

// `grid`: both tile counts and the slices are below 65,536, both shifts below 256.
PackedView packedView(const gpu::View& view, const gpu::LightGrid& grid);

// Whether every texel component occurs in the list exactly once; a component is 4 * texel + 0 to 3.
constexpr bool eachLaneOnce(std::span<const unsigned> lanes) {
    std::array<int, std::size_t{4} * gpu::PACKED_VIEW_TEXELS> count{};
    for (const unsigned lane : lanes) {
        if (lane >= count.size()) return false;
        ++count[lane];
    }
    for (const int times : count)
        if (times != 1) return false;
    return true;
}

}  // namespace diptych
