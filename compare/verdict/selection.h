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

// As the command line gives it; by default every pixel counts.
struct SelectionOptions {
    std::string mask;      // a picture file: pixels whose largest component is at least 0.5 count
    std::vector<int> ids;  // material ids: pixels that show one of them in the reference count
    int ignore_edges = 0;  // pixels nearer than this to another object, in either picture, do not count
    std::optional<Crop> crop;

    bool any() const { return !mask.empty() || !ids.empty() || ignore_edges > 0 || crop; }
};

// "X,Y,WxH". Throws std::runtime_error where it is not that.
Crop cropOf(const std::string& words);

// What distinguishes objects: ids, or without them view depth; nullptr where a picture lacks them.
struct ObjectPlanes {
    const Image* ids[2] = {nullptr, nullptr};  // of reference and test; one component
    const Image* depth[2] = {nullptr, nullptr};
};

// Removes the pixels that `options` exclude from `coverage`, of a picture of width x height, and adds a line
// each to `notes`. Throws std::runtime_error if the mask cannot be read or has another size, if the crop is
// not inside the picture, or if the planes that distinguish objects are needed and missing.
void applySelection(Coverage& coverage, int width, int height, const SelectionOptions& options,
                    const ObjectPlanes& objects, std::vector<std::string>& notes);

}  // namespace diptych
