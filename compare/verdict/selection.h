// SPDX-License-Identifier: MIT
// Which pixels of two pictures are compared.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Crop {
    int x = 0, y = 0, width = 0, height = 0;  // pixels, from the top left
};

// As the command line asks for it; nothing set: every pixel.
struct SelectionOptions {
    std::string mask;      // a picture file: pixels whose largest component is at least 0.5 count
    std::vector<int> ids;  // material ids: pixels that show one of them in the reference count
    int ignore_edges = 0;  // pixels nearer than this to another object, in either picture, do not count
    std::optional<Crop> crop;

    bool any() const { return !mask.empty() || !ids.empty() || ignore_edges > 0 || crop; }
};

// "X,Y,WxH". Throws std::runtime_error where it is not that.
Crop cropOf(const std::string& words);

// What tells objects apart: ids, or without them view depth; nullptr where a picture has neither.
struct ObjectPlanes {
    const Image* ids[2] = {nullptr, nullptr};  // of reference and test; one component
    const Image* depth[2] = {nullptr, nullptr};
};

// Takes out of `coverage`, of a picture of width x height, what `options` leave out, and says so in `notes`,
// a line each. Throws std::runtime_error where the mask cannot be read or is of another size, the crop is not
// inside the picture, or what tells objects apart is needed and missing.
void applySelection(Coverage& coverage, int width, int height, const SelectionOptions& options,
                    const ObjectPlanes& objects, std::vector<std::string>& notes);

}  // namespace diptych
