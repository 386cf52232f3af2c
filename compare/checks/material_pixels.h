// SPDX-License-Identifier: MIT
// Finds the pixels of a material in part of a picture, fast enough for a million queries.
#pragma once

#include "compare/checks/pixel_box.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

class MaterialPixels {
public:
    // `ids` is the channel material_id: W x H x 1, -1 where nothing is. `positions` is the channel position,
    // W x H x 3, or nullptr. Both must outlive this.
    MaterialPixels(const Image& ids, const Image* positions);

    struct Seen {
        std::uint64_t pixels = 0;
        PixelBox box;  // around them
        void add(std::uint64_t count, const PixelBox& where);
    };
    // The pixels of `material` in `box` whose positions, where they are known, lie within `reach`. Visits no
    // pixel outside the box, and takes whole tiles from their summaries.
    Seen within(int material, const PixelBox& box, const Bounds& reach) const;

private:
    struct Entry {
        int material;
        Seen seen;
        Bounds positions;
    };
    static constexpr int tile = 16;  // pixels wide and high

    int at(int x, int y) const;
    glm::dvec3 positionAt(int x, int y) const;
    void scan(int material, const PixelBox& box, const Bounds& reach, Seen& seen) const;

    const Image& ids_;
    const Image* positions_;
    int columns_;
    std::vector<std::size_t> first_;  // per tile, row by row, and the end: into entries_
    std::vector<Entry> entries_;      // the materials of a tile, ascending
    std::vector<PixelBox> extents_;   // per material, over the whole picture
};

}  // namespace diptych
