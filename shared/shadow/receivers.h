// SPDX-License-Identifier: MIT
// Which part of a cascade's map the picture may read, and from how deep: what casts nowhere into that need
// not be drawn (Bittner, Mattausch, Silvennoinen and Wimmer 2011, "Shadow Caster Culling for Efficient Shadow
// Mapping", with boxes instead of pixels). No Vulkan; in double.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/shadow/cascades.h"

#include <span>
#include <vector>

namespace diptych {

// A grid over a cascade's map. A cell holds how far from the light a receiver may lie in it: something that
// is seen (a box of `seen`), in the cascade's part of the view. Casters reach what lies under them: a box
// matters where it is not wholly farther from the light than all receivers of the cells that it meets, with
// the texels around it that a filter reads.
class ReceiverMask {
public:
    // `area`: one of `cascades`. `compares`: what is farther from the light than a receiver leaves its
    // visibility as it is, as with comparisons; moments change with it.
    ReceiverMask(const Cascades& cascades, const CascadeArea& area, const View& view,
                 std::span<const SeenBox> seen, const CascadeRequest& request, bool compares);

    // `caster`: in the clip space of the cascade.
    bool reachedBy(const ClipBox& caster) const;

    // The part of the map that may be read, texels from the upper left: receivers with what a filter reads
    // around them. None where nothing that is seen lies in the cascade.
    struct Texels {
        int x = 0, y = 0, width = 0, height = 0;
    };
    Texels read() const;

    // Of a side.
    static constexpr int cells = 128;
    // Of the cell's receivers, the least depth; infinity where there is none. Tests look at it.
    double deepest(int x, int y) const { return deepest_[static_cast<std::size_t>(y * cells + x)]; }

private:
    double size_;        // of the map's side, texels
    double margin_ = 0;  // clip space: what is read around a receiver
    std::vector<double> deepest_;
};

}  // namespace diptych
