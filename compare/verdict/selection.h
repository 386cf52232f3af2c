// SPDX-License-Identifier: MIT
// Selects the pixels of two images that are compared.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Crop {
    int x = 0, y = 0, width = 0, height = 0;  // pixels, from the top left
};

// As on the command line; by default every pixel counts.
struct SelectionOptions {
    std::string mask;      // image file: pixels whose largest component is at least 0.5 count
    std::vector<int> ids;  // material ids: only pixels that show one of them in the reference count
    int ignore_edges = 0;  // pixels nearer than this to another object, in either image, do not count
    std::optional<Crop> crop;

    bool any() const { return !mask.empty() || !ids.empty() || ignore_edges > 0 || crop; }
};

// "X,Y,WxH". Throws std::runtime_error on other input.
Crop cropOf(const std::string& text);

// Planes that distinguish objects: ids, or else view depth; nullptr if an image lacks them.
struct ObjectPlanes {
    const Image* ids[2] = {nullptr, nullptr};  // of reference and test; one component
    const Image* depth[2] = {nullptr, nullptr};
};

// Removes the pixels that `options` exclude from `coverage`, for an image of width x height, and adds a
// line for each option to `notes`. Throws std::runtime_error if the mask cannot be read or has another
// size, if the crop is not inside the image, or if planes are needed to distinguish objects and missing.
void applySelection(Coverage& coverage, int width, int height, const SelectionOptions& options,
                    const ObjectPlanes& objects, std::vector<std::string>& notes);

}  // namespace diptych
