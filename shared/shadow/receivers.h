// SPDX-License-Identifier: MIT
// Parts of a cascade's map that visible receivers may sample, with their depth. Casters outside them are
// culled (Bittner, Mattausch, Silvennoinen and Wimmer 2011, "Shadow Caster Culling for Efficient Shadow
// Mapping", with boxes instead of pixels). No Vulkan; in double.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/shadow/cascades.h"

#include <span>
#include <vector>

namespace diptych {

// A grid over a cascade's map. A cell stores the largest distance from the light of a receiver: visible
// geometry (`seen`) in the cascade's part of the view. A caster matters unless it is farther from the
// light than all receivers of the cells it overlaps, with the filter's border.
class ReceiverMask {
public:
    // `area`: one of `cascades`. `compares`: true for depth comparisons, where geometry beyond a receiver
    // does not affect it; false for moments, where it does.
    ReceiverMask(const Cascades& cascades, const CascadeArea& area, const View& view,
                 std::span<const VisibleBox> seen, const CascadeRequest& request, bool compares);

    // `caster`: in clip space of the cascade.
    bool reachedBy(const ClipBox& caster) const;

    // Area of the map that may be sampled, in texels from the upper left: receivers with the filter's
    // border. Empty if no visible receiver is in the cascade.
    struct Texels {
        int x = 0, y = 0, width = 0, height = 0;
    };
    Texels read() const;

    // per side
    static constexpr int cells = 128;
    // Smallest depth of the cell's receivers; infinity without any. For tests.
    double deepest(int x, int y) const { return deepest_[static_cast<std::size_t>(y * cells + x)]; }

private:
    double size_;        // of the map's side, texels
    double margin_ = 0;  // clip space; sampled border around a receiver
    std::vector<double> deepest_;
};

}  // namespace diptych
