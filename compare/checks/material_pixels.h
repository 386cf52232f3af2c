// SPDX-License-Identifier: MIT
// Finds a material's pixels in part of an image, fast enough for a million queries.
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
    // `ids`: channel material_id, W x H x 1, -1 for background. `positions`: channel position, W x H x 3,
    // or nullptr. Both must outlive the object.
    MaterialPixels(const Image& ids, const Image* positions);

    struct Visible {
        std::uint64_t pixels = 0;
        PixelBox box;  // bounding box
        void add(std::uint64_t count, const PixelBox& where);
    };
    // Pixels of `material` in `box`, with positions inside `bounds` if known. Visits only pixels in the
    // box, and uses whole tiles by their summaries.
    Visible within(int material, const PixelBox& box, const Bounds& bounds) const;

private:
    struct Entry {
        int material;
        Visible visible;
        Bounds positions;
    };
    static constexpr int tile = 16;  // pixels, width and height

    int at(int x, int y) const;
    glm::dvec3 positionAt(int x, int y) const;
    void scan(int material, const PixelBox& box, const Bounds& bounds, Visible& visible) const;

    const Image& ids_;
    const Image* positions_;
    int columns_;
    std::vector<std::size_t> first_;  // per tile, row by row, plus the end: index into entries_
    std::vector<Entry> entries_;      // materials per tile, ascending
    std::vector<PixelBox> extents_;   // per material, over the whole image
};

}  // namespace diptych
